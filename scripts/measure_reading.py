#!/usr/bin/env python3
"""Shows how each drawing of some folders is read: a row a drawing. Nothing is built.

    scripts/measure_reading.py FOLDER or SKETCH.svg ... [--originals FOLDER] [--sheet PICTURE.png]

A drawing NAME__VARIANT.svg is compared with NAME.svg of the folder --originals: "curves" when both have the same strokes in some
order and direction, "structure" when parts have the same roles and relations, else how many parts differ.
--sheet puts the parse pictures onto one contact sheet (with rsvg-convert and montage).
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

from drawings import drawings_in


def inspect(program, sketch, folder):
    """The parse of a drawing and its picture, or what the program says."""
    dump, picture = folder / f"{sketch.stem}.json", folder / f"{sketch.stem}.svg"
    run = subprocess.run([program, "inspect", sketch, "-o", dump, "-o", picture, "--quiet"],
                         capture_output=True, text=True)
    lines = run.stderr.strip().splitlines() or [""]
    parse = json.loads(dump.read_text()) if dump.exists() else None
    return run.returncode, parse, lines[-1].split(": ", 1)[-1]


def roles(parse):
    """How many parts have which role and relation, with or without a partner."""
    return collections.Counter((node["role"], node["relation"], node["pair"] is not None)
                               for node in parse["graph"]["nodes"] if node["role"] != "ignored")


def curves(parse):
    """The strokes as a set that knows no order and no direction, rounded to a 1e-5th of the size."""
    pieces = [piece for stroke in parse["strokes"] for piece in stroke["pieces"]]
    xs = [point[0] for piece in pieces for point in piece]
    unit = 1e-5 * max(1e-300, max(xs) - min(xs))
    rounded = [tuple(tuple(round(c / unit) for c in point) for point in piece) for piece in pieces]
    return collections.Counter(min(piece, piece[::-1]) for piece in rounded)


def comparison(parse, original):
    if not parse or not original or "graph" not in parse or "graph" not in original:
        return "-"
    same_curves = "curves" if curves(parse) == curves(original) else ""
    a, b = roles(parse), roles(original)
    differ = sum(((a - b) + (b - a)).values())
    return f"{same_curves} {'structure' if not differ else f'{differ} parts differ'}".strip()


def row(sketch, code, parse, message, versus):
    count = collections.Counter(d["code"] for d in parse["diagnostics"]) if parse else {}
    graph = parse.get("graph") if parse else None
    nodes = graph["nodes"] if graph else []
    by_role = collections.Counter(node["role"] for node in nodes)
    limbs = [node for node in nodes if node["role"] == "foreground" and node["relation"] == "over"]
    cells = [f"{sketch.stem:44.44}", f"{code:4}", f"{len(parse['strokes']) if parse else 0:7}",
             f"{count.get('gap-closed', 0):4}", f"{count.get('slit-closed', 0):5}",
             f"{sum(by_role.values()) - by_role['ignored']:5}", f"{len(limbs):5}",
             f"{sum(node['pair'] is not None for node in limbs):6}", f"{by_role['island']:7}"]
    return "  ".join(cells) + "  " + (versus if code == 0 else message[:150])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawings", nargs="+", type=pathlib.Path, help="folders, or SVG files")
    parser.add_argument("--originals", type=pathlib.Path)
    parser.add_argument("--sheet", type=pathlib.Path, help="a picture to write")
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parent.parent /
                                                 "build/release/bin/lascaux"))
    arguments = parser.parse_args()
    sketches = drawings_in(arguments.drawings)
    print("  ".join([f"{'drawing':44}", "exit", "strokes", "gaps", "slits", "parts", "limbs",
                     "paired", "islands", "same as the original, or why not"]))
    read = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for sketch in sketches:
            code, parse, message = inspect(arguments.program, sketch, folder)
            read += code == 0
            versus = ""
            original = arguments.originals and arguments.originals / (sketch.stem.split("__")[0] + ".svg")
            if original and original != sketch and original.exists():
                (folder / "original").mkdir(exist_ok=True)
                versus = comparison(parse, inspect(arguments.program, original,
                                                   folder / "original")[1])
            print(row(sketch, code, parse, message, versus), flush=True)
        if arguments.sheet:
            for picture in folder.glob("*.svg"):
                subprocess.run(["rsvg-convert", "-w", "400", "-h", "400", "-a", picture, "-o",
                                picture.with_suffix(".png")], check=True)
            subprocess.run(["montage", *sorted(folder.glob("*.png")), "-geometry", "400x400+4+4",
                            "-tile", "6x", arguments.sheet], check=False, capture_output=True)
    print(f"read {read} of {len(sketches)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
