#!/usr/bin/env python3
"""Whatever goes wrong while a file of any format is written, the old one stays as it was and no half of a new one is left."""
import ctypes
import os
import pathlib
import resource
import signal
import subprocess
import time

from program import EXAMPLES, PROGRAM, SLOWER, ProgramTest, main, messages, run

CAT = EXAMPLES / "cat.svg"
FORMATS = (".vdb", ".stl", ".3mf", ".glb", ".obj", ".ply", ".usda", ".png", ".exr", ".svg", ".json")
SMALL = ("--resolution", 32, "--picture-size", 64, "--quiet")
OLD = "what was here before"


def forget_that_root_may_write_everywhere():
    """For preexec_fn: the program runs without the capability CAP_DAC_OVERRIDE."""
    if os.geteuid() == 0:
        drop_from_bounding_set, dac_override = 24, 1
        assert ctypes.CDLL(None).prctl(drop_from_bounding_set, dac_override, 0, 0, 0) == 0


def small_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))


class WriteErrorsTest(ProgramTest):
    def assert_refused(self, path, process, words):
        """Exit code 5, one error that names the file and what to do, and all as it was."""
        self.assert_code(process, 5)
        errors = messages(process, "error")
        self.assertEqual(len(errors), 1, process.stderr)
        self.assertRegex(errors[0], rf"cannot-write: cannot write '{path}': .*{words}")
        if path.is_file():
            self.assertEqual(path.read_text(), OLD)
        self.assertEqual([p.name for p in path.parent.iterdir()], [path.name])

    def paths(self):
        """One for each format, in a folder of its own."""
        paths = [self.folder / ending[1:] / f"cat{ending}" for ending in FORMATS]
        for path in paths:
            path.parent.mkdir()
        return paths

    def build(self, path, **kwargs):
        return run("build", CAT, "-o", path, *SMALL, **kwargs)

    def test_a_limit_on_file_sizes(self):
        for path in self.paths():
            with self.subTest(format=path.suffix):
                path.write_text(OLD)
                self.assert_refused(path, self.build(path, preexec_fn=small_files), "ulimit")

    def test_no_permission(self):
        for path in self.paths():
            with self.subTest(format=path.suffix):
                path.write_text(OLD)
                path.parent.chmod(0o555)
                process = self.build(path, preexec_fn=forget_that_root_may_write_everywhere)
                path.parent.chmod(0o755)
                self.assert_refused(path, process, "choose a place that you may write to")

    def test_a_folder_in_the_way(self):
        for path in self.paths():
            with self.subTest(format=path.suffix):
                path.mkdir()
                (path / "file").write_text(OLD)
                self.assert_refused(path, self.build(path), "a folder has this name")
                self.assertEqual((path / "file").read_text(), OLD)

    def test_a_full_disk(self):
        # A disk of three pages in a namespace of its own, in which anybody may mount; one is the old file's.
        disk = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c",
                'mount -t tmpfs -o size=12k none "$1" && printf "$2" > "$1/$3" && { "$4" build "$5" -o "$1/$3" --quiet '
                '--resolution 64; echo $? $(ls -A "$1"); cat "$1/$3"; }', "sh", str(self.folder), OLD]
        if subprocess.run([*disk, "x", "true", ""], capture_output=True).returncode:
            self.skipTest("no disk can be mounted here")
        for ending in FORMATS:
            with self.subTest(format=ending):
                done = subprocess.run([*disk, f"cat{ending}", PROGRAM, CAT], capture_output=True, text=True,
                                      timeout=60 * SLOWER)
                self.assertEqual(done.stdout, f"5 cat{ending}\n{OLD}", done.stderr)
                self.assertIn("make room on the disk", done.stderr)

    def test_a_kill_in_the_middle_leaves_all_old_files_or_all_new_ones(self):
        """Killed when the first, the second, ... of all files is begun; the last one is soon followed by the renaming of all, which
        no system does at once."""
        paths = [self.folder / f"cat{ending}" for ending in FORMATS]
        arguments = [PROGRAM, "build", CAT, *[a for p in paths for a in ("-o", p)], "--resolution", 64, "--quiet"]
        killed = 0
        for count in range(1, len(FORMATS)):
            for path in paths:
                path.write_text(OLD)
            process = subprocess.Popen(list(map(str, arguments)), stderr=subprocess.DEVNULL)
            self.wait_for_files(process, count)
            process.send_signal(signal.SIGKILL)
            killed += process.wait() == -signal.SIGKILL
            texts = {path.read_bytes() == OLD.encode() for path in paths}
            self.assertEqual(len(texts), 1, f"{count}: some are new and some are old")
            self.assertEqual(self.files(), sorted(p.name for p in paths), count)
        self.assertGreaterEqual(killed, len(FORMATS) - 3)

    def wait_for_files(self, process, count):
        """Until the program has begun `count` files in the folder: they have no names yet."""
        while process.poll() is None:
            begun = set()
            for link in pathlib.Path(f"/proc/{process.pid}/fd").iterdir():
                try:
                    begun.add(os.readlink(link))
                except OSError:
                    continue
            if len([name for name in begun if name.startswith(str(self.folder))]) >= count:
                return
            time.sleep(0.001)


if __name__ == "__main__":
    main()
