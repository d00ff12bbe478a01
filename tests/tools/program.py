"""What the tests of the program share: running it, and looking at what it left."""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["LASCAUX_PROGRAM"]
SOURCE = pathlib.Path(os.environ["LASCAUX_SOURCE"])
EXAMPLES = SOURCE / "examples"
SANITIZED = bool(os.environ.get("LASCAUX_SANITIZE"))
SLOWER = 12 if SANITIZED else 1  # how much longer a run may take than in a release build


def run(*arguments, timeout=60, **kwargs):
    """The finished process, its streams as text; never raises for its exit code."""
    kwargs.setdefault("stdin", subprocess.DEVNULL)
    if "input" in kwargs:
        del kwargs["stdin"]
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout * SLOWER, **kwargs)


def limit_file_size(size):
    """For preexec_fn: writing past `size` bytes fails, as on a full disk."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def messages(process, severity):
    """The lines on standard error of one severity."""
    return [line for line in process.stderr.splitlines() if f": {severity}: " in line]


class ProgramTest(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file())

    def assert_code(self, process, code):
        self.assertEqual(process.returncode, code, process.stderr + process.stdout)

    def report(self, name):
        return json.loads((self.folder / name).read_text())


def main():
    unittest.main(argv=sys.argv[:1], verbosity=1)
