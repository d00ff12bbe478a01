#!/usr/bin/env python3
"""Bad input gets an exit code, one message that says what to do, and no model."""
import gzip
import json
import math
import os
import random
import time

from program import (EXAMPLES, SLOWER, ProgramTest, limit_file_size, main, messages, run)

CAT = EXAMPLES / "cat.svg"
SVG = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>{}</svg>"
PATH = "<path fill='none' stroke='black' d='{}'/>"
MEMORY = 2 << 20  # kB of resident memory that a hundred thousand points may take


def drawing(data):
    return SVG.format(PATH.format(data))


class BadInputTest(ProgramTest):
    def build(self, sketch, *options, **kwargs):
        process = run("build", sketch, "-o", self.folder / "m.vdb", "-o", self.folder / "m.stl",
                      *options, **kwargs)
        return process

    def assert_refused(self, process, code, word=""):
        """The code, exactly one error that mentions `word`, and no model."""
        self.assert_code(process, code)
        errors = messages(process, "error")
        self.assertEqual(len(errors), 1, process.stderr)
        self.assertIn(word, errors[0])
        self.assertEqual([f for f in self.files() if not f.startswith("in.")], [])

    def test_what_is_no_drawing_is_3(self):
        cat = CAT.read_bytes()
        for name, content, word in (
            ("in.txt", "This is not a drawing.\n", ""),
            ("in.svg", b"\x89PNG\r\n\x1a\n" + bytes(range(256)), ""),
            ("in.svg", "", ""),
            ("in.svg", "<html><body/></html>", ""),
            ("in.svg", cat[: len(cat) // 2], ""),
            ("in.svg", SVG.format(""), ""),
            ("in.svg", SVG.format("<text x='5' y='5'>a cat</text>"), ""),
            ("in.svg", drawing("M 10 10 L nan 50 L 90 90"), ""),
            ("in.svg", drawing("M 10 10 L 1e999 50 L 90 90"), ""),
            ("in.svg", drawing("M 10 10"), ""),
            ("in.svg", drawing("M 5 5 L 5 5"), "no-strokes"),
            ("in.svg", drawing("M 0 0 L 9 9 L 5 0 Z").replace("<path", "<path transform='scale(0)'"),
             "no-strokes"),
            ("in.svg", SVG.format("<image width='5' height='5' href='a.png'/>"), "no-strokes"),
            ("in.svg", "<", "broken-xml"),
            ("in.svgz", gzip.compress(cat)[:-200], "cut off at byte"),
            ("in.svgz", gzip.compress(bytes(1 << 27)), "unpacks to more than"),
            ("in.svg", cat.decode().replace("<?xml", " <?xml").encode("utf-16-be"), ""),
            ("in.png", b"\x89PNG\r\n\x1a\n" + bytes(2000), "ends too early"),
        ):
            with self.subTest(content=content[:60]):
                path = self.write(name, content)
                self.assert_refused(self.build(path), 3, word)
                path.unlink()

    def test_a_compressed_drawing_is_read_like_the_plain_one(self):
        content = CAT.read_bytes()
        half = len(content) // 2
        members = gzip.compress(content[:half]) + gzip.compress(content[half:])
        parts = []
        for name, data in (("in.svg", content), ("in.svgz", gzip.compress(content)), ("in.2.svgz", members)):
            dump = self.folder / "parse.json"
            self.assert_code(run("inspect", self.write(name, data), "-o", dump), 0)
            parts.append(json.loads(dump.read_text())["parts"])
        self.assertEqual(parts[0], parts[1])
        self.assertEqual(parts[0], parts[2])

    def test_a_folder_or_a_missing_file_is_3(self):
        self.assert_refused(self.build(self.folder), 3, "cannot-read")
        self.assert_refused(self.build(self.folder / "none.svg"), 3, "cannot-read")

    def test_a_file_without_permission_is_3(self):
        if os.geteuid() == 0:
            self.skipTest("root may read everything")
        path = self.write("in.svg", drawing("M 0 0 L 9 9"))
        path.chmod(0)
        self.assert_refused(self.build(path), 3, "cannot-read")

    def test_an_open_outline_is_4_and_the_place_is_named(self):
        # A circle around (50, 50) that is open between (86, 33) and (90, 50).
        path = self.write("in.svg", drawing("M 90 50 A 40 40 0 1 1 86 33"))
        report, picture = self.folder / "in.json", self.folder / "in.parse.svg"
        process = self.build(path, "--report", report, "-o", picture)
        self.assert_refused(process, 4)
        found = [d for d in self.report("in.json")["diagnostics"] if d["severity"] == "error"]
        self.assertEqual(len(found), 1)
        x, y = found[0]["at"]
        self.assertLess(math.hypot(x - 88, y - 41), 12, found)
        self.assertIn(found[0]["code"], picture.read_text())
        self.assertIsNone(self.report("in.json")["mesh"])

    def test_inspect_shows_what_is_wrong(self):
        path = self.write("in.svg", drawing("M 90 50 A 40 40 0 1 1 86 33"))
        process = run("inspect", path, "-o", self.folder / "in.parse.svg")
        self.assert_code(process, 4)
        self.assertIn('<g id="diagnostics"', (self.folder / "in.parse.svg").read_text())

    def test_a_hundred_thousand_points_take_bounded_time_and_memory(self):
        chance = random.Random(1)
        scribble = "M" + " ".join(f"{chance.uniform(0, 100):.3f},{chance.uniform(0, 100):.3f}"
                                  for _ in range(100_000))
        steps = [2 * math.pi * i / 100_000 for i in range(100_000)]
        ring = "M" + " ".join(f"{50 + (40 + 0.5 * math.sin(40 * t)) * math.cos(t):.5f},"
                              f"{50 + 30 * math.sin(t):.5f}" for t in steps) + "Z"
        for data, codes in ((scribble, (3, 4)), (ring, (0,))):
            path = self.write("in.svg", drawing(data))
            start = time.monotonic()
            process = self.build(path, "--resolution", 64, timeout=60)
            self.assertLess(time.monotonic() - start, 30 * SLOWER)
            self.assertIn(process.returncode, codes, process.stderr)
            if process.returncode:
                self.assert_refused(process, process.returncode)

    def test_a_folder_that_is_missing_or_a_target_in_the_way_is_5(self):
        (self.folder / "in.d").mkdir()
        (self.folder / "in.d" / "x.stl").mkdir()
        for target in ("none/x.stl", "in.d/x.stl"):
            process = run("build", CAT, "-o", self.folder / "m.vdb", "-o", self.folder / target,
                          "--resolution", 48)
            self.assert_refused(process, 5, "cannot-write")

    def test_a_full_disk_is_5_and_leaves_nothing(self):
        process = self.build(CAT, "--resolution", 96, preexec_fn=limit_file_size(100_000))
        self.assert_refused(process, 5, "cannot-write")

    def test_names_of_files_may_be_odd(self):
        for name in ("in. caté 猫.svg", "in.new\nline.svg", "in.%s'\"\t.svg"):
            with self.subTest(name=name):
                path = self.write(name, drawing("M 10 10 L 90 90"))
                self.assert_refused(self.build(path), 4, "outline-open")
                path.unlink()

    def test_sketches_after_an_output_are_no_outputs(self):
        sketches = [self.write(f"in.{k}.svg", drawing("M 10 10 L 90 90")) for k in "ab"]
        before = sketches[0].read_bytes()
        self.assert_code(run("build", "-o", self.folder / "{}.stl", *sketches), 4)
        self.assertEqual(sketches[0].read_bytes(), before)

    def test_a_device_is_not_replaced(self):
        process = run("build", CAT, "--report", "/dev/full", "--resolution", 48)
        self.assert_code(process, 5)
        self.assertTrue(os.path.exists("/dev/full") and not os.path.isfile("/dev/full"))


if __name__ == "__main__":
    main()
