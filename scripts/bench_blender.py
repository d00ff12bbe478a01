#!/usr/bin/env python3
"""The benchmark's body as Blender's metaballs, beside our field and mesh at the same resolution.

    scripts/bench_blender.py [--resolution 256] [--runs 5]

Needs `blender` (Debian's package) and what scripts/bench.py needs. Blender has capsules of one radius each, so they have
their segments' mean radius. Not part of scripts/bench.py: Blender is a gigabyte to install.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BODY = ROOT / "bench/data/animal.txt"
THRESHOLD, STIFFNESS = 0.6, 2.0  # Blender's own
# A lone ball's surface is where stiffness * (1 - (d / radius)^2)^3 is the threshold.
SHARE = (1 - (THRESHOLD / STIFFNESS) ** (1 / 3)) ** 0.5


def in_blender(resolution, runs):
    """Runs inside of Blender: prints the median and the number of polygons."""
    import bpy
    from mathutils import Vector

    segments = []
    for line in BODY.read_text().splitlines():
        words = line.split()
        if words and words[0] != "#":
            numbers = [float(word) for word in words[:8]]
            segments.append((Vector(numbers[:3]), Vector(numbers[4:7]), (numbers[3] + numbers[7]) / 2))
    low = [min(min(a[k], b[k]) - r for a, b, r in segments) for k in range(3)]
    high = [max(max(a[k], b[k]) + r for a, b, r in segments) for k in range(3)]
    step = max(high[k] - low[k] for k in range(3)) / resolution
    balls = bpy.data.metaballs.new("body")
    balls.threshold = THRESHOLD
    for a, b, radius in segments:
        element = balls.elements.new(type="CAPSULE")
        element.co = (a + b) / 2
        element.size_x = (b - a).length / 2
        element.rotation = Vector((1, 0, 0)).rotation_difference(b - a)
        element.radius = radius / SHARE
        element.stiffness = STIFFNESS
    body = bpy.data.objects.new("body", balls)
    bpy.context.collection.objects.link(body)
    times = []
    for run in range(runs + 1):  # the first one also makes the scene
        balls.resolution = step * (1 + 1e-6 * run)  # or it would not be made again
        start = time.perf_counter()
        graph = bpy.context.evaluated_depsgraph_get()
        graph.update()
        polygons = len(body.evaluated_get(graph).to_mesh().polygons)
        times.append(1000 * (time.perf_counter() - start))
    print("metaballs", json.dumps({"ms": statistics.median(times[1:]), "polygons": polygons}))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--resolution", type=int, default=256)
    parser.add_argument("--runs", type=int, default=5)
    inside = "bpy" in sys.modules
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if inside else None)
    if inside:
        return in_blender(arguments.resolution, arguments.runs)
    settings = ["--resolution", str(arguments.resolution), "--runs", str(arguments.runs)]
    output = subprocess.run(["blender", "--background", "--factory-startup", "--python", __file__, "--", *settings],
                            check=True, capture_output=True, text=True).stdout
    found = next((line for line in output.splitlines() if line.startswith("metaballs ")), None)
    if found is None:
        sys.exit(output)
    peer = json.loads(found.split(" ", 1)[1])
    ours = json.loads(subprocess.run([ROOT / "build/release/bin/bench_peers", BODY, str(arguments.resolution)], check=True,
                                     capture_output=True, text=True).stdout)["runs"][0]
    ms = ours["ms"]["blocks"] + ours["ms"]["mesh"]
    print(f"Blender's metaballs {peer['ms']:.1f} ms for {peer['polygons']} polygons, field and mesh {ms:.1f} ms for "
          f"{ours['triangles']} triangles: {peer['ms'] / ms:.1f} times (aim 30)")


if __name__ == "__main__":
    main()
