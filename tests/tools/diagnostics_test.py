#!/usr/bin/env python3
"""Small drawings that make the program say one thing each: code, place and exit code."""
import json

from program import ProgramTest, main, messages, run

SVG = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 60'>{}</svg>"
PATH = "<path fill='none' stroke='black' stroke-width='0.2' d='{}'/>"
BLOB = "M 10 30 C 10 5 90 5 90 30 C 90 55 10 55 10 30 Z"


class DiagnosticsTest(ProgramTest):
    def build(self, *paths, options=()):
        sketch = self.write("in.svg", SVG.format("".join(PATH.format(data) for data in paths)))
        return run("build", sketch, "--report", self.folder / "r.json", "--resolution", 48, *options)

    def found(self, code):
        """The report's diagnostics with this code."""
        all_of_them = json.loads((self.folder / "r.json").read_text())["diagnostics"]
        return [d for d in all_of_them if d["code"] == code]

    def assert_says(self, process, severity, code):
        self.assertTrue([m for m in messages(process, severity) if f": {code}: " in m],
                        process.stderr)

    def test_a_small_gap_is_closed_with_a_warning_at_its_place(self):
        process = self.build("M 10 30 C 10 5 90 5 90 30 C 90 55 12 55 10.2 32")
        self.assert_code(process, 0)
        self.assert_says(process, "warning", "gap-closed")
        x, y = self.found("gap-closed")[0]["at"]
        self.assertLess(abs(x - 10) + abs(y - 31), 3)

    def test_a_large_gap_is_an_error_at_its_place(self):
        process = self.build("M 10 30 C 10 5 90 5 90 30 C 90 50 60 50 40 48")
        self.assert_code(process, 4)
        self.assert_says(process, "error", "outline-open")
        self.assertEqual(len(self.found("outline-open")), 1)

    def test_a_body_that_is_nowhere_is_an_error(self):
        process = self.build(BLOB, options=("--body", "500,500"))
        self.assert_code(process, 4)
        self.assert_says(process, "error", "body-not-there")

    def test_guesses_are_warnings_at_their_places(self):
        leg = "M 60 {0} C 59 60 61 65 60 75 L 66 75 C 67 65 65 60 66 {0}"
        process = self.build(BLOB, leg.format(47.9))
        self.assert_code(process, 0)
        self.assert_says(process, "warning", "limb-guessed")
        x, y = self.found("limb-guessed")[0]["at"]
        self.assertLess(abs(x - 63) + abs(y - 62), 4)
        process = self.build("M 50 30 C 50 5 90 5 90 30 C 90 55 50 55 50 30 Z",
                             "M 50 29 C 50 5 10 5 10 30 C 10 55 50 55 50 31")
        self.assert_code(process, 0)
        self.assert_says(process, "warning", "body-unsure")

    def test_standard_input_is_read_once(self):
        process = run("build", "-", "-", "--format", "svg", input=SVG.format(PATH.format(BLOB)))
        self.assert_code(process, 2)
        self.assert_says(process, "error", "usage")

    def test_what_was_made_is_said(self):
        self.assert_says(self.build(BLOB), "note", "built")
        process = run("inspect", self.folder / "in.svg", "-o", self.folder / "p.svg")
        self.assert_says(process, "note", "understood")


if __name__ == "__main__":
    main()
