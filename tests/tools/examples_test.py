#!/usr/bin/env python3
"""Every example builds, is understood as its truth says, is one solid, and is the drawing when seen from the side."""
import json

from program import EXAMPLES, SANITIZED, ProgramTest, main, run
from truth import differences

MEAN, P95 = 0.1, 0.3  # percent of the diagonal, for the worst drawing
MEANS = {"contour_mean_percent": 0.05, "contour_p95_percent": 0.12, "iou": 0.99}  # over all drawings
RESOLUTION = 96 if SANITIZED else 256


class ExamplesTest(ProgramTest):
    def test_there_are_enough(self):
        self.assertGreaterEqual(len(list(EXAMPLES.glob("*.svg"))), 16)

    def test_each_is_understood_solid_and_faithful(self):
        fidelity = []
        for sketch in sorted(EXAMPLES.glob("*.svg")):
            with self.subTest(example=sketch.stem):
                fidelity.append(self.check(sketch))
        if SANITIZED:
            return
        for figure, limit in MEANS.items():
            mean = sum(f[figure] for f in fidelity) / len(fidelity)
            (self.assertGreaterEqual if figure == "iou" else self.assertLessEqual)(mean, limit, figure)

    def check(self, sketch):
        path = self.folder / f"{sketch.stem}.json"
        process = run("build", sketch, "--report", path, "--resolution", RESOLUTION)
        self.assert_code(process, 0)
        report = self.report(path.name)
        truth = json.loads(sketch.with_suffix(".json").read_text())
        self.assertEqual(differences(truth, report), [])
        mesh = report["mesh"]
        for fact in ("closed", "manifold", "oriented"):
            self.assertTrue(mesh[fact], fact)
        self.assertEqual(mesh["components"], 1)
        # Nothing came off but tips thinner than a voxel.
        loose = [d["message"] for d in report["diagnostics"] if d["code"] == "crumb-removed" and d["severity"] != "note"]
        self.assertEqual(loose, [])
        if not SANITIZED:  # a coarse grid is as coarse as it is
            self.assertLessEqual(report["fidelity"]["contour_mean_percent"], MEAN)
            self.assertLessEqual(report["fidelity"]["contour_p95_percent"], P95)
        return report["fidelity"]


if __name__ == "__main__":
    main()
