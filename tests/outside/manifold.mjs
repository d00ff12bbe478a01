// Does Manifold take a mesh as a solid? Exits with 0 or 1.
//
//   node manifold.mjs MODULES FILE      FILE holds {"corners": [[x, y, z], ...], "faces": [[a, b, c], ...]}

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, file] = process.argv.slice(2);
const { corners, faces } = JSON.parse(readFileSync(file, 'utf8').replaceAll('NaN', '1e999'));
const entry = pathToFileURL(join(modules, 'manifold-3d/manifold.js'));
const library = await (await import(entry)).default();
library.setup();
try {
  const mesh = new library.Mesh({
    numProp: 3, vertProperties: Float32Array.from(corners.flat()), triVerts: Uint32Array.from(faces.flat()),
  });
  process.exit(new library.Manifold(mesh).isEmpty() ? 1 : 0);
} catch (error) {
  console.error(error.message ?? error);
  process.exit(1);
}
