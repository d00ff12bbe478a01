#!/usr/bin/env python3
"""Programs that are not ours read what was written."""
import shutil
import subprocess

from program import EXAMPLES, ProgramTest, main, run


class OutsideReadersTest(ProgramTest):
    def setUp(self):
        super().setUp()
        files = [self.folder / f"cat{ending}" for ending in (".vdb", ".stl", ".png")]
        outputs = [a for file in files for a in ("-o", file)]
        self.assert_code(run("build", EXAMPLES / "cat.svg", *outputs, "--resolution", 128), 0)

    def ask(self, *command):
        if shutil.which(command[0]) is None:
            self.skipTest(f"{command[0]} is not installed")
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_vdb_print_finds_one_level_set(self):
        text = self.ask("vdb_print", "-l", self.folder / "cat.vdb")
        self.assertIn("surface", text)
        self.assertIn("level set", text)

    def test_pyopenvdb_finds_a_level_set_in_metres(self):
        code = ("import pyopenvdb as vdb, sys; g = vdb.readAllGridMetadata(sys.argv[1])[0];"
                "g = vdb.read(sys.argv[1], 'surface'); v = g.transform.voxelSize()[0];"
                "assert abs(v - 0.1 / 128) < 1e-9, v; assert abs(g.background / v - 3) < 1e-5;"
                "assert g.gridClass == 'level set'; low, high = g.evalActiveVoxelBoundingBox();"
                "print((high[0] - low[0]) * v)")
        if subprocess.run(["/usr/bin/python3", "-c", "import pyopenvdb"],
                          capture_output=True).returncode:
            self.skipTest("python3-openvdb is not installed")
        self.assertAlmostEqual(float(self.ask("/usr/bin/python3", "-c", code,
                                              self.folder / "cat.vdb")), 0.1, delta=0.02)

    def test_admesh_finds_nothing_to_repair(self):
        self.assert_nothing_to_repair(self.folder / "cat.stl")

    def test_admesh_finds_nothing_to_repair_in_what_was_changed_for_printing(self):
        for i, options in enumerate((("--base",), ("--min-wall", 2), ("--hollow", 2), ("--faces", 5000),
                                     ("--base", "--min-wall", 2, "--hollow", 3, "--faces", 20000))):
            path = self.folder / f"{i}.stl"
            self.assert_code(run("build", EXAMPLES / "whale.svg", "-o", path, "--resolution", 128, *options), 0)
            self.assert_nothing_to_repair(path)

    def assert_nothing_to_repair(self, path):
        text = self.ask("admesh", path)
        numbers = {}
        for line in text.splitlines():
            for item in ("Edges fixed", "Facets removed", "Facets added", "Facets reversed",
                         "Backwards edges", "Degenerate facets", "Normals fixed", "Number of parts"):
                if item in line:
                    numbers[item] = int(line.split(item)[1].replace(":", " ").split()[0])
        self.assertEqual(numbers.pop("Number of parts"), 1, text)
        self.assertEqual(set(numbers.values()), {0}, text)

    def test_oiiotool_reads_the_preview(self):
        self.assertIn("512 x  512", self.ask("oiiotool", "--info", self.folder / "cat.png"))


if __name__ == "__main__":
    main()
