#!/usr/bin/env python3
"""Pictures compared with those in tests/golden, which a person has looked at.

Usage: golden_test.py LASCAUX WRITE_ANIMAL GOLDEN_FOLDER FOLDER [--accept]. The pictures that were drawn and, where they differ,
the difference ten times as strong are left in FOLDER; --accept makes them the golden ones.

The model is a test's own, so that pictures change with the renderer alone. Tolerance: a pixel counts as different by more than 1 of 255
levels, 1 % of them may be, none by more than a tenth: compilers round differently, and single pixels of outlines tip over.
"""
import pathlib
import shutil
import subprocess
import sys
import unittest

LASCAUX, WRITE_ANIMAL, GOLDEN, FOLDER = sys.argv[1:5]
ACCEPT = "--accept" in sys.argv
TOLERANCE = ("-fail", "0.004", "-failpercent", "1", "-hardfail", "0.1")


class GoldenTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pathlib.Path(FOLDER).mkdir(parents=True, exist_ok=True)
        cls.model = pathlib.Path(FOLDER, "animal.vdb")
        subprocess.run([WRITE_ANIMAL, cls.model], check=True)

    def looks_like(self, name, *options):
        golden, drawn = pathlib.Path(GOLDEN, name), pathlib.Path(FOLDER, name)
        subprocess.run([LASCAUX, "render", self.model, "-o", drawn, "--size", "96", "--quiet",
                        *options], check=True)
        if ACCEPT:
            shutil.copy(drawn, golden)
        difference = drawn.with_name(f"difference-{name}")
        done = subprocess.run(["idiff", *TOLERANCE, "-abs", "-scale", "10", "-od", "-o", difference,
                               golden, drawn], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{done.stdout}{done.stderr}see {difference}")

    def test_three_quarter(self): self.looks_like("three-quarter.png")
    def test_side(self): self.looks_like("side.png", "--view", "side")
    def test_front(self): self.looks_like("front.png", "--view", "front")
    def test_top(self): self.looks_like("top.png", "--view", "top")
    def test_transparent(self): self.looks_like("transparent.png", "--background", "transparent")
    def test_color(self): self.looks_like("color.png", "--background", "#204060")
    def test_turn(self): self.looks_like("turn.png", "--turntable", "3", "--columns", "3")


unittest.main(argv=sys.argv[:1])
