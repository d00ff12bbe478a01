#!/usr/bin/python3
"""Builds the side views of animals whose solids are known and compares the models with them.

    scripts/compare_solids.py MESHES --program build/release/bin/lascaux [--markdown docs/solids.md]

MESHES holds pairs NAME_sketch.svg, NAME.off. A solid's frame is that of its side view: x to the right, y up, z to the
viewer, longest side 1; where exactly the view lies on the sheet is found here. Each --variant NAME=ARGUMENTS is a
column: a build with these further arguments. Needs numpy and scipy.

The regions (torso, legs, ...) come from the known solid alone, whatever the program made of the drawing. All figures
are deterministic.
"""
import argparse
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.spatial import cKDTree

from solid_columns import (Grid, best_shift, depths, moved, outward, overlap, read_off, read_ply,
                           solid_spans, surface_distance, surface_points, visible)

KEPT = 0.6  # share of the outline that the registration believes: swung legs are elsewhere
TORSO_HEIGHTS = (0.6, 1.25)  # of the thickest place: slices between belong to the torso
OPENING = 0.55  # of the torso's half height: what is thinner is a leg, a neck or a tail
BELOW = 0.15  # of a slice's height may hang under it before it counts as a leg
LEVELS = (0.15, 0.85)  # share of a section's height at which belly and back are measured
FACTORS = np.round(np.arange(0.5, 1.5001, 0.02), 2)  # by which torsos are tried narrower or wider
REGIONS = ("torso", "head and neck", "legs", "rest")
OVERALL = """IoU is that of the volumes; distance is the mean between the surfaces, both ways, in percent of the
longest side; volume is the model's over the real one."""
SECTIONS = f"""the torso between the legs. Depth over height of its vertical sections; depth at {LEVELS[0]:.0%} (belly)
and {LEVELS[1]:.0%} (back) of a section's height as a share of the largest, 0.71 in an ellipse; the factor on the model's
depth that overlaps best."""
PLACES = """where volume is too much (+) or too little (-), in percent of the real animal's; then the legs, in percent of
the longest side, where a real pair has air between: the distance of their middles, a leg's depth, and the distance of the
pair's outer faces over the torso's depth. Pairs counts the limbs, ears and fins that were read as such."""
MARKS = ("<!-- figures: scripts/compare_solids.py -->", "<!-- end of figures -->")


# ---- The drawing in the solid's frame -----------------------------------------------------------

def dense(ring, step):
    """Points along a closed ring, at most a step apart."""
    following = np.roll(ring, -1, 0)
    counts = np.maximum(np.ceil(np.linalg.norm(following - ring, axis=1) / step).astype(int), 1)
    return np.concatenate([p + (q - p) * (np.arange(n) / n)[:, None]
                           for p, q, n in zip(ring, following, counts)])


def silhouette_points(spans, grid):
    """Half way between columns that meet the solid and neighbours that don't."""
    mask = (depths(spans, grid) > 0).reshape(grid.shape)
    points = []
    for axis in (0, 1):
        i, j = np.nonzero(np.diff(mask.astype(np.int8), axis=axis))
        points.append(grid.low + grid.step * (np.stack([i, j], 1) + 0.5 * np.eye(2)[axis]))
    return np.concatenate(points)


def register(outlines, points, solid):
    """Scale and shift from the sheet (y up) to the solid's frame: the outlines' bounds first, then
    trimmed iterated closest points, from the solid's outline to the lines."""
    step = 1e-3 * np.ptp(np.concatenate(outlines), 0).max()
    lines = np.concatenate([dense(ring, step) for ring in outlines])
    low, high = solid.min((0, 1))[:2], solid.max((0, 1))[:2]
    scale = (high - low).max() / np.ptp(lines, 0).max()
    shift = 0.5 * (low + high) - scale * 0.5 * (lines.min(0) + lines.max(0))
    for _ in range(60):
        distance, nearest = cKDTree(lines * scale + shift).query(points)
        kept = distance <= np.quantile(distance, KEPT)
        source, target = lines[nearest[kept]], points[kept]
        centre, goal = source.mean(0), target.mean(0)
        scale = ((source - centre) * (target - goal)).sum() / ((source - centre)**2).sum()
        shift = goal - scale * centre
    return scale, shift


def rings_of(report, roles):
    """Outlines of the parts with these roles, y up."""
    return [np.array(ring) * [1, -1] for part in report["parts"] if part["role"] in roles
            for ring in part["outlines"] if len(ring) > 2]


