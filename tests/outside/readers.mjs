// Readers that are not ours, from npm: prints what they say of a file as JSON.
//
//   node readers.mjs MODULES gltf|usd FILE      MODULES is the folder node_modules

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, format, file] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(file));

async function gltf() {
  const validator = createRequire(join(modules, 'x.js'))('gltf-validator');
  const { issues, info } = await validator.validateBytes(bytes);
  return { issues, info };
}

async function usd() {
  // It is built for browsers: this looks like one to it, and its code is loaded here.
  globalThis.window = {};
  process.type = 'renderer';
  const wasm = readFileSync(join(modules, 'tinyusdz/tinyusdz.wasm'));
  const instantiateWasm = (imports, done) => {
    WebAssembly.instantiate(wasm, imports).then(({ instance }) => done(instance));
    return {};
  };
  const entry = pathToFileURL(join(modules, 'tinyusdz/tinyusdz.js'));
  const tiny = await (await import(entry)).default({ instantiateWasm });
  const loader = new tiny.TinyUSDZLoaderNative();
  if (!loader.loadFromBinary(bytes, file)) return { error: loader.error() };
  const meshes = [];
  for (let i = 0; i < loader.numMeshes(); i++) {
    const mesh = loader.getMesh(i);
    const points = Array.from(mesh.points);
    const along = (axis) => points.filter((_, k) => k % 3 === axis);
    meshes.push({
      name: mesh.primName, vertices: points.length / 3, triangles: mesh.faceVertexIndices.length / 3,
      normals: mesh.normals ? mesh.normals.length / 3 : 0,
      low: [0, 1, 2].map((a) => along(a).reduce((x, y) => Math.min(x, y))),
      high: [0, 1, 2].map((a) => along(a).reduce((x, y) => Math.max(x, y))),
    });
  }
  return { meshes };
}

console.log(JSON.stringify(await { gltf, usd }[format]()));
