#!/usr/bin/env python3
"""Pictures: traced and built like drawings, in any format, and refused with a reason when they are none."""
import re
import struct
import subprocess
import zlib

from program import EXAMPLES, ProgramTest, main, messages, run

SIDE, PEN = 640, 7


def png(width, height, grey):
    """An 8-bit grey PNG of rows of bytes."""
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + bytes(grey[y * width:(y + 1) * width]) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def draw(curves):
    """A page with the curves of an SVG of `lascaux trace`, drawn with a round pen."""
    x0, y0, width, height = map(float, re.search(r'viewBox="([^"]*)"', curves).group(1).split())
    scale = (SIDE - 8 * PEN) / max(width, height)
    page = bytearray(b"\xf4" * (SIDE * SIDE))
    dabs = set()
    for data in re.findall(r' d="([^"]*)"', curves):
        numbers = [float(n) for n in re.findall(r"-?\d+\.?\d*", data)]
        points = [complex((x - x0) * scale + 4 * PEN, (y - y0) * scale + 4 * PEN)
                  for x, y in zip(numbers[::2], numbers[1::2])] if "h0" not in data else []
        for i in range(0, len(points) - 3, 3):
            a, b, c, d = points[i:i + 4]
            steps = 1 + int(abs(b - a) + abs(c - b) + abs(d - c))
            for k in range(2 * steps + 1):
                t = k / (2 * steps)
                u = 1 - t
                p = u**3 * a + 3 * u * u * t * b + 3 * u * t * t * c + t**3 * d
                dabs.add((round(4 * p.real), round(4 * p.imag)))
    for qx, qy in dabs:
        x, y, r = qx / 4, qy / 4, PEN / 2
        for v in range(int(y - r - 1), int(y + r + 2)):
            for u in range(int(x - r - 1), int(x + r + 2)):
                far = ((u + 0.5 - x)**2 + (v + 0.5 - y)**2)**0.5 - r
                level = int(24 + 220 * min(1, max(0, far + 0.5)))
                page[v * SIDE + u] = min(page[v * SIDE + u], level)
    return png(SIDE, SIDE, page)