def torso_slices(mask, rear, grid):
    """The torso in a side view: thin things are opened away; then the vertical slices around the
    thickest place outside the front third whose heights are like its own. Second, those of them
    that no leg stands under, and if there are legs at both ends, those between."""
    room = distance_transform_edt(mask)
    thick = distance_transform_edt(room < OPENING * room[rear & mask].max())
    thick = mask & (thick < OPENING * room[rear & mask].max())
    middle, start = np.unravel_index(np.argmax(np.where(rear, room, 0)), mask.shape)
    torso, free = np.zeros(mask.shape, bool), np.zeros(mask.shape[0], bool)
    for way in (range(middle, -1, -1), range(middle + 1, mask.shape[0])):
        at = start
        for i in way:
            if not thick[i, at]:
                break
            low, high = at, at
            while thick[i, low - 1]:
                low -= 1
            while thick[i, high + 1]:
                high += 1
            share = (high + 1 - low) / (2 * room[middle, start])
            if not TORSO_HEIGHTS[0] <= share <= TORSO_HEIGHTS[1]:
                break
            torso[i, low:high + 1] = True
            free[i] = mask[i, :low].sum() <= BELOW * (high + 1 - low)
            at = (low + high) // 2
    over_legs = np.flatnonzero(torso.any(1) & ~free)
    if over_legs.size and np.ptp(over_legs) > 0.3 * torso.any(1).sum():
        free[:over_legs[0]] = free[over_legs[-1]:] = False
    return torso.ravel(), (torso & free[:, None]).ravel()


def regions_of(truth, grid, looks_right):
    """Masks over the columns, from the known solid alone, and the torso without slices over legs."""
    mask = (depths(truth, grid) > 0).reshape(grid.shape)
    met = grid.x[mask.ravel()]
    along = (grid.x - met.min()) / np.ptp(met)
    rear = (along < 2 / 3 if looks_right else along > 1 / 3).reshape(grid.shape)
    torso, free = torso_slices(mask, rear, grid)
    ends = grid.x[torso].min(), grid.x[torso].max()
    front = grid.x > ends[1] if looks_right else grid.x < ends[0]
    belly = np.median([grid.y[torso & (grid.x == x)].min() for x in np.unique(grid.x[torso])])
    beside = 0.5 * np.ptp(grid.y[torso])
    legs = (grid.y < belly) & (grid.x > ends[0] - beside) & (grid.x < ends[1] + beside) & ~torso
    regions = {"torso": torso, "head and neck": front & ~legs, "legs": legs}
    regions["rest"] = ~np.any(list(regions.values()), axis=0)
    return regions, free


# ---- What is measured ---------------------------------------------------------------------------

def width(spans, grid):
    """Extent along z per column, empty spaces included; 0 outside."""
    low, high = np.full(grid.x.size, np.inf), np.full(grid.x.size, -np.inf)
    np.minimum.at(low, spans[0], spans[1])
    np.maximum.at(high, spans[0], spans[2])
    return np.where(high > low, high - low, 0).reshape(grid.shape)


def sections(spans, free, grid):
    """Of the torso's free slices: mean depth over height, the depth near belly and back as shares
    of the largest, and the largest."""
    wide, tall = width(spans, grid), free.reshape(grid.shape)
    figures = []
    for i in np.flatnonzero(tall.any(1)):
        rows = np.flatnonzero(tall[i])
        largest = wide[i, rows].max()
        if largest > 0:
            figures.append([largest / (rows.size * grid.step)] +
                           [wide[i, rows[int(level * rows.size)]] / largest for level in LEVELS] + [largest])
    return np.mean(figures, 0) if figures else [None] * (2 + len(LEVELS))


def middle_of(spans, columns):
    """The z of the plane of symmetry: the mean over the torso."""
    chosen = columns[spans[0]]
    length = (spans[2] - spans[1])[chosen]
    return (0.5 * (spans[1] + spans[2])[chosen] * length).sum() / length.sum()


def leg_figures(spans, legs):
    """Distance of a pair's legs (between their middles along z) and a leg's depth, means over the
    length of the spans on the viewer's side; 0 for legs in the plane of symmetry."""
    chosen = legs[spans[0]] & (spans[2] > 0)
    low, high = spans[1][chosen], spans[2][chosen]
    length = high - low
    if length.sum() == 0:
        return None, None
    apart = np.where(low > -0.25 * length, low + high, 0)
    return (apart * length).sum() / length.sum(), (length**2).sum() / length.sum()


