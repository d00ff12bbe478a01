#!/usr/bin/python3
"""Has every format of every example read by programs that are not ours, and the zoo of broken meshes by other checkers; prints
the tables of docs/formats.md, or writes them there.

    scripts/formats_table.py                      prints the tables
    scripts/formats_table.py --write              replaces them in docs/formats.md
    scripts/formats_table.py --examples cat,dog   only these

Needs what scripts/setup.sh and scripts/outside_readers.sh install and, for all columns,

    apt-get install prusa-slicer openexr pngcheck python3-meshio
    npm install --prefix build/manifold manifold-3d

What is missing is shown as such. Not part of the tests: it takes some minutes.
"""
import argparse
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "tests/outside"))
import zoo

PAGE = SOURCE / "docs/formats.md"
PROGRAM = SOURCE / "build/release/bin/lascaux"
MODULES = SOURCE / "build/outside/node_modules"
MANIFOLD = SOURCE / "build/manifold/node_modules"
PATIENCE = 60  # seconds; admesh does not come back from an edge with four faces
REPAIRS = ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges")


class Missing(Exception):
    pass


def run(*command):
    """Exit code and all that it said."""
    if shutil.which(str(command[0])) is None:
        raise Missing(command[0])
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=PATIENCE, errors="replace")
    except subprocess.TimeoutExpired:
        return 124, "hangs"
    return done.returncode, done.stdout + done.stderr


def python(code, path):
    return run("/usr/bin/python3", "-c", code, path)


def says_nothing_bad(outcome):
    code, text = outcome
    return code == 0 and not re.search(r"error|warning|fail", text, re.I)


def admesh(path, repairs=(*REPAIRS, "Normals fixed")):
    code, text = run("admesh", path)
    counts = [int(n) for what in repairs for n in re.findall(what + r"\s*:\s*(\d+)", text)]
    return code == 0 and len(counts) == len(repairs) and not any(counts) and \
        bool(re.search(r"Number of parts\s*:\s*1\b", text))


def assimp(path):
    code, text = run("assimp", "info", path)
    return code == 0 and int(re.search(r"Faces:\s*(\d+)", text)[1]) > 1000


def prusa(path):
    code, text = run("prusa-slicer", "--info", path)
    return code == 0 and "manifold = yes" in text


def npm(kind, path):
    if not MODULES.is_dir():
        raise Missing(MODULES)
    code, text = run("node", SOURCE / "tests/outside/readers.mjs", MODULES, kind, path)
    return json.loads(text) if code == 0 else {}


def gltf(path):
    return npm("gltf", path).get("issues", {}).get("messages") == []


def usd(path):
    return len(npm("usd", path).get("meshes", [])) == 1


def lib3mf(path):
    import lib3mf as reader
    package = reader.Package(path)
    return package.warnings == 0 and len(package.objects) == 1 and package.objects[0]["closed"]


def meshio(path):
    if python("import meshio", path)[0]:
        raise Missing("meshio")
    return python("import meshio, sys; m = meshio.read(sys.argv[1]); assert len(m.cells_dict['triangle']) > 1000",
                  path)[0] == 0


def openvdb(path):
    return python("import pyopenvdb as v, sys; g = v.read(sys.argv[1], 'surface');"
                  "assert g.gridClass == 'level set' and len(g.convertToQuads()[0]) > 1000", path)[0] == 0


def vdb_print(path):
    code, text = run("vdb_print", "-l", path)
    return code == 0 and "class: level set" in text


def vdb_tool(path):
    return run("vdb_tool", "-read", path, "-print")[0] == 0


def manifold_of(corners, faces):
    """Does Manifold take it as a solid?"""
    if not MANIFOLD.is_dir():
        raise Missing(MANIFOLD)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"corners": corners, "faces": faces}, file)
        file.flush()
        return run("node", SOURCE / "tests/outside/manifold.mjs", MANIFOLD, file.name)[0] == 0


def manifold(path):
    corners, faces = [], []
    for line in path.read_text().splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            corners.append([float(x) for x in rest[:3]])
        elif kind == "f":
            faces.append([int(x.split("/")[0]) - 1 for x in rest])
    return manifold_of(corners, faces)


