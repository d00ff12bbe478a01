#!/usr/bin/env python3
"""Equal input gives equal bytes: from run to run, and for any number of threads."""
from program import EXAMPLES, ProgramTest, main, run

ENDINGS = (".vdb", ".stl", ".ply", ".png", ".json", ".svg")


class DeterminismTest(ProgramTest):
    def outputs(self, name, stem, threads):
        files = [self.folder / f"{stem}{ending}" for ending in ENDINGS]
        outputs = [a for file in files for a in ("-o", file)]
        process = run("build", EXAMPLES / f"{name}.svg", *outputs, "--no-timings", "--threads",
                      threads, "--resolution", 128)
        self.assert_code(process, 0)
        return [file.read_bytes() for file in files]

    def test_threads_and_runs_change_no_byte(self):
        for name in ("cat", "whale"):
            first = self.outputs(name, "a", 1)
            for stem, threads in (("b", 2), ("c", 2), ("d", 7)):
                for ending, one, two in zip(ENDINGS, first, self.outputs(name, stem, threads)):
                    self.assertEqual(one, two, f"{name}{ending} with {threads} threads")


if __name__ == "__main__":
    main()