def build(sketch, arguments, extra, folder):
    """Mesh and report, or the reason why there is none."""
    mesh, report = folder / "model.ply", folder / "model.json"
    command = [arguments.program, "build", sketch, "-o", mesh, "-o", report, "--units", "mm", "--quiet",
               *shlex.split(extra)]
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if run.returncode:
        return None, f"exit {run.returncode}: " + (run.stderr.strip().splitlines() or ["no message"])[-1]
    return (read_ply(mesh), json.loads(report.read_text())), None


def compare(real, model, report, looks_right):
    """Figures of one model against its solid, in shares of the longest side."""
    (xx, _, x0), (_, yy, y0) = report["model_from_sketch"]
    outer = rings_of(report, ("body", "sagittal", "foreground", "background"))
    bounds = Grid(real.min((0, 1))[:2], real.max((0, 1))[:2])
    spans, _ = solid_spans(real, bounds)
    scale, shift = register(outer, silhouette_points(spans, bounds), real)
    size = scale / xx
    model = model * size + [shift[0] - x0 * size, shift[1] - y0 * size, 0]  # sheet y is -yy times model y
    both = np.concatenate([real.reshape(-1, 3), model.reshape(-1, 3)])
    grid = Grid(both.min(0)[:2], both.max(0)[:2])
    (truth, holes), (made, _) = solid_spans(real, grid), solid_spans(model, grid)
    move = best_shift(made, truth)
    made = moved(made, move)
    regions, free = regions_of(truth, grid, looks_right)
    centred = [moved(spans, -middle_of(spans, regions["torso"])) for spans in (truth, made)]
    split = np.bincount(centred[0][0], centred[0][1] * centred[0][2] < 0, grid.x.size) == 0
    paired = regions["legs"] & split & (depths(truth, grid) > 0)
    in_body = np.any([grid.inside(ring * scale + shift) for ring in rings_of(report, ("body",))], axis=0)
    cloud = visible(surface_points(real), truth, grid)
    other = surface_points(model + [0, 0, move])
    volume = depths(truth, grid).sum()
    return {"pairs": sum(part["role"] == "foreground" for part in report["parts"]),
            "iou": overlap(made, truth), "distance": surface_distance(cloud, other), "shift": move,
            "holes": holes, "volume": depths(made, grid).sum() / volume,
            "region_volumes": [{name: depths(spans, grid)[mask].sum() / volume
                                for name, mask in regions.items()}
                               for spans in (truth, made)],
            "sections": [sections(spans, free, grid) for spans in (truth, made)],
            "legs": [leg_figures(spans, paired) for spans in centred],
            "read": float(in_body[free].mean()),
            "torso_iou": [overlap(moved(centred[1], scale=f), centred[0], free) for f in FACTORS]}


def measure(name, arguments, variants, folder):
    """For each variant the figures, or {"failed": why}."""
    real = outward(read_off(arguments.meshes / f"{name}.off"))
    results = {}
    for variant, extra in variants:
        built, why = build(arguments.meshes / f"{name}_sketch.svg", arguments, extra, folder)
        results[variant] = {"failed": why} if why else \
            compare(real, *built, name not in arguments.look_left)
        print(f"{name} {variant}: {why or 'iou %.3f' % results[variant]['iou']}", file=sys.stderr)
    return results


# ---- Tables -------------------------------------------------------------------------------------

def table(columns, rows):
    """Markdown of rows that begin with a name; columns are (title, format). Means below, over the
    cells that hold a number."""
    def line(name, values):
        cells = [value if isinstance(value, str) else "-" if value is None else form.format(value)
                 for (_, form), value in zip(columns, values)]
        return "| " + " | ".join([name, *cells]) + " |"
    means = []
    for values in zip(*(row[1:] for row in rows)):
        numbers = [value for value in values if value is not None and not isinstance(value, str)]
        means.append(float(np.mean(numbers)) if numbers else None)
    return "\n".join(["| animal | " + " | ".join(title for title, _ in columns) + " |",
                      "|---|" + "--:|" * len(columns), *(line(row[0], row[1:]) for row in rows),
                      line("**mean**", means)])


def overall_table(results, variants):
    titles = (("IoU", "{:.3f}"), ("distance %", "{:.2f}"), ("volume", "{:.2f}"))
    columns = [(f"{title}, {variant}", form) for title, form in titles for variant, _ in variants]
    rows = []
    for name, found in results.items():
        cells = []
        for key, factor in (("iou", 1), ("distance", 100), ("volume", 1)):
            for variant, _ in variants:
                value = found[variant].get(key)
                cells.append("no model" if value is None else factor * value)
        rows.append([name, *cells])
    return table(columns, rows)


