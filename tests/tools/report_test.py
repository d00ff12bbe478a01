#!/usr/bin/env python3
"""The report says what is in the files beside it."""
import json
import struct

from program import EXAMPLES, ProgramTest, main, run


def read_stl(path):
    """Corners of all triangles of a binary STL."""
    data = path.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    assert len(data) == 84 + 50 * count
    rows = (struct.unpack_from("<9f", data, 84 + 50 * i + 12) for i in range(count))
    return [(row[0:3], row[3:6], row[6:9]) for row in rows]


class ReportTest(ProgramTest):
    def test_it_describes_the_mesh_that_was_written(self):
        stl, path = self.folder / "cat.stl", self.folder / "cat.json"
        process = run("build", EXAMPLES / "cat.svg", "-o", stl, "-o", path, "--size", 80,
                      "--resolution", 96)
        self.assert_code(process, 0)
        report, triangles = self.report("cat.json"), read_stl(stl)
        self.assertEqual(report["mesh"]["triangles"], len(triangles))
        corners = [corner for triangle in triangles for corner in triangle]
        self.assertEqual(len(set(corners)), report["mesh"]["vertices"])
        low = [min(c[k] for c in corners) for k in range(3)]
        high = [max(c[k] for c in corners) for k in range(3)]
        self.assertEqual(low[2], 0)  # print frame: Z up
        self.assertAlmostEqual(max(high[0] - low[0], high[2] - low[2]), 80, delta=1.5)
        self.assertAlmostEqual(report["grid"]["voxel_size"], 80 / 96)
        volume = sum(ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
                     for (ax, ay, az), (bx, by, bz), (cx, cy, cz) in triangles) / 6
        self.assertAlmostEqual(volume / report["mesh"]["volume"], 1, places=4)

    def test_the_matrix_puts_the_drawing_on_the_mesh(self):
        stl, path = self.folder / "cat.stl", self.folder / "cat.json"
        self.assert_code(run("build", EXAMPLES / "cat.svg", "-o", stl, "-o", path), 0)
        report = self.report("cat.json")
        (a, b, c), (d, e, f) = report["model_from_sketch"]
        points = [(a * x + b * y + c, d * x + e * y + f) for part in report["parts"]
                  if part["role"] != "background" for ring in part["outlines"] for x, y in ring]
        corners = [corner for triangle in read_stl(stl) for corner in triangle]
        for k, axis in ((0, 0), (1, 2)):
            for end in (min, max):
                self.assertAlmostEqual(end(p[k] for p in points), end(c[axis] for c in corners),
                                       delta=1.5)

    def test_fields_are_those_of_the_format(self):
        path = self.folder / "cat.json"
        self.assert_code(run("build", EXAMPLES / "cat.svg", "-o", path, "--resolution", 48), 0)
        report = self.report("cat.json")
        self.assertEqual(list(report), ["format", "sketch", "model_from_sketch", "body", "parts",
                                        "diagnostics", "grid", "mesh", "print", "fidelity", "timings_ms"])
        self.assertEqual(report["format"], "lascaux.report/1")
        self.assertTrue(0 <= report["body"]["score_margin"] <= 1)
        for part in report["parts"]:
            self.assertEqual(list(part), ["id", "name", "role", "parent", "relation", "pair", "z",
                                          "outlines", "evidence", "energy", "choice",
                                          "fidelity"])
            choice = part["choice"]
            self.assertEqual(choice is None, part["role"] == "island")
            if not choice:
                continue
            self.assertEqual(list(choice), ["score", "runner_up", "runner_up_score", "margin"])
            self.assertNotEqual(choice["runner_up"], part["role"])
            self.assertAlmostEqual(choice["margin"], choice["score"] - choice["runner_up_score"])
            self.assertGreater(choice["margin"], 0.1)  # a clean drawing: no guesses
            self.assertLessEqual(choice["score"], 1)
            self.assertIn(part["role"], ("body", "foreground", "background", "sagittal", "island"))
        figures = ["contour_mean_percent", "contour_p95_percent", "worst_percent"]
        self.assertEqual(list(report["fidelity"]), ["iou", *figures, "worst_at"])
        shown = [part["fidelity"] for part in report["parts"] if part["fidelity"]]
        self.assertGreater(len(shown), 3)
        for fidelity in shown:
            self.assertEqual(list(fidelity), figures)
            self.assertLessEqual(fidelity["worst_percent"], report["fidelity"]["worst_percent"])
        for stage in ("read", "structure", "skeleton", "field", "volume", "mesh", "write", "total"):
            self.assertGreater(report["timings_ms"][stage], 0)
        self.assertNotIn("NaN", json.dumps(report))


if __name__ == "__main__":
    main()
