"""Blender opens what Lascaux writes: nothing for the test command, for Blender is a gigabyte.

    apt-get install blender
    blender --background --factory-startup --python-exit-code 1 --python scripts/blender_check.py -- build/release/bin/lascaux

Builds the cat for Blender, imports every format that Blender takes, and compares its size, where it stands and what is in it.
"""
import pathlib
import subprocess
import sys
import tempfile

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian's Blender 3.4 asks its numpy for a name that is gone

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LENGTH = 0.1  # m: the default of 100 mm
IMPORTERS = {
    ".glb": lambda path: bpy.ops.import_scene.gltf(filepath=path),
    ".obj": lambda path: bpy.ops.wm.obj_import(filepath=path),
    ".ply": lambda path: bpy.ops.import_mesh.ply(filepath=path),
    ".stl": lambda path: bpy.ops.import_mesh.stl(filepath=path, global_scale=0.001),
}


def imported(importer, path):
    """The new objects of one import."""
    before = set(bpy.data.objects)
    importer(str(path))
    return [o for o in bpy.data.objects if o not in before]


def check_box(name, objects, margin=0.0):
    up = 1 if name == ".ply" else 2  # which is imported without turning it
    corners = [o.matrix_world @ Vector(c) for o in objects for c in o.bound_box]
    low, high = ([f(c[a] for c in corners) for a in range(3)] for f in (min, max))
    length, height = high[0] - low[0], high[up] - low[up]
    assert abs(length - LENGTH) < 0.03 * LENGTH + 2 * margin, (name, low, high)
    assert abs(low[up]) < 0.02 * LENGTH + margin, f"{name} does not stand on the ground: {low}"
    assert 0.4 * length < height < length, (name, low, high)


def check_mesh(name, objects):
    meshes = [o for o in objects if o.type == "MESH"]
    assert len(meshes) == 1, (name, objects)
    check_box(name, meshes)
    assert len(meshes[0].data.polygons) > 10000, name


def check_volume(name, objects):
    (volume,) = objects
    assert volume.type == "VOLUME", volume.type
    volume.data.grids.load()
    grids = {g.name: g.data_type for g in volume.data.grids}
    expected = {"surface": "FLOAT", "density": "FLOAT", "Cd": "VECTOR_FLOAT", "part": "FLOAT"}
    assert grids == expected, grids
    bpy.context.view_layer.update()
    check_box(name, [volume], margin=8 * LENGTH / 256)  # boxes of whole leaves


def main():
    program = pathlib.Path(sys.argv[sys.argv.index("--") + 1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        paths = {ending: pathlib.Path(folder) / f"cat{ending}" for ending in (".vdb", *IMPORTERS)}
        outputs = [a for path in paths.values() for a in ("-o", str(path))]
        subprocess.run([program, "build", SOURCE / "examples/cat.svg", "--for", "blender", "--color", *outputs], check=True)
        for ending, importer in IMPORTERS.items():
            check_mesh(ending, imported(importer, paths[ending]))
            print(f"Blender {bpy.app.version_string} takes {ending}")
        check_volume(".vdb", imported(lambda path: bpy.ops.object.volume_import(filepath=path), paths[".vdb"]))
        print(f"Blender {bpy.app.version_string} takes .vdb")


if __name__ == "__main__":
    main()
