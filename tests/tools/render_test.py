#!/usr/bin/env python3
"""`lascaux render`: views, sheets, turntables, what is said of files that can't be drawn."""
import configparser
import random
import re
import shlex
import subprocess

from program import EXAMPLES, SOURCE, ProgramTest, limit_file_size, main, messages, run

SMALL = ("--size", 48)


def level_set():
    """The cat as a small level set, built once."""
    import pathlib
    import tempfile
    folder = tempfile.TemporaryDirectory()
    path = pathlib.Path(folder.name) / "cat.vdb"
    process = run("build", EXAMPLES / "cat.svg", "-o", path, "--resolution", 48)
    assert process.returncode == 0, process.stderr
    return folder, path


FOLDER, CAT = level_set()


def size_of(path):
    """Width, height and channels of a picture, as OpenImageIO's own tool sees them."""
    text = subprocess.run(["iinfo", str(path)], capture_output=True, text=True, check=True).stdout
    return text.split(" : ")[1].split(",")[0].replace(" ", "") + text.split(",")[1].split()[0]


class RenderTest(ProgramTest):
    def draw(self, *arguments, code=0, model=CAT):
        process = run("render", model, *arguments, *SMALL)
        self.assert_code(process, code)
        return process

    def test_a_picture_of_a_level_set(self):
        process = self.draw("-o", self.folder / "cat.png")
        self.assertEqual(size_of(self.folder / "cat.png"), "48x484")
        self.assertEqual([m.split(": ")[2] for m in messages(process, "note")], ["rendered"])

    def test_several_views_share_a_sheet(self):
        self.draw("-o", self.folder / "a.png", "--view", "side,top,front", "--columns", 3)
        self.assertEqual(size_of(self.folder / "a.png"), "144x484")
        self.draw("-o", self.folder / "b.png", "--contact-sheet")
        self.assertEqual(size_of(self.folder / "b.png"), "96x964")

    def test_numbered_pictures_of_a_turn(self):
        self.draw("-o", self.folder / "{}-###.png", "--turntable", 4)
        self.assertEqual(self.files(), [f"cat-00{i}.png" for i in (1, 2, 3, 4)])
        self.assertEqual(size_of(self.folder / "cat-003.png"), "48x484")

    def test_a_contact_sheet_takes_all_models_of_the_call(self):
        other = self.write("other.vdb", CAT.read_bytes())
        self.draw(other, "-o", self.folder / "all.png", "--contact-sheet")
        self.assertEqual(size_of(self.folder / "all.png"), "192x964")
        self.draw(other, "-o", self.folder / "{}.png", "--contact-sheet")
        self.assertEqual(self.files(), ["all.png", "cat.png", "other.png", "other.vdb"])
        self.draw(other, "-o", self.folder / "no.png", code=2)

    def test_standard_input_is_read(self):
        with open(CAT, "rb") as stream:
            process = run("render", "-", "-o", self.folder / "{}.png", *SMALL, stdin=stream)
        self.assert_code(process, 0)
        self.assertEqual(self.files(), ["stdin.png"])

    def test_the_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 3):
            self.draw("-o", self.folder / f"{threads}.png", "--threads", threads)
        self.assertEqual((self.folder / "1.png").read_bytes(), (self.folder / "3.png").read_bytes())

    def test_wrong_command_lines_are_2(self):
        out = self.folder / "a.png"
        for arguments in (["render"], ["render", CAT], ["render", CAT, "-o", self.folder / "a.stl"],
                          ["render", CAT, "-o", out, "--view", "below"],
                          ["render", CAT, "-o", out, "--background", "#12"],
                          ["render", CAT, "-o", out, "--background", "blue"],
                          ["render", CAT, "-o", out, "--size", "0"],
                          ["render", CAT, "-o", out, "--size", "9", "--width", "8"],
                          ["render", CAT, "-o", out, "--turntable", "0"],
                          ["render", CAT, "-o", CAT]):
            process = run(*arguments)
            with self.subTest(arguments=arguments):
                self.assert_code(process, 2)
                self.assertEqual(len(messages(process, "error")), 1, process.stderr)
        process = run("render", "-", "-", "-o", self.folder / "{}.png")
        self.assert_code(process, 2)
        self.assertIn("only once", process.stderr)
        self.assertEqual(self.files(), [])

    def test_what_is_no_level_set_is_3_with_its_reason(self):
        sketch = (EXAMPLES / "cat.svg").read_bytes()
        whole = CAT.read_bytes()
        cases = [("not-vdb", b""), ("not-vdb", sketch), ("not-vdb", whole[:64]),
                 ("not-vdb", whole[:len(whole) // 2]), ("not-vdb", whole[:-9])]
        for code, content in cases:
            process = self.draw("-o", self.folder / "a.png", code=3,
                                model=self.write("bad.vdb", content))
            with self.subTest(code=code, bytes=len(content)):
                self.assertIn(f": error: {code}: ", process.stderr)
        self.assertIn("cannot-read", self.draw("-o", "a.png", code=3, model="none.vdb").stderr)
        process = self.draw("-o", self.folder / "a.png", "--grid", "part_wing", code=3)
        self.assertIn("'surface' (float)", process.stderr)
        self.assertEqual(self.files(), ["bad.vdb"])

    def test_damaged_files_never_crash_it(self):
        chance = random.Random(5)
        whole = CAT.read_bytes()
        for case in range(60):
            content = bytearray(whole)
            for _ in range(chance.choice((1, 3, 20))):
                # The head, where everything is decided, as often as the voxels.
                end = chance.choice((64, 1200, len(whole)))
                content[chance.randrange(end)] = chance.randrange(256)
            path = self.write("bad.vdb", bytes(content))
            process = run("render", path, "-o", self.folder / "a.png", "--size", 16)
            with self.subTest(case=case, said=process.stderr):
                self.assertIn(process.returncode, (0, 3))

    def test_file_managers_get_thumbnails(self):
        entry = configparser.ConfigParser(interpolation=None)
        entry.read(SOURCE / "share/thumbnailers/lascaux.thumbnailer")
        line = entry["Thumbnailer Entry"]["Exec"]
        for size in (128, 256, 512):
            out = self.folder / f"thumbnail {size}.tmp"  # some name files without an ending
            values = {"%i": str(CAT), "%u": f"file://{CAT}", "%o": str(out), "%s": str(size)}
            words = [values.get(word, word) for word in shlex.split(line)]
            self.assertEqual(words[0], entry["Thumbnailer Entry"]["TryExec"])
            self.assert_code(run(*words[1:]), 0)
            self.assertEqual(size_of(out), f"{size}x{size}4")
            self.assertEqual(out.read_bytes()[1:4], b"PNG")

    def test_file_managers_know_the_type(self):
        types = (SOURCE / "share/mime/packages/lascaux.xml").read_text()
        entry = (SOURCE / "share/thumbnailers/lascaux.thumbnailer").read_text()
        mime = re.search(r'mime-type type="([^"]+)"', types).group(1)
        self.assertIn(f"MimeType={mime};", entry)
        magic = re.search(r'value="([^"]+)"', types).group(1).encode().decode("unicode_escape")
        self.assertTrue(CAT.read_bytes().startswith(magic.encode("latin1")))

    def test_exr_holds_what_a_compositor_needs(self):
        self.draw("-o", self.folder / "a.exr")
        text = subprocess.run(["iinfo", "-v", str(self.folder / "a.exr")], capture_output=True,
                              text=True, check=True).stdout
        for channel in ("R (half)", "A (half)", "Z (float)", "id (float)", "N.X (half)", "N.Z (half)"):
            self.assertIn(channel, text)
        self.draw("-o", self.folder / "b.exr", "--threads", 1)
        same = subprocess.run(["idiff", str(self.folder / "a.exr"), str(self.folder / "b.exr")],
                              capture_output=True, text=True)
        self.assertEqual(same.returncode, 0, same.stdout)

    def test_a_transparent_picture_lies_on_any_page(self):
        self.draw("-o", self.folder / "a.exr", "--background", "transparent")
        stats = subprocess.run(["iinfo", "--stats", str(self.folder / "a.exr")],
                               capture_output=True, text=True, check=True).stdout
        least = re.search(r"Stats Min: (.*?) \(", stats).group(1).split()
        most = re.search(r"Stats Max: (.*?) \(", stats).group(1).split()
        self.assertEqual((float(least[3]), float(most[3])), (0, 1), stats)

    def test_a_full_disk_leaves_the_old_picture(self):
        old = self.write("cat.png", "old")
        process = run("render", CAT, "-o", old, "--size", 256, preexec_fn=limit_file_size(4096))
        self.assert_code(process, 5)
        self.assertEqual(old.read_bytes(), b"old")
        self.assertEqual(self.files(), ["cat.png"])


if __name__ == "__main__":
    main()
