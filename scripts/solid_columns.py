"""Solids as spans along z in columns, and the distance of their surfaces. Lengths are shares of the longest side.

Spans inside are exact in each column; distances are taken between points of the two surfaces.
"""
import numpy as np
from scipy.spatial import cKDTree

COLUMNS = 200  # along the longest side
SAMPLES = 20000  # points whose distance is taken, on each surface
TARGETS = 300000  # points that it is taken to: a mean spacing of 0.1 % of the longest side


def read_off(path):
    """Vertices and triangles; polygons become fans."""
    words = path.read_text().split()
    count, faces = int(words[1]), int(words[2])
    vertices = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    triangles, at = [], 4 + 3 * count
    for _ in range(faces):
        size = int(words[at])
        ring = [int(word) for word in words[at + 1:at + 1 + size]]
        triangles += [(ring[0], ring[k], ring[k + 1]) for k in range(1, size - 1)]
        at += 1 + size
    return vertices[np.array(triangles)]


def read_ply(path):
    """A mesh that the program wrote: in the model's frame, as a .stl, which lies on the bed, is not."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    types = {"float": "<f4", "uchar": "u1", "ushort": "<u2"}
    counts, vertex = {}, []
    for words in (line.decode().split() for line in head.splitlines()):
        if words[0] == "element":
            counts[words[1]] = int(words[2])
        elif words[0] == "property" and "face" not in counts:
            vertex.append((words[2], types[words[1]]))
    points = np.frombuffer(body, np.dtype(vertex), counts["vertex"])
    points = np.stack([points[axis] for axis in "xyz"], 1).astype(float)
    polygons = np.frombuffer(body, np.dtype([("size", "u1"), ("corners", "<u4", 3)]), counts["face"],
                             np.dtype(vertex).itemsize * counts["vertex"])
    return points[polygons["corners"]]


def outward(triangles):
    """The same surface with a positive volume."""
    volume = np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2]))
    return triangles if volume > 0 else triangles[:, ::-1]


class Grid:
    """Columns along z; off the round numbers, on which the vertices of modelled meshes lie."""

    def __init__(self, low, high):
        self.step = 1.0 / COLUMNS
        self.low = np.floor(np.array(low) / self.step - 2) * self.step + self.step * np.array([0.4142, 0.7321])
        self.shape = tuple(int(n) for n in np.ceil((np.array(high) - self.low) / self.step + 2))
        x = self.low[0] + self.step * np.arange(self.shape[0])
        y = self.low[1] + self.step * np.arange(self.shape[1])
        self.x, self.y = (values.ravel() for values in np.meshgrid(x, y, indexing="ij"))

    def inside(self, ring):
        """Which columns lie in a closed ring, by the even-odd rule."""
        within = np.zeros(self.x.size, bool)
        for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, 0)):
            if y0 == y1:
                continue
            rows = (self.y >= min(y0, y1)) & (self.y < max(y0, y1))
            within[rows] ^= self.x[rows] < x0 + (self.y[rows] - y0) * (x1 - x0) / (y1 - y0)
        return within


def crossings(triangles, grid):
    """Column, z and sign (1: into the solid, going up) of every meeting of a column and a triangle."""
    flat = (triangles[:, :, :2] - grid.low) / grid.step
    first = np.maximum(np.ceil(flat.min(1)).astype(int), 0)
    last = np.minimum(np.floor(flat.max(1)).astype(int), np.array(grid.shape) - 1)
    wide, high = np.maximum(last - first + 1, 0).T
    which = np.repeat(np.arange(len(triangles)), wide * high)
    rank = np.arange(which.size) - np.repeat(np.cumsum(wide * high) - wide * high, wide * high)
    i, j = first[which, 0] + rank // high[which], first[which, 1] + rank % high[which]
    a, b, c = (flat[which, k] - np.stack([i, j], 1) for k in range(3))
    wa, wb, wc = (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((b, c), (c, a), (a, b)))
    hit = ((wa > 0) & (wb > 0) & (wc > 0)) | ((wa < 0) & (wb < 0) & (wc < 0))
    which, weights = which[hit], np.stack([wa, wb, wc], 1)[hit]
    area = weights.sum(1)
    z = (weights * triangles[which, :, 2]).sum(1) / area
    return i[hit] * grid.shape[1] + j[hit], z, np.where(area > 0, -1, 1)


def solid_spans(triangles, grid):
    """(column, from, to) of all spans with a positive winding number, so that shells may overlap,
    and the share of columns whose signs don't cancel: those that meet a hole."""
    column, z, sign = crossings(triangles, grid)
    order = np.lexsort((z, column))
    column, z, sign = column[order], z[order], sign[order]
    sums = np.bincount(column, sign, grid.x.size)
    before = np.concatenate([[0], np.cumsum(sums)[:-1]])
    winding = np.cumsum(sign) - before[column]
    last = np.append(column[1:] != column[:-1], True)
    winding[last] = 0  # a span that a hole leaves open ends where its column last meets the surface
    below = np.concatenate([[0], winding[:-1]])
    start, end = (winding > 0) & (below <= 0), (winding <= 0) & (below > 0)
    return (column[start], z[start], z[end]), np.mean(sums[np.unique(column)] != 0)


