#!/usr/bin/env python3
"""Where the time goes: medians of a build's stages, from its own reports, and of the whole process.

    scripts/timings.py [SKETCH.svg] [--runs 15] [--resolution 256] [--threads N]

"process" is the wall time from starting the program to its end with .vdb and .stl on disk; "with preview" the same with the
picture, too.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def run(arguments, outputs):
    command = [arguments.program, "build", str(arguments.sketch), "--resolution",
               str(arguments.resolution), "--quiet"]
    if arguments.threads:
        command += ["--threads", str(arguments.threads)]
    for output in outputs:
        command += ["-o", str(output)]
    start = time.perf_counter()
    subprocess.run(command, check=True)
    return 1000 * (time.perf_counter() - start)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sketch", nargs="?", type=pathlib.Path, default=ROOT / "examples/cat.svg")
    parser.add_argument("--runs", type=int, default=15)
    parser.add_argument("--resolution", type=int, default=256)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/lascaux"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        models = [folder / "m.vdb", folder / "m.stl"]
        report, picture = folder / "m.json", folder / "m.png"
        stages, plain, pictured = {}, [], []
        for _ in range(arguments.runs):
            plain.append(run(arguments, models))
            run(arguments, models + [report])
            for stage, milliseconds in json.loads(report.read_text())["timings_ms"].items():
                stages.setdefault(stage, []).append(milliseconds)
            pictured.append(run(arguments, models + [picture]))
    print(f"{arguments.sketch.name} at {arguments.resolution} voxels, medians of {arguments.runs} runs")
    for stage, values in stages.items():
        print(f"  {stage:12} {statistics.median(values):8.1f} ms")
    print(f"  {'process':12} {statistics.median(plain):8.1f} ms")
    print(f"  {'with preview':12} {statistics.median(pictured):8.1f} ms")


if __name__ == "__main__":
    main()
