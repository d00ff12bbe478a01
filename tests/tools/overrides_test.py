#!/usr/bin/env python3
"""--overrides: one decision a test, read back from the parse dump; and files that are wrong."""
import json
import re

from program import ProgramTest, main, messages, run

# A goat: near legs with suggestive curves (strokes 0 and 1), far legs, an ear, a tail that stands up.
GOAT = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300" fill="none" stroke="black">
<path d="M125,140 C122,155 120,160 120,170 C118,210 120,240 116,270 C116,278 140,278 142,270 C144,240 148,215 150,188 C151,175 152,165 152,150"/>
<path d="M120,170 C112,150 108,140 104,125 C95,120 70,128 50,122 C40,112 44,98 56,94 C70,84 80,66 96,62 C112,58 122,70 130,80 C160,92 240,78 290,88 C320,94 332,120 328,150 C326,180 334,200 330,230 C328,250 330,262 326,272 C324,280 300,280 302,270 C306,240 300,215 290,185 C285,170 283,150 288,130"/>
<path d="M290,185 C250,196 190,196 150,188"/>
<path d="M97,62 C98,40 112,30 122,28 C124,44 120,58 112,64"/>
<path d="M158,190 C164,215 160,245 164,270 C164,278 186,278 186,270 C184,240 188,215 186,193"/>
<path d="M262,192 C262,220 256,240 258,268 C258,276 280,276 280,268 C280,250 290,225 298,208"/>
<path d="M322,112 C340,96 352,92 362,94 C356,108 344,120 327,128"/>
<circle cx="70" cy="104" r="3"/>
</svg>"""
NEAR_FRONT, FAR_FRONT, NEAR_HIND, FAR_HIND = [130, 250], [174, 262], [316, 260], [268, 262]
BODY, EAR, TAIL, HEAD = [200, 140], [113, 45], [345, 105], [60, 110]


def contains(ring, at):
    inside = False
    for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
        if (y0 > at[1]) != (y1 > at[1]) and at[0] < x0 + (at[1] - y0) / (y1 - y0) * (x1 - x0):
            inside = not inside
    return inside


def area(ring):
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1])) / 2


class OverridesTest(ProgramTest):
    def inspect(self, **overrides):
        """The process and, if there is one, the parse dump."""
        sketch = self.write("goat.svg", GOAT)
        file = self.write("o.json", json.dumps({"format": "lascaux.overrides/1", **overrides}))
        process = run("inspect", sketch, "-o", self.folder / "p.json", "--overrides", file)
        dump = json.loads((self.folder / "p.json").read_text()) if process.returncode == 0 else None
        return process, dump

    def node(self, dump, at):
        """The id and node of the smallest part around a point."""
        around = [i for i, part in enumerate(dump["parts"]) if contains(part["outline"], at)]
        part = min(around, key=lambda i: area(dump["parts"][i]["outline"]))
        return part, dump["graph"]["nodes"][part]

    def understood(self, **overrides):
        process, dump = self.inspect(**overrides)
        self.assert_code(process, 0)
        return dump

    def test_without_a_word_the_rules_hold(self):
        dump = self.understood()
        for at, role in ((BODY, "body"), (NEAR_FRONT, "foreground"), (FAR_FRONT, "background"),
                         (EAR, "foreground"), (TAIL, "sagittal")):
            self.assertEqual(self.node(dump, at)[1]["role"], role, at)

    def test_body_by_point_and_by_number(self):
        for body in (TAIL, self.node(self.understood(), TAIL)[0]):
            self.assertEqual(self.node(self.understood(body=body), TAIL)[1]["role"], "body")

    def test_roles(self):
        for role in ("sagittal", "ignored"):
            dump = self.understood(parts=[{"part": EAR, "role": role}])
            self.assertEqual(self.node(dump, EAR)[1]["role"], role)
            self.assertIsNone(self.node(dump, EAR)[1]["choice"])  # no rule chose it
        dump = self.understood(parts=[{"part": TAIL, "role": "foreground"}])
        self.assertEqual(self.node(dump, TAIL)[1]["role"], "foreground")
        self.assertEqual(self.node(dump, TAIL)[1]["relation"], "over")

    def test_pairs_are_made_and_parted(self):
        dump = self.understood(parts=[{"part": FAR_FRONT, "role": "foreground"},
                                      {"part": FAR_HIND, "role": "background", "near": FAR_FRONT}])
        near, far = self.node(dump, FAR_FRONT), self.node(dump, FAR_HIND)
        self.assertEqual((near[1]["pair"], far[1]["pair"]), (far[0], near[0]))
        self.assertIsNone(self.node(dump, NEAR_FRONT)[1]["pair"])

    def test_a_limb_in_the_plane_is_built_once(self):
        dump = self.understood(parts=[{"part": NEAR_HIND, "role": "sagittal"}])
        part, node = self.node(dump, NEAR_HIND)
        self.assertEqual(node["role"], "sagittal")
        self.assertEqual(self.node(dump, FAR_HIND)[1]["role"], "ignored")
        mirrored = [p["mirrored"] for p in dump["creature"] if p["part"] == part]
        self.assertEqual(mirrored, [False])

    def test_flat_parts_are_thin(self):
        dump = self.understood(parts=[{"part": EAR, "flat": True}])
        part = self.node(dump, EAR)[0]
        self.assertLess([p["depth_scale"] for p in dump["creature"] if p["part"] == part][0], 0.5)

    def test_cuts_make_limbs(self):
        dump = self.understood(cuts=[[[104, 125], [128, 78]]])
        self.assertEqual(dump["parts"][self.node(dump, HEAD)[0]]["root"]["evidence"], "override")
        # Where the rules have one already, it gives way: there are no two.
        cut = [[119, 220], [147, 220]]
        dump = self.understood(cuts=[cut])
        legs = [p for p in dump["parts"] if p["root"] and contains(p["outline"], NEAR_FRONT)]
        self.assertIn("override", [leg["root"]["evidence"] for leg in legs])

    def test_ignored_strokes_are_not_there(self):
        dump = self.understood(ignore_strokes=[6])
        self.assertTrue(all(edge["stroke"] != 6 for edge in dump["map"]["edges"]))
        self.assertEqual(len(dump["parts"]), len(self.understood()["parts"]) - 1)

    def test_what_is_not_there_is_said(self):
        for overrides in ({"ignore_strokes": [99]}, {"cuts": [[[0, 0], [1, 1]]]},
                          {"parts": [{"part": 99, "role": "ignored"}]},
                          {"parts": [{"part": [1, 1], "flat": True}]},
                          {"parts": [{"part": BODY, "role": "sagittal"}]},
                          {"parts": [{"part": EAR, "role": "background", "near": TAIL}]}):
            with self.subTest(overrides=overrides):
                process, _ = self.inspect(**overrides)
                self.assert_code(process, 4)
                self.assertIn("override-not-there", process.stderr)
        process, _ = self.inspect(body=99)
        self.assert_code(process, 4)
        self.assertIn("body-not-there", process.stderr)

    def test_bad_files_name_the_field(self):
        for overrides, field in (({"rolls": []}, "rolls"), ({"format": "x/2"}, "format"),
                                 ({"body": "torso"}, "body"), ({"ignore_strokes": 3}, "ignore_strokes"),
                                 ({"ignore_strokes": [-1]}, "ignore_strokes"),
                                 ({"cuts": [[1, 2]]}, "cuts"),
                                 ({"parts": [{"role": "ignored"}]}, "parts[0].part"),
                                 ({"parts": [{"part": 1, "role": "wing"}]}, "parts[0].role"),
                                 ({"parts": [{"part": 1, "role": "background"}]}, "parts[0].near"),
                                 ({"parts": [{"part": 1, "flat": 2}]}, "parts[0].flat"),
                                 ({"parts": [{"part": 1}]}, "parts[0]")):
            with self.subTest(overrides=overrides):
                process, _ = self.inspect(**overrides)
                self.assert_code(process, 3)
                self.assertEqual(len(messages(process, "error")), 1, process.stderr)
                self.assertRegex(process.stderr, "bad-overrides: .*: " + re.escape(field) + ":")
        sketch = self.write("goat.svg", GOAT)
        for text in ("", "[1, 2]", "{", b"\xff\xfe"):
            file = self.write("o.json", text)
            process = run("inspect", sketch, "-o", self.folder / "q.json", "--overrides", file)
            self.assert_code(process, 3)
            self.assertIn("bad-overrides", process.stderr)
        process = run("inspect", sketch, "-o", self.folder / "q.json", "--overrides", "nowhere.json")
        self.assert_code(process, 3)
        self.assertIn("cannot-read", process.stderr)

    def test_the_parse_picture_shows_the_numbers(self):
        sketch = self.write("goat.svg", GOAT)
        self.assert_code(run("inspect", sketch, "-o", self.folder / "p.svg"), 0)
        numbers = re.findall(r">s(\d+)</text>", (self.folder / "p.svg").read_text())
        self.assertEqual(sorted(map(int, numbers)), list(range(8)))


if __name__ == "__main__":
    main()
