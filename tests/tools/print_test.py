#!/usr/bin/env python3
"""What `lascaux build` changes so that a model prints: base, walls, cavity, number of faces."""
import json

from program import EXAMPLES, ProgramTest, main, messages, run


class PrintTest(ProgramTest):
    def build(self, name, *options):
        """What the report says; the model is printable, also to `lascaux check`."""
        process = run("build", EXAMPLES / f"{name}.svg", "-o", self.folder / "m.stl", "--report",
                      self.folder / "r.json", "--resolution", 128, *options)
        self.assert_code(process, 0)
        report = self.report("r.json")
        self.codes = {d["code"] for d in report["diagnostics"]}
        check = run("check", self.folder / "m.stl", "-o", "-")
        self.assertEqual(check.returncode, 0, check.stderr)
        found = json.loads(check.stdout)
        self.assertTrue(found["printable"])
        self.assertEqual(found["mesh"]["components"], 1)
        self.assertEqual(found["mesh"]["genus"], report["mesh"]["genus"])
        return report

    def test_a_base_makes_stand_what_falls_and_nothing_else(self):
        without = self.build("whale")
        self.assertFalse(without["mesh"]["stability"]["stands"])
        self.assertIsNone(without["print"])
        with_base = self.build("whale", "--base")
        self.assertTrue(with_base["mesh"]["stability"]["stands"])
        self.assertIn("base-added", self.codes)
        self.assertLess(with_base["fidelity"]["contour_mean_percent"], 0.1)
        cat = self.build("cat", "--base")
        self.assertIsNone(cat["print"]["base"])
        self.assertIn("stands-alone", self.codes)
        self.assertEqual(cat["mesh"]["volume"], self.build("cat")["mesh"]["volume"])

    def test_walls_become_as_thick_as_asked_for(self):
        thin = self.build("cat")["mesh"]["smallest_wall"]["thickness"]
        thick = self.build("cat", "--min-wall", 2)
        self.assertIn("wall-thickened", self.codes)
        self.assertAlmostEqual(thick["print"]["thickened"][0]["was"], thin, places=6)
        self.assertGreater(thick["mesh"]["smallest_wall"]["thickness"], 2 - 0.02 * 100 / 128)
        self.assertNotIn("wall-still-thin", self.codes)

    def test_a_cavity_has_its_walls_and_a_drain_and_does_not_show(self):
        solid = self.build("cat")
        hollow = self.build("cat", "--hollow", 3)
        self.assertIn("hollowed", self.codes)
        saved = hollow["print"]["cavity"]["saved_percent"]
        share = 100 * (1 - hollow["mesh"]["volume"] / solid["mesh"]["volume"])
        self.assertGreater(saved, 20)
        self.assertLess(abs(share - saved), 3)
        self.assertEqual(hollow["mesh"]["genus"], 0)  # a cavity by itself would be a second shell
        # All that may show from the side is the drain.
        for field, accuracy in (("iou", 3e-4), ("contour_mean_percent", 0.005)):
            self.assertLess(abs(hollow["fidelity"][field] - solid["fidelity"][field]), accuracy)
        self.build("cat", "--hollow", 3, "--size", 20)
        self.assertIn("not-hollowed", self.codes)

    def test_fewer_faces_stay_one_solid_or_are_more(self):
        report = self.build("cat", "--faces", 3000)
        self.assertLessEqual(report["mesh"]["triangles"], 3000)
        self.assertLess(report["fidelity"]["contour_mean_percent"], 0.1)
        few = self.build("cat", "--faces", 8)["mesh"]["triangles"]
        self.assertEqual(few > 8, "more-faces" in self.codes)

    def test_walls_thinner_than_two_voxels_are_refused(self):
        process = run("build", EXAMPLES / "cat.svg", "-o", self.folder / "m.stl", "--min-wall", 0.5,
                      "--resolution", 64)
        self.assert_code(process, 2)
        self.assertIn("print-too-coarse", process.stderr)
        self.assertEqual(self.files(), [])

    def test_a_tip_is_noted_and_no_warning(self):
        process = run("build", EXAMPLES / "cat.svg", "-o", self.folder / "m.stl", "--size", 60)
        self.assertTrue([m for m in messages(process, "note") if "tip-thin" in m], process.stderr)
        self.assertFalse([m for m in messages(process, "warning") if "wall-thin" in m])


if __name__ == "__main__":
    main()