READERS = {
    ".vdb": {"pyopenvdb": openvdb, "vdb_print": vdb_print, "vdb_tool": vdb_tool},
    ".stl": {"admesh": admesh, "PrusaSlicer --info": prusa, "assimp": assimp, "meshio": meshio},
    ".3mf": {"lib3mf": lib3mf, "PrusaSlicer --info": prusa, "assimp": assimp},
    ".glb": {"gltf-validator": gltf, "assimp": assimp},
    ".obj": {"manifold-3d": manifold, "PrusaSlicer --info": prusa, "assimp": assimp, "meshio": meshio},
    ".ply": {"assimp": assimp, "vdb_tool": vdb_tool, "meshio": meshio},
    ".usda": {"tinyusdz": usd},
    ".png": {"pngcheck": lambda p: says_nothing_bad(run("pngcheck", "-q", p)), "iinfo": lambda p: run("iinfo", p)[0] == 0},
    ".exr": {"exrheader": lambda p: run("exrheader", p)[0] == 0, "iinfo": lambda p: run("iinfo", p)[0] == 0},
}


def slice_cat(folder):
    """The cat's .3mf to G-code: passes when nothing is complained of."""
    gcode = folder / "cat.gcode"
    code, text = run("prusa-slicer", "--export-gcode", "--output", gcode, folder / "cat.3mf")
    complaints = [line for line in text.splitlines() if re.search(r"warning|error|repair|unstable|stability", line, re.I)]
    return code == 0 and gcode.stat().st_size > 10000 and not complaints, complaints


def table_of_readers(examples):
    rows = ["| format | reader | examples that pass |", "|---|---|---|"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for example in examples:
            outputs = [a for ending in READERS for a in ("-o", folder / (example + ending))]
            code, text = run(PROGRAM, "build", SOURCE / f"examples/{example}.svg", "--quiet", *outputs)
            assert code == 0, text
        for ending, readers in READERS.items():
            for reader, passes in readers.items():
                try:
                    failing = [e for e in examples if not passes(folder / (e + ending))]
                except Missing:
                    rows.append(f"| `{ending}` | {reader} | not installed |")
                    continue
                names = ": not " + ", ".join(failing) if 0 < len(failing) < len(examples) else ""
                rows.append(f"| `{ending}` | {reader} | {len(examples) - len(failing)} of {len(examples)}{names} |")
                print(rows[-1], file=sys.stderr, flush=True)
        if "cat" in examples:
            try:
                good, complaints = slice_cat(folder)
                rows.append("| `.3mf` | PrusaSlicer, to G-code | cat: " +
                            ("without a warning |" if good else f"no: {'; '.join(complaints)[:200]} |"))
            except Missing:
                rows.append("| `.3mf` | PrusaSlicer, to G-code | not installed |")
    return rows


def admesh_of_the_zoo(path):
    return admesh(path, REPAIRS)  # whose files have no normals


def ours(path):
    report = path.with_suffix(".json")
    run(PROGRAM, "check", path, "-o", report)
    if not report.exists():
        return False
    return json.loads(report.read_text())["printable"]


def table_of_the_zoo():
    rows = ["| mesh | lascaux check | admesh | PrusaSlicer | Manifold |", "|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as name:
        for title, (mesh, _) in zoo.zoo().items():
            path = Path(name) / title.replace(" ", "-")
            checks = ((ours, ".ply", zoo.write_ply), (admesh_of_the_zoo, ".stl", zoo.write_stl), (prusa, ".3mf", zoo.write_3mf))
            words = []
            for check, ending, write in checks:
                try:
                    write(path.with_suffix(ending), mesh)
                    words.append("passes" if check(path.with_suffix(ending)) else "fails")
                except Missing:
                    words.append("not installed")
                except (IndexError, AttributeError):  # no such corner; nothing said
                    words.append("can't be written" if ending == ".stl" else "fails")
            try:
                words.append("passes" if manifold_of(*mesh) else "fails")
            except Missing:
                words.append("not installed")
            rows.append(f"| {title} | {' | '.join(words)} |")
            print(rows[-1], file=sys.stderr, flush=True)
    return rows


def replace(page, mark, rows):
    pattern = re.compile(rf"(<!-- {mark} -->\n).*?(<!-- end -->)", re.S)
    assert pattern.search(page), f"no place for {mark}"
    return pattern.sub(lambda found: found[1] + "\n".join(rows) + "\n" + found[2], page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--examples", default="")
    options = parser.parse_args()
    examples = options.examples.split(",") if options.examples else sorted(
        path.stem for path in (SOURCE / "examples").glob("*.svg"))
    tables = {"readers": table_of_readers(examples), "zoo": table_of_the_zoo()}
    if not options.write:
        print("\n\n".join("\n".join(rows) for rows in tables.values()))
        return
    page = PAGE.read_text()
    for mark, rows in tables.items():
        page = replace(page, mark, rows)
    PAGE.write_text(page)


if __name__ == "__main__":
    main()
