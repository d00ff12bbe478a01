#!/usr/bin/env python3
"""Builds every drawing of some folders and asks an outside judge how good the models are: a row a drawing, and the means.

    scripts/measure.py --judge PATH/judge.py examples [FOLDER or SKETCH.svg ...]

The judge is a program that is called as `judge.py SKETCH.svg MESH.stl REPORT.json --json [--truth TRUTH.json]` and prints one JSON
object. The truth is the .json of the same name beside the drawing, if there is one. What the judge calls misses is
printed below each row with --misses.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from drawings import drawings_in

COLUMNS = (("structure", "{:.3f}"), ("depth", "{:.3f}"), ("contour_mean", "{:.3f}"),
           ("contour_p95", "{:.3f}"), ("iou", "{:.4f}"), ("symmetry", "{:.4f}"),
           ("watertight", "{:.0f}"), ("components", "{:.0f}"), ("extra_parts", "{:.0f}"))
HEADERS = ("structure", "depth", "mean %", "p95 %", "IoU", "symm %", "solid", "pieces", "extra")


def measure(sketch, arguments, folder):
    """The judge's facts, or {"failed": why}."""
    mesh, report = folder / f"{sketch.stem}.stl", folder / f"{sketch.stem}.json"
    outputs = ["-o", mesh, "-o", report]
    if arguments.keep:
        outputs += ["-o", folder / f"{sketch.stem}.png", "-o", folder / f"{sketch.stem}.svg"]
    build = subprocess.run([arguments.program, "build", sketch, *outputs, "--resolution",
                            str(arguments.resolution), "--quiet", *arguments.options.split()],
                           capture_output=True, text=True)
    if build.returncode:
        lines = build.stderr.strip().splitlines() or [""]
        return {"failed": f"exit {build.returncode}: {lines[-1].split(': ', 1)[-1]}"}
    command = [arguments.python, arguments.judge, sketch, mesh, report, "--json"]
    truth = sketch.with_suffix(".json")
    if truth.exists():
        command += ["--truth", truth]
    judged = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if judged.returncode:
        return {"failed": "judge: " + (judged.stderr.strip().splitlines() or ["?"])[-1]}
    facts = json.loads(judged.stdout)
    facts["warnings"] = build.stderr.count(": warning: ")
    return facts


def row(name, facts):
    cells = [f"{name:28.28}"]
    for (key, form), header in zip(COLUMNS, HEADERS):
        value = facts.get(key)
        cells.append((form.format(value) if value is not None else "-").rjust(max(6, len(header))))
    return "  ".join(cells)


def means(results):
    """The mean of each figure over the drawings that have it."""
    mean = {}
    for key, _ in COLUMNS:
        values = [float(facts[key]) for facts in results if facts.get(key) is not None]
        mean[key] = sum(values) / len(values) if values else None
    return mean


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawings", nargs="+", type=pathlib.Path, help="folders, or SVG files")
    parser.add_argument("--judge", required=True)
    parser.add_argument("--python", default="/usr/bin/python3", help="the judge's interpreter")
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parent.parent /
                                                 "build/release/bin/lascaux"))
    parser.add_argument("--resolution", type=int, default=256)
    parser.add_argument("--options", default="", help="more options for the build, as in --options='--fit none'")
    parser.add_argument("--misses", action="store_true", help="what is wrong, below each row")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for meshes, previews and parses")
    arguments = parser.parse_args()
    sketches = drawings_in(arguments.drawings)
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(2) as pool:
        folder = arguments.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print("  ".join([f"{'drawing':28}"] + [h.rjust(max(6, len(h))) for h in HEADERS]))
        results = []
        for sketch, facts in zip(sketches, pool.map(lambda s: measure(s, arguments, folder), sketches)):
            results.append(facts)
            print(row(sketch.stem, facts) if "failed" not in facts else
                  f"{sketch.stem:28.28}  {facts['failed'][:160]}", flush=True)
            for miss in (facts.get("misses", []) + facts.get("depth_misses", [])) * arguments.misses:
                print(f"    {miss}")
    built = [facts for facts in results if "failed" not in facts]
    print(row("mean of those built", means(built)))
    scored = [facts.get("structure", 0.0) if "failed" not in facts else 0.0 for facts in results]
    print(f"built {len(built)} of {len(results)}; mean structure over all, 0 for those not built: "
          f"{sum(scored) / max(1, len(scored)):.3f}")
    return 0 if len(built) == len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
