#!/usr/bin/python3
"""Volumes as other programs find them: pyopenvdb reads every grid of every preset."""
import os
import pty
import subprocess
import unittest

import numpy
import pyopenvdb

from program import EXAMPLES, PROGRAM, ProgramTest, main, messages, run

CAT = EXAMPLES / "cat.svg"
RESOLUTION = 64
SMALL = ("--resolution", RESOLUTION, "--quiet")
PARTS = ["part_body", "part_eye_8", "part_eye_8_far", "part_limb_1", "part_limb_1_far", "part_limb_2",
         "part_limb_2_far", "part_limb_3", "part_limb_3_far", "part_part_0"]


class VolumesTest(ProgramTest):
    def build(self, *options):
        path = self.folder / "cat.vdb"
        self.assert_code(run("build", CAT, "-o", path, *SMALL, *options), 0)
        grids, metadata = pyopenvdb.readAll(str(path))
        return {grid.name: grid for grid in grids}, metadata

    def test_the_surface_alone_by_default(self):
        grids, metadata = self.build()
        self.assertEqual(list(grids), ["surface"])
        self.assertEqual((metadata["units"], metadata["up_axis"]), ("m", "Y"))
        self.assertEqual((metadata["creator"], metadata["lascaux_sketch"]), ("Lascaux", "cat.svg"))
        self.assertEqual(len(metadata["lascaux_sketch_hash"]), 32)
        names = metadata["lascaux_parts"].split(",")
        self.assertEqual(sorted("part_" + name.replace("-", "_") for name in names), PARTS)

    def test_each_program_gets_its_axes_its_unit_and_its_grids(self):
        for program, per_metre, up, half, names in (
                ("houdini", 1, 1, False, ["surface"]), ("blender", 1, 2, False, ["density", "surface"]),
                ("unreal", 100, 2, True, ["density", "surface"]), ("print", 1000, 2, False, ["surface"])):
            with self.subTest(program=program):
                grids, metadata = self.build("--for", program)
                self.assertEqual(sorted(grids), names)
                self.assertEqual(metadata["up_axis"], "XYZ"[up])
                surface = grids["surface"]
                self.assertEqual(surface.saveFloatAsHalf, half)
                voxel = surface.transform.voxelSize()[0]
                self.assertAlmostEqual(voxel, 0.1 / RESOLUTION * per_metre, delta=1e-6 * voxel)
                self.assertAlmostEqual(surface.background / voxel, 3, delta=2e-3)
                points, _ = surface.convertToQuads()
                low, size = points.min(axis=0), numpy.ptp(points, axis=0)
                # It stands on the ground; pyopenvdb's vertices are middles, a little inside.
                self.assertAlmostEqual(low[up], 0, delta=0.15 * voxel)
                self.assertAlmostEqual(size[0], 0.1 * per_metre, delta=voxel)
                self.assertGreater(size[up], 2 * size[3 - up])  # higher than wide

    def test_a_terminal_is_no_place_for_a_volume(self):
        try:
            terminal, program = pty.openpty()
        except OSError as error:
            self.skipTest(f"this machine lends no terminals: {error}")
        done = subprocess.run([PROGRAM, "build", CAT, "-o", "-", *map(str, SMALL)], stdout=program,
                              stderr=subprocess.PIPE, text=True, timeout=60)
        os.close(program)
        os.close(terminal)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("terminal-output", done.stderr)

    def test_what_is_printed_is_what_the_volume_holds(self):
        solid, _ = self.build("--parts", "--fog")
        printed, _ = self.build("--parts", "--fog", "--hollow", 4, "--size", 60)
        self.assertEqual(sorted(printed), sorted(solid))
        inside = {name: sum(1 for at in grids["density"].citerOnValues() if at.value > 0.5 and at.count == 1)
                  for name, grids in (("solid", solid), ("printed", printed))}
        self.assertLess(inside["printed"], inside["solid"])
        self.assertEqual(printed["part_body"].activeVoxelCount(), solid["part_body"].activeVoxelCount())

    def test_all_there_is(self):
        grids, _ = self.build("--parts", "--fog", "--color")
        self.assertEqual(sorted(grids), sorted(["surface", "density", "Cd", "part", *PARTS]))
        for name in ["surface", *PARTS]:
            self.assertEqual(grids[name].gridClass, "level set", name)
            self.assertGreater(grids[name].activeVoxelCount(), 0, name)
        self.assertEqual(grids["density"].gridClass, "fog volume")
        low, high = grids["density"].evalMinMax()
        self.assertTrue(0 < low < high == 1, (low, high))
        self.assertEqual(grids["part"].evalMinMax(), (0, len(PARTS) - 1))
        self.assertEqual(grids["Cd"].valueTypeName, "vec3s")
        colors, parts = grids["Cd"].getConstAccessor(), grids["part"].getConstAccessor()
        by_part = {}
        for voxel in grids["surface"].citerOnValues():
            by_part.setdefault(parts.getValue(voxel.min), set()).add(colors.getValue(voxel.min))
        self.assertEqual(len(by_part), len(PARTS))
        self.assertTrue(all(len(found) == 1 for found in by_part.values()), by_part)

    def test_half_is_smaller_and_the_same_surface(self):
        full, _ = self.build()
        size = (self.folder / "cat.vdb").stat().st_size
        half, _ = self.build("--half")
        self.assertLess((self.folder / "cat.vdb").stat().st_size, 0.8 * size)
        points = [grids["surface"].convertToQuads()[0] for grids in (full, half)]
        voxel = full["surface"].transform.voxelSize()[0]
        self.assertLess(numpy.abs(points[0] - points[1]).max(), 0.01 * voxel)

    def test_the_same_bytes_go_to_standard_output(self):
        self.build("--fog")
        arguments = [PROGRAM, "build", CAT, "-o", "-", "--report", self.folder / "r.json", "--fog", *SMALL]
        done = subprocess.run(list(map(str, arguments)), capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, (self.folder / "cat.vdb").read_bytes())
        self.assertEqual(self.files(), ["cat.vdb", "r.json"])
        text = run("build", CAT, "--report", "-", *SMALL)
        self.assertTrue(text.stdout.startswith("{"), text.stdout[:80])

    def test_a_reader_that_goes_away_is_5_and_no_other_file_appears(self):
        read, write = os.pipe()
        os.close(read)
        arguments = [PROGRAM, "build", CAT, "-o", "-", "-o", self.folder / "cat.stl", *SMALL]
        done = subprocess.run(list(map(str, arguments)), stdout=write, stderr=subprocess.PIPE, text=True,
                              timeout=60)
        os.close(write)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("whoever reads it stopped", done.stderr)
        self.assertEqual(self.files(), [])

    def test_options_of_volumes_need_one(self):
        for option in (["--fog"], ["--parts"], ["--color"], ["--half"], ["--for", "blender"]):
            process = run("build", CAT, "-o", self.folder / "cat.stl", *option)
            self.assert_code(process, 2)
            self.assertIn("volume-options", process.stderr)
            self.assertIn(f": {option[0]} is about", messages(process, "error")[0])
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    main()
