#!/usr/bin/python3
"""Reads one file of each format with programs that are not ours, and compares what they say with what is in it.

Usage: check_formats.py WRITE_SAMPLES MODULES: the program that writes the samples, and the node_modules of tests/outside, if they
are there.
"""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"  # before cv2 is loaded
import cv2
import numpy
import pyopenvdb

OUTSIDE = Path(__file__).resolve().parent.parent / "outside"
sys.path.insert(0, str(OUTSIDE))
import lib3mf

RADIUS = 20.0  # mm; the sphere stands on y = 0 around (5, 20, -3)
VOXEL = 0.4  # mm


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    text = done.stdout + done.stderr
    assert done.returncode == 0, f"{command} exits with {done.returncode}: {text}"
    return text


def numbers(pattern, text):
    found = re.search(pattern, text)
    assert found, f"no {pattern!r} in:\n{text}"
    return [float(group) for group in found.groups()]


def check_stl(path):
    text = run("admesh", str(path))
    number = r"\s*:?\s*(-?[\d.e+-]+)"
    assert numbers(r"Min Z =" + number, text)[0] == 0, text
    assert math.isclose(numbers(r"Max Z =" + number, text)[0], 2 * RADIUS, rel_tol=1e-6)
    assert math.isclose(numbers(r"Min Y =" + number, text)[0], 3 - RADIUS, rel_tol=1e-6)
    volume = numbers(r"Volume\s*:" + number, text)[0]
    assert math.isclose(volume, 4 / 3 * math.pi * RADIUS**3, rel_tol=4e-3), volume
    for what in ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                 "Facets reversed", "Backwards edges", "Normals fixed"):
        assert numbers(what + r"\s*:\s*(\d+)", text)[0] == 0, f"{what}:\n{text}"
    assert numbers(r"Number of parts\s*:\s*(\d+)", text)[0] == 1


def check_ply(path):
    text = run("vdb_tool", "-read", str(path), "-print")
    assert "vtx = 4098, tri = 8192" in text, text
    assert "bbox=[-15, 0, -23] -> [25, 40, 17]" in text, text


def check_by_assimp(path, factor):
    text = run("assimp", "info", str(path))
    number = r"\(\s*(-?[\d.]+) (-?[\d.]+) (-?[\d.]+)\)"
    assert numbers(r"Faces:\s*(\d+)", text)[0] == 8192, text
    low, high = numbers("Minimum point\\s*" + number, text), numbers("Maximum point\\s*" + number, text)
    for got, expected in zip(low + high, (-15, 0, -23, 25, 40, 17)):
        assert math.isclose(got, factor * expected, abs_tol=2e-6), text


def ask_npm(format_name, path):
    return json.loads(run("node", str(OUTSIDE / "readers.mjs"), sys.argv[2], format_name, str(path)))


def check_glb(path):
    found = ask_npm("gltf", path)
    assert found["issues"]["messages"] == [], found
    assert found["info"]["totalTriangleCount"] == 8192 and found["info"]["totalVertexCount"] == 4098


def check_usda(path):
    (mesh,) = ask_npm("usd", path)["meshes"]
    assert (mesh["vertices"], mesh["triangles"], mesh["normals"]) == (4098, 8192, 4098), mesh
    assert numpy.allclose(mesh["low"] + mesh["high"], numpy.array([-15, 0, -23, 25, 40, 17]) / 1000)


def check_3mf(path):
    package = lib3mf.Package(path)
    assert package.warnings == 0 and package.unit == 1, package.unit  # millimetres
    assert package.objects == [{"vertices": 4098, "triangles": 8192, "closed": True, "name": "sphere"}]
    assert [name for name, _ in package.materials] == ["body", "limb-1"], package.materials
    assert package.thumbnail_bytes > 100


def check_vdb(path, factor, unit):
    text = run("vdb_print", "-l", str(path))
    assert "surface" in text and "level set" in text, text
    metadata = pyopenvdb.readAllGridMetadata(str(path))
    assert metadata[0].name == "surface"
    assert metadata[0]["file_mem_bytes"] > 0
    grids, file_metadata = pyopenvdb.readAll(str(path))
    assert len(grids) == 1
    assert file_metadata["units"] == unit and file_metadata["up_axis"] == "Y"
    grid = grids[0]
    voxel = VOXEL * factor
    assert grid.gridClass == "level set"
    assert math.isclose(grid.transform.voxelSize()[0], voxel, rel_tol=1e-6)
    assert math.isclose(grid.background, 3 * voxel, rel_tol=1e-6)
    points, _ = grid.convertToQuads()
    distances = numpy.linalg.norm(points / factor - numpy.array([5, 20, -3]), axis=1)
    assert numpy.abs(distances - RADIUS).max() < 0.05 * VOXEL


def check_png(path):
    assert "40 x   30, 4 channel, uint8 png" in run("iinfo", str(path))
    assert "sRGB" in run("iinfo", "-v", str(path))
    picture = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    x, y = numpy.meshgrid(numpy.arange(40), numpy.arange(30))
    expected = numpy.stack([x + y, 5 * y, 3 * x, 255 - x * y], axis=2) & 255  # blue comes first
    assert (picture == expected).all()


def check_exr(path):
    text = run("iinfo", "-v", str(path))
    assert "40 x   30, 9 channel" in text, text
    assert ("R (half), G (half), B (half), A (half), Z (float), id (float), "
            "N.X (half), N.Y (half), N.Z (half)") in text, text
    data = run("oiiotool", "--dumpdata", str(path))
    pixels = re.findall(r"Pixel \((\d+), (\d+)\):([^\n]*)", data)
    assert len(pixels) == 40 * 30, data[:400]
    for x, y, values in ((int(x), int(y), [float(v) for v in t.split()]) for x, y, t in pixels):
        z = 1e10 if x == y else 100 + x / 3
        expected = [x / 64, y / 64, (x + y) / 128, 0.5, z, x - 1, x / 64, -y / 64, 0.25]
        assert numpy.allclose(values, expected, rtol=1e-6, atol=1e-6), (x, y, values)
    colors = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    x, y = numpy.meshgrid(numpy.arange(40), numpy.arange(30))
    expected = numpy.stack([(x + y) / 128, y / 64, x / 64], axis=2)  # blue comes first
    assert numpy.abs(colors[:, :, :3] - expected).max() < 1e-6


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run(sys.argv[1], name)
        check_stl(folder / "sphere.stl")
        check_ply(folder / "sphere.ply")
        check_by_assimp(folder / "parts.ply", 0.001)
        check_by_assimp(folder / "sphere.obj", 0.001)
        check_by_assimp(folder / "sphere.glb", 0.001)
        if Path(sys.argv[2]).is_dir():
            check_glb(folder / "sphere.glb")
            check_usda(folder / "sphere.usda")
        else:
            print("glTF validator and USD reader are not installed: scripts/outside_readers.sh")
        check_3mf(folder / "sphere.3mf")
        check_vdb(folder / "sphere.vdb", 0.001, "m")
        check_vdb(folder / "sphere_mm.vdb", 1, "mm")
        check_png(folder / "picture.png")
        check_exr(folder / "layers.exr")


main()
