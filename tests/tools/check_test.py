#!/usr/bin/env python3
"""`lascaux check` finds each defect by itself, in every format, and says so in text, JSON and exit code."""
import json
import sys

from program import EXAMPLES, SOURCE, ProgramTest, main, messages, run

sys.path.insert(0, str(SOURCE / "tests/outside"))
import zoo

ENDINGS = ("stl", "3mf", "glb", "obj", "ply")


class CheckTest(ProgramTest):
    def check(self, path):
        """Exit code and what the JSON says."""
        process = run("check", path, "-o", "-")
        return process.returncode, json.loads(process.stdout)

    def test_each_defect_of_the_zoo_is_found_by_itself(self):
        for name, (mesh, expected) in zoo.zoo().items():
            with self.subTest(mesh=name):
                path = self.folder / "mesh.ply"
                zoo.write_ply(path, mesh)
                code, found = self.check(path)
                codes = {d["code"] for d in found["diagnostics"] if d["severity"] == "error"}
                self.assertEqual(code, 6 if name != "good" else 0)
                self.assertEqual(found["printable"], name == "good")
                self.assertEqual(codes, expected)

    def test_a_defect_is_found_in_every_format_that_others_write(self):
        for ending, write in (("stl", zoo.write_stl), ("obj", zoo.write_obj), ("3mf", zoo.write_3mf)):
            for name in ("good", "hole", "inside out", "poked through itself"):
                with self.subTest(ending=ending, mesh=name):
                    mesh, expected = zoo.zoo()[name]
                    path = self.folder / f"mesh.{ending}"
                    write(path, mesh)
                    code, found = self.check(path)
                    self.assertEqual(code, 0 if name == "good" else 6)
                    self.assertEqual({d["code"] for d in found["diagnostics"]
                                      if d["severity"] == "error"}, expected)
                    self.assertAlmostEqual(found["mesh"]["size"][1], 40, places=4)  # Y is up in OBJ

    def test_what_build_writes_passes_with_its_parts_and_size_in_every_format(self):
        paths = [self.folder / f"cat.{ending}" for ending in ENDINGS]
        outputs = [a for path in paths for a in ("-o", path)]
        report = self.folder / "cat.json"
        self.assert_code(run("build", EXAMPLES / "cat.svg", *outputs, "-o", report,
                             "--resolution", 96, "--size", 80), 0)
        built = self.report("cat.json")["mesh"]
        for path in paths:
            with self.subTest(path=path.name):
                code, found = self.check(path)
                self.assertEqual(code, 0, found)
                mesh = found["mesh"]
                self.assertEqual(mesh["triangles"], built["triangles"])
                self.assertEqual(mesh["self_intersections"], 0)
                self.assertAlmostEqual(mesh["volume"] / built["volume"], 1, places=4)
                self.assertAlmostEqual(mesh["smallest_wall"]["thickness"],
                                       built["smallest_wall"]["thickness"], places=3)
                self.assertAlmostEqual(mesh["stability"]["margin"], built["stability"]["margin"],
                                       places=1)
                self.assertAlmostEqual(max(mesh["size"]), 80, delta=1)
                if path.suffix != ".stl":  # the two limbs of a pair are equally thin, but for rounding
                    self.assertEqual(mesh["smallest_wall"]["part"].removesuffix("-far"),
                                     built["smallest_wall"]["part"].removesuffix("-far"))

    def test_text_is_for_people_and_the_worst_mesh_decides(self):
        good, bad = self.folder / "good.obj", self.folder / "bad.obj"
        zoo.write_obj(good, zoo.zoo()["good"][0])
        zoo.write_obj(bad, zoo.zoo()["hole"][0])
        process = run("check", good, bad, "-o", self.folder / "{}.json")
        self.assert_code(process, 6)
        self.assertIn("good.obj: printable", process.stdout)
        self.assertIn("bad.obj: NOT PRINTABLE", process.stdout)
        self.assertEqual(len(messages(process, "error")), 2, process.stderr)
        self.assertFalse(self.report("bad.json")["printable"])
        self.assertEqual(run("check", good, "--quiet").stdout, "")

    def test_thin_walls_and_falling_over_are_warned_of(self):
        thin = [tuple(x * f for x, f in zip(p, (1, 0.01, 1))) for p in zoo.sphere()[0]], zoo.sphere()[1]
        zoo.write_stl(self.folder / "thin.stl", thin)
        process = run("check", self.folder / "thin.stl")
        self.assert_code(process, 0)
        self.assertIn("wall-thin", process.stderr)
        leaning = [(x + max(0, z - 5), y, z) for x, y, z in zoo.sphere()[0]], zoo.sphere()[1]
        zoo.write_stl(self.folder / "leaning.stl", leaning)
        self.assertIn("falls-over", run("check", self.folder / "leaning.stl").stderr)

    def test_what_can_not_be_read_is_3(self):
        self.assert_code(run("check", self.folder / "none.stl"), 3)
        self.assert_code(run("check", self.write("a.stl", "hello")), 3)
        self.assert_code(run("check", self.write("b.glb", b"glTF")), 3)
        self.assert_code(run("check", EXAMPLES / "cat.svg"), 3)
        self.assert_code(run("check"), 2)
        self.assert_code(run("check", self.write("c.obj", "v 0 0 0\n"), "-o", "x.stl"), 2)


if __name__ == "__main__":
    main()