def section_table(figures):
    columns = [(title, "{:.2f}") for title in ("depth / height, real", "model", "belly, real", "model", "back, real",
                                               "model", "best factor")]
    columns += [("IoU of the torso", "{:.3f}"), ("at best factor", "{:.3f}")]
    rows = []
    for name, found in figures.items():
        best = int(np.argmax(found["torso_iou"]))
        pairs = [value for both in zip(*found["sections"]) for value in both][:-2]
        rows.append([name, *pairs, FACTORS[best], found["torso_iou"][FACTORS.tolist().index(1.0)],
                     found["torso_iou"][best]])
    return table(columns, rows)


def region_table(figures):
    columns = [(region, "{:+.1f}") for region in REGIONS] + \
        [(title, "{:.1f}") for title in ("legs apart, real", "model", "a leg's depth, real", "model")] + [
         ("outer faces / torso, real", "{:.2f}"), ("model", "{:.2f}"), ("pairs", "{:.0f}")]
    rows = []
    for name, found in figures.items():
        truth, made = found["region_volumes"]
        legs = [None if value is None else 100 * value for both in zip(*found["legs"]) for value in both]
        outer = [None if None in leg else sum(leg) / section[-1]
                 for leg, section in zip(found["legs"], found["sections"])]
        rows.append([name, *(100 * (made[region] - truth[region]) for region in REGIONS), *legs, *outer, found["pairs"]])
    return table(columns, rows)


def figures_text(results, variants):
    first = variants[0][0]
    figures = {name: found[first] for name, found in results.items() if "failed" not in found[first]}
    text = [OVERALL, overall_table(results, variants)]
    if figures:
        read = {name: found for name, found in figures.items() if found["read"] > 0.5}
        curve = np.mean([found["torso_iou"] for found in read.values()], 0)
        best = int(curve.argmax())
        at = ", ".join(f"{curve[FACTORS.tolist().index(factor)]:.3f} at {factor:g}" for factor in (0.8, 0.9, 1.0))
        own = np.median([FACTORS[np.argmax(found["torso_iou"])] for found in read.values()])
        text += [f"`{first}`: {SECTIONS}", section_table(figures),
                 f"{len(read)} of {len(figures)} torsos were read as torsos. The best single factor on the depth of all of "
                 f"these is **{FACTORS[best]:.2f}**, with a mean IoU there of {curve[best]:.3f}; it is {at}. The median of "
                 f"their own best factors is {own:.2f}.", f"`{first}`: {PLACES}", region_table(figures)]
    text += [f"{name}, {variant}: no model, {found['failed']}" for name, both in results.items()
             for variant, found in both.items() if "failed" in found]
    holed = [name for name, found in figures.items() if found["holes"] > 0]
    if holed:
        text.append("Solids with holes, closed at the last surface of a column: " + ", ".join(holed) + ".")
    return "\n\n".join(text)


def write_page(page, text):
    """Puts the text between the page's marks."""
    before, rest = page.read_text().split(MARKS[0], 1)
    after = rest.split(MARKS[1], 1)[1]
    page.write_text(f"{before}{MARKS[0]}\n\n{text}\n\n{MARKS[1]}{after}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", type=pathlib.Path, help="a folder of NAME_sketch.svg and NAME.off")
    parser.add_argument("names", nargs="*", help="only these")
    parser.add_argument("--program", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent /
                        "build/release/bin/lascaux")
    parser.add_argument("--variant", action="append", metavar="NAME=ARGUMENTS",
                        help="a column, again for each more (default: fitted= and raw='--fit none')")
    parser.add_argument("--look-left", nargs="*", default=[], metavar="NAME", help="animals that look left")
    parser.add_argument("--markdown", type=pathlib.Path, metavar="PAGE",
                        help="replaces the figures between the marks of a page")
    parser.add_argument("--json", type=pathlib.Path, help="writes all figures")
    arguments = parser.parse_args()
    variants = [tuple(variant.split("=", 1)) for variant in
                arguments.variant or ("fitted=", "raw=--fit none")]
    names = arguments.names or sorted(path.stem for path in arguments.meshes.glob("*.off"))
    with tempfile.TemporaryDirectory() as folder:
        results = {name: measure(name, arguments, variants, pathlib.Path(folder)) for name in names}
    text = figures_text(results, variants)
    if arguments.markdown:
        write_page(arguments.markdown, text)
    else:
        print(text)
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=1, default=lambda value: value.tolist()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
