"""Broken meshes, each defect by itself: what `lascaux check` says of them, and files for other checkers.

A mesh is a list of corners and a list of triangles; Z is up, in millimetres.
"""
import math
import struct
import zipfile


def sphere(levels=3, radius=20.0, center=(0.0, 0.0, 20.0)):
    """An octahedron whose faces are cut in four, corners on the sphere; outward."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                point = [corners[a][k] + corners[b][k] for k in range(3)]
                length = math.hypot(*point)
                middles[key] = len(corners)
                corners.append(tuple(x / length for x in point))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return [tuple(center[k] + radius * p[k] for k in range(3)) for p in corners], faces


def together(*meshes):
    corners, faces = [], []
    for points, triangles in meshes:
        faces += [tuple(len(corners) + i for i in t) for t in triangles]
        corners += points
    return corners, faces


def turned(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]


def tetrahedron(a, b, c, d):
    """Corner indices; outward when d is on the side from which a, b, c run counter-clockwise inward."""
    return [(a, c, b), (a, b, d), (b, c, d), (c, a, d)]


def with_face(change):
    corners, faces = sphere()
    change(corners, faces)
    return corners, faces


def duplicated(corners, faces):
    faces += [faces[7]]


def split_vertex(corners, faces):
    """A triangle's corner is a second vertex at the same place: two open edges in vertex indices."""
    corners.append(corners[faces[5][0]])
    faces[5] = (len(corners) - 1, *faces[5][1:])


def poked(corners, faces):
    corners[0] = (-30.0, 0.2, 20.3)


def zoo():
    """name -> (mesh, codes that `lascaux check` gives for the PLY file)."""
    good = sphere()
    edge = ([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (0, -9, 0), (0, 0, -9)],
            tetrahedron(0, 1, 2, 3) + tetrahedron(0, 1, 4, 5))
    fans = ([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (-9, 0, 0), (0, -9, 0), (0, 0, -9)],
            tetrahedron(0, 1, 2, 3) + tetrahedron(0, 5, 4, 6))
    # A vertex in the middle of an edge, and a triangle without area between the edge and its halves.
    needle = ([(0, 0, 0), (8, 0, 0), (0, 8, 0), (0, 0, 8), (4, 0, 0)],
              [(0, 2, 4), (4, 2, 1), (0, 4, 1)] + tetrahedron(0, 1, 2, 3)[1:])
    nan = with_face(lambda corners, faces: corners.__setitem__(3, (float("nan"), 0.0, 0.0)))
    past = with_face(lambda corners, faces: faces.__setitem__(3, (0, 1, 99999)))
    return {
        "good": (good, set()),
        "hole": (with_face(lambda c, f: f.pop()), {"mesh-open", "mesh-not-oriented"}),
        "flipped face": (with_face(lambda c, f: f.__setitem__(9, f[9][::-1])), {"mesh-not-oriented"}),
        "inside out": (turned(good), {"mesh-not-oriented"}),
        "face twice": (with_face(duplicated), {"mesh-open", "mesh-not-manifold", "mesh-not-oriented",
                                               "mesh-self-intersects"}),
        "edge with four faces": (edge, {"mesh-not-manifold"}),
        "vertex with two fans": (fans, {"mesh-not-manifold"}),
        "loose vertex": (with_face(lambda c, f: c.append((90.0, 0.0, 0.0))), {"mesh-not-manifold"}),
        "split vertex": (with_face(split_vertex), {"mesh-open", "mesh-not-oriented",
                                                   "mesh-coincident", "mesh-self-intersects"}),
        "face without area": (needle, {"mesh-degenerate", "mesh-self-intersects"}),
        "two pieces": (together(good, sphere(center=(50.0, 0.0, 20.0))), {"mesh-in-pieces"}),
        "pieces through each other": (together(good, sphere(center=(15.0, 1.0, 21.0))),
                                      {"mesh-self-intersects", "mesh-in-pieces"}),
        "cavity": (together(good, turned(sphere(radius=10.0))), {"mesh-not-oriented", "mesh-in-pieces"}),
        "poked through itself": (with_face(poked), {"mesh-self-intersects"}),
        "not a number": (nan, {"mesh-invalid"}),
        "index past the end": (past, {"mesh-invalid"}),
        "nothing": (([], []), {"mesh-empty"}),
    }


def write_ply(path, mesh):
    corners, faces = mesh
    path.write_bytes(
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n".encode()
        + b"".join(struct.pack("<3f", *c) for c in corners)
        + b"".join(struct.pack("<B3I", 3, *f) for f in faces))


def write_obj(path, mesh):
    path.write_text("".join("v %.9g %.9g %.9g\n" % tuple(c) for c in mesh[0])
                    + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in mesh[1]))


def write_stl(path, mesh):
    corners, faces = mesh
    path.write_bytes(b" " * 80 + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in corners[i]), 0) for f in faces))


def write_3mf(path, mesh):
    vertices = "".join('<vertex x="%.9g" y="%.9g" z="%.9g"/>' % tuple(c) for c in mesh[0])
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % tuple(f) for f in mesh[1])
    package = "http://schemas.openxmlformats.org/package/2006/"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("[Content_Types].xml", f'<Types xmlns="{package}content-types"><Default Extension="rels" '
                         'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension='
                         '"model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        archive.writestr("_rels/.rels", f'<Relationships xmlns="{package}relationships"><Relationship Target='
                         '"/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/'
                         '3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", '<model unit="millimeter" xmlns="http://schemas.microsoft.com/'
                         '3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices>'
                         f"{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources>"
                         '<build><item objectid="1"/></build></model>')
