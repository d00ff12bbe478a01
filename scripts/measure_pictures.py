#!/usr/bin/env python3
"""Compares pictures of drawings with the drawings: each SVG is rasterised, traced, built, and judged like the SVG itself.

    scripts/measure_pictures.py --judge PATH/judge.py FOLDER or SKETCH.svg ... [--pixels 1000]

Two rows a drawing, the drawn curves and the traced ones, both compared with the truth beside the drawing. Needs rsvg-convert
(librsvg2-bin). The judge is called as measure.py says.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from concurrent.futures import ThreadPoolExecutor

import measure
from drawings import drawings_in


def viewport(sketch):
    """x, y, width and height of the user units that the picture shows."""
    root = ElementTree.parse(sketch).getroot()
    box = re.split(r"[\s,]+", root.get("viewBox", "").strip())
    if len(box) == 4:
        return tuple(map(float, box))
    return (0.0, 0.0, *(float(re.match(r"[\d.]+", root.get(name)).group()) for name in ("width", "height")))


def traced(sketch, arguments, folder):
    """The curves of a picture of the sketch, in the sketch's own units, with its truth beside them."""
    picture, curves = folder / f"{sketch.stem}.traced.png", folder / f"{sketch.stem}.svg"
    subprocess.run(["rsvg-convert", "-w", str(arguments.pixels), "--keep-aspect-ratio", "-b", "white", sketch, "-o", picture],
                   check=True, capture_output=True)
    trace = subprocess.run([arguments.program, "trace", picture, "-o", curves], capture_output=True, text=True)
    if trace.returncode:
        raise RuntimeError(trace.stderr.strip().splitlines()[-1].split(": ", 1)[-1])
    x, y, width, height = viewport(sketch)
    text = curves.read_text()
    scale = width / float(re.search(r'viewBox="\S+ \S+ (\S+)', text).group(1))
    text = re.sub(r'viewBox="[^"]*"', f'viewBox="{x} {y} {width} {height}"', text, count=1)
    curves.write_text(text.replace("<g ", f'<g transform="translate({x} {y}) scale({scale})" ', 1))
    if sketch.with_suffix(".json").exists():
        shutil.copy(sketch.with_suffix(".json"), curves.with_suffix(".json"))
    return curves


def both(sketch, arguments, folder):
    """What the judge says of the drawn curves and of the traced ones."""
    drawn = measure.measure(sketch, arguments, folder / "drawn")
    try:
        curves = traced(sketch, arguments, folder / "curves")
    except (RuntimeError, subprocess.CalledProcessError) as failure:
        return drawn, {"failed": f"trace: {failure}"}
    return drawn, measure.measure(curves, arguments, folder / "built")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawings", nargs="+", type=pathlib.Path, help="folders, or SVG files")
    parser.add_argument("--judge", required=True)
    parser.add_argument("--python", default="/usr/bin/python3", help="the judge's interpreter")
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parent.parent / "build/release/bin/lascaux"))
    parser.add_argument("--resolution", type=int, default=64)
    parser.add_argument("--pixels", type=int, default=1000, help="width of the pictures")
    parser.add_argument("--options", default="", help="more options for the build")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for pictures, curves, meshes, previews and parses")
    arguments = parser.parse_args()
    sketches = drawings_in(arguments.drawings)
    results = ([], [])
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(2) as pool:
        folder = arguments.keep or pathlib.Path(temporary)
        for name in ("drawn", "curves", "built"):
            (folder / name).mkdir(parents=True, exist_ok=True)
        print("  ".join([f"{'drawing':28}"] + [h.rjust(max(6, len(h))) for h in measure.HEADERS]))
        for sketch, pair in zip(sketches, pool.map(lambda s: both(s, arguments, folder), sketches)):
            for kind, facts, kept in zip(("", " traced"), pair, results):
                kept.append(facts)
                name = sketch.stem[:20] + kind
                print(f"{name:28.28}  {facts['failed'][:130]}" if "failed" in facts else measure.row(name, facts), flush=True)
    for kind, kept in zip(("drawn", "traced"), results):
        built = [facts for facts in kept if "failed" not in facts]
        scored = sum(facts.get("structure") or 0.0 for facts in built) / max(1, len(kept))
        print(measure.row(f"mean, {kind}", measure.means(built)))
        print(f"{kind}: built {len(built)} of {len(kept)}; mean structure over all, 0 for those not built: {scored:.3f}")


if __name__ == "__main__":
    sys.exit(main())
