#!/usr/bin/env python3
"""Draws each drawing of some folders again, less well or differently, and says how often it is still read as the original is.

    scripts/measure_variants.py examples [FOLDER or SKETCH.svg ...] [--times N] [--only KIND] [--keep FOLDER] [--list]

Nothing is built. A variant is read like its original when parts have the same roles, relations and partners. The first group
below changes nothing that is seen, so it must always be; the second is what hands do. --list names those that are read otherwise,
--keep writes them.
"""
import argparse
import math
import pathlib
import random
import tempfile
from concurrent.futures import ThreadPoolExecutor

from drawings import drawings_in
from measure_reading import inspect, roles

# A stroke is a dictionary: pieces (cubics of four points), width, dot.


def bounds(strokes):
    points = [point for stroke in strokes for piece in stroke["pieces"] for point in piece]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return min(xs), min(ys), max(xs), max(ys)


def diagonal(strokes):
    x0, y0, x1, y1 = bounds(strokes)
    return math.hypot(x1 - x0, y1 - y0)


def mapped(strokes, move, scale=1.0):
    return [stroke | {"pieces": [[move(*point) for point in piece] for piece in stroke["pieces"]],
                      "width": stroke["width"] * scale} for stroke in strokes]


def split(piece, t):
    """The two cubics before and after the parameter t."""
    def mix(a, b):
        return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
    ab, bc, cd = mix(piece[0], piece[1]), mix(piece[1], piece[2]), mix(piece[2], piece[3])
    abc, bcd = mix(ab, bc), mix(bc, cd)
    middle = mix(abc, bcd)
    return [piece[0], ab, abc, middle], [middle, bcd, cd, piece[3]]


def length(piece):
    """Near enough: chord and control polygon in equal parts."""
    return (math.dist(piece[0], piece[3]) + sum(math.dist(a, b) for a, b in zip(piece, piece[1:]))) / 2


def is_closed(stroke):
    return math.dist(stroke["pieces"][0][0], stroke["pieces"][-1][3]) < 1e-9


def mirrored(strokes, _):
    return mapped(strokes, lambda x, y: (-x, y))


