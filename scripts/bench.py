#!/usr/bin/env python3
"""How fast the program is beside what it competes with, in one run on this machine.

    scripts/bench.py [--runs 11] [--resolutions 256,512,2048] [--compare | --record]

Needs the release build with -DLASCAUX_BENCH=ON and what scripts/bench_setup.sh installs; a peer that is not there is
left out and named. Prints stage times, then ratios with the aims that docs/performance.md explains. --compare compares
them with bench/baseline.json: one that is worse by more than the noise ends with exit code 1. --record writes a new
baseline. Times of different machines don't compare; ratios do, roughly, when nothing else runs.
"""
import argparse
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BODY = ROOT / "bench/data/animal.txt"
BASELINE = ROOT / "bench/baseline.json"
NOISE = 0.2  # of a ratio, between runs on a quiet machine


class Ratios:
    """What is measured against what; smaller is better for those with at_most, larger for at_least."""

    def __init__(self):
        self.rows = {}

    def add(self, name, value, aim, better):
        self.rows[name] = {"value": float(f"{value:.4g}"), "aim": aim, "better": better}

    def show(self):
        for name, row in self.rows.items():
            sign = "<=" if row["better"] == "less" else ">="
            good = row["value"] <= row["aim"] if row["better"] == "less" else row["value"] >= row["aim"]
            print(f"  {name:58} {row['value']:8.3g}   aim {sign} {row['aim']:<5} {'' if good else 'missed'}")

    def worse_than(self, baseline):
        found = []
        for name, row in self.rows.items():
            old = baseline.get(name, {}).get("value")
            if old is None:
                continue
            now, then = (row["value"], old) if row["better"] == "less" else (old, row["value"])
            if now > then * (1 + NOISE):
                found.append(f"{name}: {row['value']} was {old}")
        return found


def milliseconds(command):
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return 1000 * (time.perf_counter() - start)


def paired(commands, runs, outputs=()):
    """Medians of commands that take turns, so that all see the same noise. None finds an output
    of the one before: to drop a large file's pages takes longer than to write a small one."""
    times = {name: [] for name in commands}
    for _ in range(runs):
        for name, command in commands.items():
            for path in outputs:
                path.unlink(missing_ok=True)
            times[name].append(milliseconds(command))
    return {name: statistics.median(values) for name, values in times.items()}


def whole_process(program, folder, runs, ratios):
    sketch = ROOT / "examples/cat.svg"
    build = [program, "build", str(sketch), "--quiet"]
    model = folder / "cat.vdb"
    files = ["-o", str(model), "-o", str(folder / "cat.ply")]
    subprocess.run(build + files, check=True)
    copy = folder / "copy.vdb"
    shutil.copy(model, copy)
    commands = {"cat at 256 to .vdb and .ply": build + files,
                "start and end (--version)": [program, "--version"]}
    if shutil.which("vdb_tool"):
        commands["vdb_tool, .vdb to .ply"] = ["vdb_tool", "-read", str(copy), "-ls2mesh", "-write",
                                              str(folder / "peer.ply")]
    loader = ROOT / "build/release/bin/load_openimageio"
    picture = build + files + ["--resolution", "512", "-o", str(folder / "cat.png")]
    help_text = subprocess.run([program, "build", "--help"], capture_output=True, text=True).stdout
    if "--picture-size" in help_text:
        picture += ["--picture-size", "256"]
    commands["cat at 512 with a picture"] = picture
    if loader.exists():
        commands["loading OpenImageIO"] = [str(loader)]
    medians = paired(commands, runs, [folder / name for name in
                                      ("cat.vdb", "cat.ply", "cat.png", "peer.ply")])
    print("whole processes, ms")
    for name, value in medians.items():
        print(f"  {name:40} {value:8.1f}")
    if "vdb_tool, .vdb to .ply" in medians:
        ratios.add("cat at 256 / vdb_tool's conversion",
                   medians["cat at 256 to .vdb and .ply"] / medians["vdb_tool, .vdb to .ply"], 1.2, "less")
    if "loading OpenImageIO" in medians:
        ratios.add("cat at 512 with a picture / loading OpenImageIO",
                   medians["cat at 512 with a picture"] / medians["loading OpenImageIO"], 1, "less")


def stages(program, folder, runs):
    report = folder / "cat.json"
    command = [program, "build", str(ROOT / "examples/cat.svg"), "--quiet", "-o", str(folder / "m.vdb"), "-o",
               str(folder / "m.ply"), "-o", str(report)]
    found = {}
    for _ in range(runs):
        subprocess.run(command, check=True)
        for stage, value in json.loads(report.read_text())["timings_ms"].items():
            found.setdefault(stage, []).append(value)
    print("stages of the cat at 256, ms")
    for stage, values in found.items():
        print(f"  {stage:40} {statistics.median(values):8.1f}")