def depths(spans, grid):
    """Length inside, per column."""
    return np.bincount(spans[0], spans[2] - spans[1], grid.x.size)


def overlap(one, other, columns=None):
    """Intersection over union of two sets of spans, in some columns."""
    ends = []
    for spans, marks in ((one, (1, 0)), (other, (0, 1))):
        keep = slice(None) if columns is None else columns[spans[0]]
        column, low, high = (values[keep] for values in spans)
        for z, sign in ((low, 1), (high, -1)):
            ends.append(np.stack([column, z, np.full(z.size, sign * marks[0]),
                                  np.full(z.size, sign * marks[1])]))
    column, z, a, b = np.concatenate(ends, 1)
    order = np.lexsort((z, column))
    length, a, b = np.diff(z[order]), np.cumsum(a[order])[:-1] > 0, np.cumsum(b[order])[:-1] > 0
    union = length[a | b].sum()
    return length[a & b].sum() / union if union > 0 else 0.0


def moved(spans, shift=0.0, scale=1.0):
    return spans[0], spans[1] * scale + shift, spans[2] * scale + shift


def best_shift(model, real):
    """The shift along z with the largest overlap: a search in three passes over 20 % of the size."""
    best = 0.0
    for reach in (0.2, 0.02, 0.002):
        shifts = best + np.linspace(-reach, reach, 21)
        best = max(shifts, key=lambda shift: (overlap(moved(model, shift), real), -abs(shift)))
    return best


def surface_points(triangles, count=TARGETS):
    """Points evenly over the area: stratified along it, then seeded within each triangle."""
    random = np.random.default_rng(1)
    areas = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0],
                                    triangles[:, 2] - triangles[:, 0]), axis=1)
    along = np.cumsum(areas)
    places = (np.arange(count) + random.random(count)) * along[-1] / count
    chosen = triangles[np.minimum(np.searchsorted(along, places), len(areas) - 1)]
    u, v = random.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return (chosen * np.stack([1 - u - v, u, v], 1)[:, :, None]).sum(1)


def visible(points, spans, grid):
    """Without the points that lie deep in the solid: walls of shells inside one another."""
    cell = np.rint((points[:, :2] - grid.low) / grid.step).astype(int)
    holders = {}
    for column, low, high in zip(*spans):
        holders.setdefault(column, []).append((low + grid.step, high - grid.step))
    buried = np.ones(len(points), bool)
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            columns = (cell[:, 0] + dx) * grid.shape[1] + cell[:, 1] + dy
            for k in np.flatnonzero(buried):
                buried[k] = any(low < points[k, 2] < high for low, high in holders.get(columns[k], ()))
    return points[~buried]


def surface_distance(real, model):
    """Mean of both ways' mean distance between two clouds of surface points."""
    def mean(source, target):
        stride = max(1, len(source) // SAMPLES)
        return cKDTree(target).query(source[::stride])[0].mean()
    return 0.5 * (mean(real, model) + mean(model, real))