def turned(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda strokes, _: mapped(strokes, lambda x, y: (c * x - s * y, s * x + c * y))


def scaled(k):
    return lambda strokes, _: mapped(strokes, lambda x, y: (k * x + 3 * k, k * y - k), k)


def pen(k):
    """Other widths, but none so wide that its ink closes what is drawn apart."""
    return lambda strokes, _: [stroke if stroke["dot"] else
                               stroke | {"width": min(k * stroke["width"], 0.01 * diagonal(strokes))}
                               for stroke in strokes]


def shuffled(strokes, chance):
    """Another order and other directions; closed lines begin elsewhere."""
    turned_round = []
    for stroke in strokes:
        pieces = stroke["pieces"]
        if is_closed(stroke):
            first = chance.randrange(len(pieces))
            pieces = pieces[first:] + pieces[:first]
        if chance.random() < 0.5:
            pieces = [piece[::-1] for piece in pieces[::-1]]
        turned_round.append(stroke | {"pieces": pieces})
    chance.shuffle(turned_round)
    return turned_round


def subdivided(strokes, chance):
    return [stroke if stroke["dot"] else
            stroke | {"pieces": [half for piece in stroke["pieces"]
                                 for half in split(piece, chance.uniform(0.2, 0.8))]}
            for stroke in strokes]


def in_pieces(strokes, chance):
    """Lines that are drawn at one stroke become several that meet."""
    parted = []
    for stroke in strokes:
        rest = stroke["pieces"]
        while len(rest) > 3 and chance.random() < 0.5:
            at = chance.randrange(1, len(rest))
            parted.append(stroke | {"pieces": rest[:at]})
            rest = rest[at:]
        parted.append(stroke | {"pieces": rest})
    return parted


def rounded(share):
    def move(strokes, _):
        unit = share * diagonal(strokes)
        return mapped(strokes, lambda x, y: (unit * round(x / unit), unit * round(y / unit)))
    return move


def ends(share):
    """Every end is moved so far in any direction, its tangent with it."""
    def move(strokes, chance):
        reach = share * diagonal(strokes)
        moved = []
        for stroke in strokes:
            pieces = [[list(point) for point in piece] for piece in stroke["pieces"]]
            if not stroke["dot"] and not is_closed(stroke):
                for near, next_to in ((pieces[0][0], pieces[0][1]), (pieces[-1][3], pieces[-1][2])):
                    angle = chance.uniform(0, 2 * math.pi)
                    for point in (near, next_to):
                        point[0] += reach * math.cos(angle)
                        point[1] += reach * math.sin(angle)
            moved.append(stroke | {"pieces": pieces})
        return moved
    return move


def too_long(share):
    """Every end overshoots by so much along its tangent."""
    def move(strokes, _):
        reach = share * diagonal(strokes)
        longer = []
        for stroke in strokes:
            pieces = stroke["pieces"]
            if not stroke["dot"] and not is_closed(stroke):
                def beyond(end, before):
                    d = math.dist(end, before) or 1
                    return [e + reach * (e - b) / d for e, b in zip(end, before)]
                def straight(a, b):
                    return [a, [a[0] + (b[0] - a[0]) / 3, a[1] + (b[1] - a[1]) / 3],
                            [b[0] + (a[0] - b[0]) / 3, b[1] + (a[1] - b[1]) / 3], b]
                first, last = pieces[0], pieces[-1]
                pieces = [straight(beyond(first[0], first[1]), first[0]), *pieces,
                          straight(last[3], beyond(last[3], last[2]))]
            longer.append(stroke | {"pieces": pieces})
        return longer
    return move


def gaps(share, count):
    """So many gaps of this length, anywhere along the lines."""
    def move(strokes, chance):
        left = [dict(stroke) for stroke in strokes]
        for _ in range(count):
            reach = share * diagonal(strokes)
            places = [(s, p) for s, stroke in enumerate(left) for p, piece in enumerate(stroke["pieces"])
                      if not stroke["dot"] and length(piece) > 3 * reach]
            if not places:
                break
            weights = [length(left[s]["pieces"][p]) for s, p in places]
            s, p = chance.choices(places, weights)[0]
            stroke, pieces = left[s], left[s]["pieces"]
            half = reach / length(pieces[p]) / 2
            middle = chance.uniform(0.2 + half, 0.8 - half)
            before, after = split(pieces[p], middle - half)[0], split(pieces[p], middle + half)[1]
            if is_closed(stroke):
                left[s] = stroke | {"pieces": [after, *pieces[p + 1:], *pieces[:p], before]}
            else:
                left[s:s + 1] = [stroke | {"pieces": [*pieces[:p], before]},
                                 stroke | {"pieces": [after, *pieces[p + 1:]]}]
        return left
    return move


def unsteady(share):
    """The page is bent in waves, by this much at most."""
    def move(strokes, chance):
        size = diagonal(strokes)
        waves = [(chance.uniform(0, 2 * math.pi), chance.uniform(0.08, 0.3) * size,
                  chance.uniform(0, 2 * math.pi), k % 2) for k in range(6)]
        def bend(x, y):
            d = [0.0, 0.0]
            for angle, long, phase, axis in waves:
                along = x * math.cos(angle) + y * math.sin(angle)
                d[axis] += share * size / 3 * math.sin(2 * math.pi * along / long + phase)
            return x + d[0], y + d[1]
        return mapped(strokes, bend)
    return move


UNSEEN = (("mirrored", mirrored), ("scaled 0.01", scaled(0.01)), ("scaled 100", scaled(100)),
          ("other order", shuffled), ("subdivided", subdivided), ("in pieces", in_pieces),
          ("rounded 0.02 %", rounded(2e-4)))
BY_HAND = (("turned 4 degrees", turned(4)), ("turned -4 degrees", turned(-4)),
           ("pen three times as wide", pen(3)), ("thin pen", pen(0.1)),
           ("unsteady 0.5 %", unsteady(0.005)), ("unsteady 1 %", unsteady(0.01)),
           ("ends moved 0.3 %", ends(0.003)), ("ends moved 0.8 %", ends(0.008)),
           ("ends moved 1.5 %", ends(0.015)), ("ends moved 2 %", ends(0.02)),
           ("too long by 0.5 %", too_long(0.005)), ("too long by 1 %", too_long(0.01)),
           ("one gap of 0.5 %", gaps(0.005, 1)), ("one gap of 1.5 %", gaps(0.015, 1)),
           ("one gap of 3 %", gaps(0.03, 1)), ("three gaps of 1 %", gaps(0.01, 3)),
           ("three gaps of 2.5 %", gaps(0.025, 3)))


def write(strokes, path):
    x0, y0, x1, y1 = bounds(strokes)
    margin = 0.05 * max(x1 - x0, y1 - y0)
    lines = []
    for stroke in strokes:
        first = stroke["pieces"][0][0]
        way = f"M{first[0]:.9g},{first[1]:.9g}"
        if stroke["dot"]:
            way += "h0"
        else:
            way += "".join("C" + " ".join(f"{x:.9g},{y:.9g}" for x, y in piece[1:])
                           for piece in stroke["pieces"])
        width = stroke["width"] or 1e-3 * margin  # the outlines of areas have none
        lines.append(f'<path d="{way}" stroke-width="{width:.6g}"/>')
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x0 - margin:.9g} {y0 - margin:.9g} '
        f'{x1 - x0 + 2 * margin:.9g} {y1 - y0 + 2 * margin:.9g}"><g fill="none" stroke="#000" '
        'stroke-linecap="round">\n' + "\n".join(lines) + "\n</g></svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawings", nargs="+", type=pathlib.Path, help="folders, or SVG files")
    parser.add_argument("--times", type=int, default=4, help="variants of each kind that knows chance")
    parser.add_argument("--only", default="", help="kinds whose names hold this")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for the variants that are read otherwise")
    parser.add_argument("--list", action="store_true", help="name those")
    parser.add_argument("--program", default=str(pathlib.Path(__file__).resolve().parent.parent /
                                                 "build/release/bin/lascaux"))
    arguments = parser.parse_args()
    sketches = drawings_in(arguments.drawings)
    with tempfile.TemporaryDirectory() as temporary, ThreadPoolExecutor(2) as pool:
        folder, parses = pathlib.Path(temporary), pathlib.Path(temporary) / "parses"
        parses.mkdir()

        def read(sketch):
            code, parse, message = inspect(arguments.program, sketch, parses)
            return (roles(parse) if code == 0 else message), parse

        originals = [(sketch, *read(sketch)) for sketch in sketches]
        originals = [(sketch, found, parse["strokes"]) for sketch, found, parse in originals
                     if not isinstance(found, str)]
        print(f"{'variant of ' + str(len(originals)) + ' drawings':28}  same  of")
        for name, vary in UNSEEN + BY_HAND:
            if arguments.only not in name:
                continue
            same, tried, other = 0, 0, []
            jobs = []
            for sketch, found, strokes in originals:
                variants = []
                for k in range(arguments.times):
                    variant = vary(strokes, random.Random(f"{arguments.seed} {sketch.stem} {name} {k}"))
                    if variant in variants:
                        break
                    variants.append(variant)
                    label = f"{sketch.stem}__{name.replace(' ', '_').replace('%', 'pct')}_{k}"
                    write(variant, folder / f"{label}.svg")
                    jobs.append((label, found))
            results = pool.map(lambda job: read(folder / f"{job[0]}.svg")[0], jobs)
            for (label, found), now in zip(jobs, results):
                tried += 1
                same += now == found
                if now == found:
                    continue
                other.append(f"    {label}: " + (now if isinstance(now, str) else ", ".join(
                    [f"- {n} {role} {relation}{' paired' * pair}" for (role, relation, pair), n in (found - now).items()] +
                    [f"+ {n} {role} {relation}{' paired' * pair}" for (role, relation, pair), n in (now - found).items()])))
                if arguments.keep:
                    arguments.keep.mkdir(parents=True, exist_ok=True)
                    (arguments.keep / f"{label}.svg").write_bytes((folder / f"{label}.svg").read_bytes())
            print(f"{name:28}  {same:4}  {tried}", flush=True)
            if arguments.list and other:
                print("\n".join(other))
    return 0


if __name__ == "__main__":
    main()