def flying_edges(dense, runs):
    """VTK's time for the dense grid, in ms; None without VTK."""
    script = f"""
import statistics, sys, time
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
size = numpy.fromfile({str(dense)!r}, numpy.int32, 3)
values = numpy.fromfile({str(dense)!r}, numpy.float32, offset=12)
image = vtkImageData()
image.SetDimensions(int(size[2]), int(size[1]), int(size[0]))
image.GetPointData().SetScalars(numpy_to_vtk(values))
times = []
for _ in range({runs}):
    edges = vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 1)
    edges.ComputeNormalsOff()
    start = time.perf_counter()
    edges.Update()
    times.append(1000 * (time.perf_counter() - start))
print(statistics.median(times))
"""
    result = subprocess.run(["/usr/bin/python3", "-c", script], capture_output=True, text=True)
    return float(result.stdout) if result.returncode == 0 else None


def cgal(resolution):
    """CGAL's implicit mesher: its time in ms and its vertices; None where it is not built."""
    program = ROOT / "build/release/bin/bench_cgal"
    if not program.exists():
        return None
    return json.loads(subprocess.run([program, BODY, str(resolution)], check=True, capture_output=True, text=True).stdout)


def on_one_body(folder, resolutions, runs, ratios):
    program = ROOT / "build/release/bin/bench_peers"
    if not program.exists():
        print("bench_peers is not built: configure with -DLASCAUX_BENCH=ON")
        return
    dense = folder / "dense.bin"
    order = sorted(resolutions, key=lambda r: r != 512)  # the dense grid is the first one's
    output = subprocess.run([program, BODY, *map(str, order), "--dense", dense], check=True, capture_output=True,
                            text=True).stdout
    result = json.loads(output)
    print(f"animal.txt, ms; the processor does {result['operations_per_ms'] / 1e6:.0f} G operations/s")
    for run in sorted(result["runs"], key=lambda r: r["resolution"]):
        ms = run["ms"]
        print(f"  {run['resolution']}: {run['active_voxels']} active voxels, {run['triangles']} triangles")
        print("    " + ", ".join(f"{name} {value:.1f}" for name, value in ms.items()))
        at = f"at {run['resolution']}"
        if "floor" in ms:
            ratios.add(f"field in blocks / floor {at}", ms["blocks"] / ms["floor"], 3 if run["resolution"] > 1000 else 5,
                       "less")
        ratios.add(f"one thread / two {at}", ms["rasterise_one_thread"] / ms["rasterise"], 1.8, "more")
        if run["resolution"] == 512:
            ratios.add(f"vertices from the exact surface {at}, voxels", run["vertex_distance"], 0.02, "less")
        ratios.add(f"volumeToMesh / mesh {at}", ms["volume_to_mesh"] / ms["mesh"], 5, "more")
        ours = ms["blocks"] + ms["mesh"]
        if "particles" in ms:
            ratios.add(f"ParticlesToLevelSet + volumeToMesh / ours {at}",
                       (ms["particles"] + ms["particles_mesh"]) / ours, 10, "more")
        if run["resolution"] == 256 and (peer := cgal(256)):
            print(f"    CGAL {peer['ms']:.0f} for {peer['vertices']} vertices")
            ratios.add(f"CGAL's implicit mesher / ours {at}", peer["ms"] / ours, 100, "more")
        if run["resolution"] == 512 and "dense" in ms:
            edges = flying_edges(dense, runs)
            if edges is None:
                print("  VTK for Python is not there: no flying edges")
            else:
                print(f"    flying edges {edges:.1f}")
                ratios.add(f"dense + flying edges / ours {at}", (ms["dense"] + edges) / ours, 15, "more")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=11)
    parser.add_argument("--resolutions", default="256,512,2048")
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/lascaux"))
    parser.add_argument("--compare", action="store_true", help="with bench/baseline.json")
    parser.add_argument("--record", action="store_true", help="write the ratios to bench/baseline.json")
    arguments = parser.parse_args()
    ratios = Ratios()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        stages(arguments.program, folder, arguments.runs)
        whole_process(arguments.program, folder, arguments.runs, ratios)
        on_one_body(folder, [int(r) for r in arguments.resolutions.split(",")], arguments.runs, ratios)
    print("ratios")
    ratios.show()
    if arguments.record:
        BASELINE.write_text(json.dumps(ratios.rows, indent=1) + "\n")
        return 0
    worse = ratios.worse_than(json.loads(BASELINE.read_text())) if arguments.compare else []
    for line in worse:
        print("worse than the baseline:", line)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
