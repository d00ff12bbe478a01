#!/usr/bin/env python3
"""The drawing's colours and the parts on pictures, in meshes and in volumes."""
import json
import re
import struct
import subprocess
import zipfile

from program import EXAMPLES, ProgramTest, main, messages, run

SMALL = ("--resolution", 64, "--picture-size", 96)
# A red body whose back is green, with two blue legs.
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300" stroke="#000" stroke-width="3">
<path id="body" fill="#d03020" d="M60,120 C60,60 340,60 340,120 C340,200 60,200 60,120 Z"/>
<path id="back" stroke="none" fill="#20a040" d="M80,105 C100,72 300,72 320,105 Z"/>
<path id="fore" fill="#2040c0" d="M100,140 L95,250 L125,250 L135,140"/>
<path id="hind" fill="#2040c0" d="M260,140 L265,250 L295,250 L300,140"/>
</svg>"""
RED, GREEN, BLUE = (208, 48, 32), (32, 160, 64), (32, 64, 192)


def pixels(path, *places):
    """8-bit sRGB of places of a picture, as OpenImageIO's tool sees them."""
    arguments = []
    for x, y in places:
        text = subprocess.run(["oiiotool", str(path), "--cut", f"1x1+{x}+{y}", "--printstats"], capture_output=True,
                              text=True, check=True).stdout
        arguments.append(tuple(float(v) for v in re.search(r"Stats Min: (.*?) \(", text).group(1).split()[:3]))
    return arguments


def hue(color):
    """Which of its components are the largest and the smallest."""
    return color.index(max(color)), color.index(min(color))


class MaterialsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.drawing = self.write("pony.svg", DRAWING)

    def build(self, *arguments, drawing=None):
        process = run("build", drawing or self.drawing, *SMALL, *arguments)
        self.assert_code(process, 0)
        return process

    def test_the_side_view_has_the_drawings_colours(self):
        self.build("-o", self.folder / "a.png", "--view", "side", "--material", "drawing")
        back, flank, leg = pixels(self.folder / "a.png", (48, 26), (48, 40), (24, 60))
        for seen, painted in ((back, GREEN), (flank, RED), (leg, BLUE)):
            self.assertEqual(hue(seen), hue(painted), (seen, painted))

    def test_a_volume_keeps_them(self):
        volume = self.folder / "a.vdb"
        for axes in ((), ("--for", "blender")):  # y up, and z up
            self.build("-o", volume, "--color", *axes)
            process = run("render", volume, "-o", self.folder / "b.png", "--view", "side", "--size", 96,
                          "--material", "drawing")
            self.assert_code(process, 0)
            self.assertEqual(messages(process, "warning"), [])
            for seen, painted in zip(pixels(self.folder / "b.png", (48, 26), (48, 40), (24, 60)), (GREEN, RED, BLUE)):
                self.assertEqual(hue(seen), hue(painted), axes)

    def test_meshes_have_them(self):
        self.build("-o", self.folder / "a.3mf", "-o", self.folder / "a.glb", "-o", self.folder / "a.ply")
        text = zipfile.ZipFile(self.folder / "a.3mf").read("3D/3dmodel.model").decode()
        colors = dict(re.findall(r'<base name="(.*?)" displaycolor="#(.*?)"', text))
        self.assertEqual(colors["body"], "D03020")
        self.assertEqual({colors[name] for name in colors if name != "body"}, {"2040C0"})
        content = (self.folder / "a.ply").read_bytes()
        head, body = content.split(b"end_header\n", 1)
        count = int(re.search(rb"element vertex (\d+)", head).group(1))
        record = struct.Struct("<6f3BH")
        seen = {record.unpack_from(body, i * record.size)[6:9] for i in range(count)}
        self.assertLessEqual({RED, GREEN, BLUE}, seen)
        glb = (self.folder / "a.glb").read_bytes()
        document = json.loads(glb[20:20 + struct.unpack_from("<I", glb, 12)[0]])
        self.assertIn("COLOR_0", document["meshes"][0]["primitives"][0]["attributes"])

    def test_parts_differ(self):
        self.build("-o", self.folder / "a.png", "--view", "side", "--material", "parts")
        flank, fore, hind = pixels(self.folder / "a.png", (48, 40), (24, 60), (70, 60))
        self.assertEqual(len({hue(c) for c in (flank, fore, hind)}), 3, (flank, fore, hind))

    def test_numbers_of_parts_are_in_exr_files(self):
        volume = self.folder / "a.vdb"
        self.build("-o", self.folder / "a.exr", "-o", volume, "--color", "--view", "side")
        self.assert_code(run("render", volume, "-o", self.folder / "b.exr", "--view", "side", "--size", 96), 0)
        for name in ("a.exr", "b.exr"):
            # Channels as somebody else's reader sorts them; outside it is -1.
            text = subprocess.run(["oiiotool", "-v", str(self.folder / name), "--ch", "id", "--printstats"],
                                  capture_output=True, text=True, check=True).stdout
            low, high = (float(re.search(rf"Stats {what}: (\S+)", text).group(1)) for what in ("Min", "Max"))
            self.assertEqual(low, -1, name)
            self.assertIn(high, (3, 4), name)  # the hind leg, or what is seen of the far one

    def test_what_a_material_needs_is_said(self):
        process = self.build("-o", self.folder / "a.png", "--material", "drawing", drawing=EXAMPLES / "cat.svg")
        self.assertIn("warning: no-colors: the drawing has no colours", process.stderr)
        volume = self.folder / "cat.vdb"
        self.build("-o", volume, drawing=EXAMPLES / "cat.svg")
        for material, code in (("drawing", "no-colors"), ("parts", "no-parts")):
            process = run("render", volume, "-o", self.folder / "b.png", "--material", material)
            self.assert_code(process, 3)
            self.assertIn(f"error: {code}: ", process.stderr)
            self.assertIn("--color", process.stderr)
        self.build("-o", volume, "--color", drawing=EXAMPLES / "cat.svg")
        process = run("render", volume, "-o", self.folder / "b.png", "--material", "drawing")
        self.assert_code(process, 0)
        self.assertIn("warning: no-colors: ", process.stderr)
        self.assert_code(run("render", volume, "-o", self.folder / "b.png", "--material", "gold"), 2)


if __name__ == "__main__":
    main()
