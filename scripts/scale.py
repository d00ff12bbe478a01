#!/usr/bin/env python3
"""How time and memory grow, as tables: with the resolution, the segments of the body, the strokes of a drawing, threads.

    scripts/scale.py [--largest 2048] [--program PATH]

Each row is one run of the program, or of bench_volume for the segments; memory is the peak of the process. The last
column is the exponent from the row before: 2 for what costs what its surface costs.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CAT = ROOT / "examples/cat.svg"


def measure(command):
    """Seconds, and the peak of memory in MiB, of one process."""
    code = ("import resource, subprocess, sys, time; s = time.perf_counter(); "
            "r = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True); "
            "print(time.perf_counter() - s, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024, "
            "r.returncode); sys.stderr.write(r.stderr)")
    found = subprocess.run([sys.executable, "-c", code, *map(str, command)], capture_output=True, text=True, check=True)
    seconds, memory, status = found.stdout.split()
    return float(seconds), float(memory), int(status), found.stderr


def row(label, value, seconds, memory, last):
    exponent = ""
    if last:
        exponent = f"{math.log(seconds / last[1]) / math.log(value / last[0]):6.2f}"
    print(f"| {label} | {1000 * seconds:.0f} | {memory:.0f} | {exponent} |", flush=True)
    return value, seconds


def by_resolution(program, largest, folder):
    print("\n| voxels along the cat | ms | MiB | exponent |\n|---|---|---|---|")
    last, resolution = None, 128
    while resolution <= largest:
        outputs = ["-o", folder / "a.vdb", "-o", folder / "a.ply"]
        seconds, memory, status, message = measure([program, "build", CAT, "--quiet", "--resolution", resolution, *outputs])
        if status != 0:
            print(f"| {resolution} | refused: {message.strip()} | | |")
            return
        last = row(resolution, resolution, seconds, memory, last)
        resolution *= 2


def by_threads(program, folder):
    print("\n| threads, cat at 512 | ms | MiB | exponent |\n|---|---|---|---|")
    last = None
    for threads in (1, 2):
        seconds, memory, *_ = measure([program, "build", CAT, "--quiet", "--resolution", 512, "--threads", threads, "-o",
                                       folder / "a.ply"])
        last = row(threads, threads, seconds, memory, last)


def comb(strokes):
    """A drawing of a body with more and more spines: each is a stroke, and a part."""
    spines = strokes - 1
    paths = ['<path d="M0,100 C0,40 400,40 400,100 C400,160 0,160 0,100 Z"/>']
    for i in range(spines):
        x = 60 + 280 * i / max(1, spines)
        half = 100 / spines
        paths.append(f'<path d="M{x:.3f},70 L{x + half:.3f},10 L{x + 2 * half:.3f},70"/>')
    return ('<svg xmlns="http://www.w3.org/2000/svg" width="400" height="200"><g fill="none" stroke="black">'
            + "".join(paths) + "</g></svg>")


def by_strokes(program, folder):
    print("\n| strokes (one body, spines), `inspect` | ms | MiB | exponent |\n|---|---|---|---|")
    last = None
    for strokes in (11, 41, 161):
        sketch = folder / "comb.svg"
        sketch.write_text(comb(strokes))
        seconds, memory, *_ = measure([program, "inspect", sketch, "--quiet", "-o", folder / "a.svg"])
        last = row(strokes, strokes, seconds, memory, last)


def by_points(program, folder):
    print("\n| points of one outline, `inspect` | ms | MiB | exponent |\n|---|---|---|---|")
    last = None
    for points in (500, 5000, 50000):
        ring = [(200 + (150 + 5 * math.sin(40 * a)) * math.cos(a), 150 + (90 + 5 * math.sin(40 * a)) * math.sin(a))
                for a in (2 * math.pi * i / points for i in range(points))]
        sketch = folder / "ring.svg"
        sketch.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="400" height="300"><path fill="none" '
                          'stroke="black" d="M' + " L".join(f"{x:.4f},{y:.4f}" for x, y in ring) + ' Z"/></svg>')
        seconds, memory, *_ = measure([program, "inspect", sketch, "--quiet", "-o", folder / "a.svg"])
        last = row(points, points, seconds, memory, last)


def by_segments(folder):
    program = ROOT / "build/release/bin/bench_volume"
    if not program.exists():
        print("\nbench_volume is not built: no rows for segments")
        return
    print("\n| segments, animal.txt cut finer, 512 voxels | ms | MiB | exponent |\n|---|---|---|---|")
    last = None
    lines = [line.split() for line in (ROOT / "bench/data/animal.txt").read_text().splitlines() if line[0] != "#"]
    for pieces in (1, 3, 10):
        body = folder / "body.txt"
        with body.open("w") as file:
            for words in lines:
                a, b = [float(w) for w in words[:4]], [float(w) for w in words[4:8]]
                for k in range(pieces):
                    ends = [x + (y - x) * t / pieces for t in (k, k + 1) for x, y in zip(a, b)]
                    file.write(" ".join(map(str, ends)) + f" {words[8]}\n")
        seconds, memory, status, text = measure([program, body, "--benchmark_filter=BM_Rasterise/512/"
                                                 , "--benchmark_format=json", f"--benchmark_out={folder / 'out.json'}"])
        benchmark = json.loads((folder / "out.json").read_text())["benchmarks"][0]
        last = row(len(lines) * pieces, pieces, benchmark["real_time"] / 1000, memory, last)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--largest", type=int, default=2048)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/lascaux"))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        by_resolution(arguments.program, arguments.largest, folder)
        by_threads(arguments.program, folder)
        by_segments(folder)
        by_strokes(arguments.program, folder)
        by_points(arguments.program, folder)


if __name__ == "__main__":
    main()