class PictureTest(ProgramTest):
    drawn = {}  # pictures by name: drawing one takes a second

    def picture(self, name):
        """A picture of an example."""
        if name not in self.drawn:
            curves = self.folder / "curves.svg"
            self.assert_code(run("trace", EXAMPLES / f"{name}.svg", "-o", curves), 0)
            self.drawn[name] = draw(curves.read_text())
        return self.write(f"{name}.png", self.drawn[name])

    def converted(self, source, name, *options):
        target = self.folder / name
        subprocess.run(["oiiotool", source, *options, "-o", target], check=True, capture_output=True)
        return target

    def parts(self, sketch):
        """Role, relation and whether there is a partner, of each part that is built."""
        process = run("build", sketch, "--report", self.folder / "r.json", "--resolution", 48)
        self.assert_code(process, 0)
        return sorted((p["role"], str(p["relation"]), p["pair"] is not None)
                      for p in self.report("r.json")["parts"])

    def test_pictures_of_the_examples_are_understood_like_their_curves(self):
        for name in ("crocodile", "dog", "kangaroo"):
            with self.subTest(name=name):
                self.assertEqual(self.parts(self.picture(name)), self.parts(EXAMPLES / f"{name}.svg"))

    def test_traced_curves_give_the_same_model_as_the_picture(self):
        picture, curves = self.picture("cat"), self.folder / "traced.svg"
        self.assert_code(run("trace", picture, "-o", curves), 0)
        meshes = []
        for sketch in (picture, curves):
            mesh = self.folder / "m.stl"
            self.assert_code(run("build", sketch, "-o", mesh, "--resolution", 64), 0)
            meshes.append(mesh.read_bytes())
        self.assertEqual(*meshes)

    def test_any_format_is_read_whatever_its_name(self):
        picture = self.picture("cat")
        for name, options in (("a.jpg", ()), ("a.tif", ("-d", "uint16")), ("a.bmp", ()), ("a.webp", ("--ch", "Y,Y,Y")),
                              ("a.pgm", ()), ("a.png", ("--ch", "Y,Y,Y,A=1.0")), ("a.exr", ())):
            with self.subTest(name=name):
                other = self.converted(picture, name, *options)
                other = other.rename(self.folder / "picture")
                facts = self.folder / "t.json"
                self.assert_code(run("trace", other, "-o", facts), 0)
                trace = self.report("t.json")["trace"]
                self.assertEqual((trace["width"], trace["height"]), (SIDE, SIDE))
                self.assertGreater(trace["coverage"], 0.99)
                self.assertEqual(trace["ink_regions"], trace["curve_regions"])

    def test_a_photo_held_sideways_is_turned_upright(self):
        picture = self.converted(self.picture("cat"), "a.jpg", "--cut", f"{SIDE}x500+0+0",
                                 "--attrib", "Orientation", "6")
        self.assert_code(run("trace", picture, "-o", self.folder / "t.json"), 0)
        trace = self.report("t.json")["trace"]
        self.assertEqual((trace["width"], trace["height"]), (500, SIDE))

    def test_standard_input_takes_a_picture(self):
        data = self.picture("cat").read_bytes()
        target = self.folder / "t.svg"
        with (self.folder / "cat.png").open("rb") as stream:
            process = run("trace", "-", "--format", "png", "-o", target, stdin=stream)
        self.assert_code(process, 0)
        self.assertTrue(target.exists() and data)

    def test_threads_change_no_byte(self):
        picture = self.picture("dog")
        texts = []
        for threads in (1, 2, 5):
            target = self.folder / "t.svg"
            self.assert_code(run("trace", picture, "-o", target, "--threads", threads), 0)
            texts.append(target.read_bytes())
        self.assertEqual(len(set(texts)), 1)

    def test_what_is_no_drawing_is_3_with_a_reason(self):
        cat = self.picture("cat").read_bytes()
        jpeg = self.converted(self.folder / "cat.png", "cat.jpg").read_bytes()
        blank = png(300, 200, bytearray(b"\xf0" * 60000))
        noise = bytes((i * 7919 * (i >> 3) >> 5) & 255 for i in range(160000))
        for content, code in ((blank, "empty-page"), (png(400, 400, noise), "no-drawing"),
                              (cat[:len(cat) // 2], "broken-picture"),
                              (jpeg[:len(jpeg) // 2], "broken-picture"),
                              (b"\x89PNG\r\n\x1a\n" + bytes(100), "broken-picture"),
                              (b"P5 100000 100000 255\n" + bytes(100), "too-large")):
            with self.subTest(code=code, size=len(content)):
                path = self.write("in.png", content)
                process = run("build", path, "-o", self.folder / "m.stl")
                self.assert_code(process, 3)
                self.assertEqual(len(messages(process, "error")), 1, process.stderr)
                self.assertIn(f": error: {code}: ", process.stderr)
                self.assertFalse((self.folder / "m.stl").exists())

    def test_what_was_traced_is_said(self):
        process = run("trace", self.picture("cat"), "-o", self.folder / "t.svg")
        self.assertTrue([m for m in messages(process, "note") if ": traced: " in m], process.stderr)

    def test_a_hatched_drawing_is_traced_with_a_warning(self):
        # Lines so close that the page between them is lost here and there.
        level = lambda x, y: 20 if (x + y) % 4 < 2 and (x * x + y * 3) % 5 else 240
        page = bytearray(level(x, y) if 50 < x < 250 and 50 < y < 250 else 245
                         for y in range(300) for x in range(300))
        process = run("trace", self.write("in.png", png(300, 300, page)), "-o", self.folder / "t.svg")
        self.assertTrue("trace-incomplete" in process.stderr or "no-drawing" in process.stderr,
                        process.stderr)


if __name__ == "__main__":
    main()
