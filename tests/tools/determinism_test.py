#!/usr/bin/env python3
"""Equal input gives equal bytes: from run to run, and for any number of threads."""
from program import EXAMPLES, ProgramTest, main, run

PRINT = ("--base", "--min-wall", 2, "--hollow", 3, "--faces", 20000)
ENDINGS = (".vdb", ".stl", ".ply", ".png", ".json", ".svg")


class DeterminismTest(ProgramTest):
    def outputs(self, name, stem, threads, *options):
        files = [self.folder / f"{stem}{ending}" for ending in ENDINGS]
        outputs = [a for file in files for a in ("-o", file)]
        process = run("build", EXAMPLES / f"{name}.svg", *outputs, "--no-timings", "--threads",
                      threads, "--resolution", 128, *options)
        self.assert_code(process, 0)
        return [file.read_bytes() for file in files]

    def test_nor_do_they_when_it_is_prepared_for_printing(self):
        first = self.outputs("whale", "a", 1, *PRINT)
        for stem, threads in (("b", 2), ("c", 7)):
            for ending, one, two in zip(ENDINGS, first, self.outputs("whale", stem, threads, *PRINT)):
                self.assertEqual(one, two, f"{ending} with {threads} threads")

    def test_threads_and_runs_change_no_byte(self):
        for name in ("cat", "whale"):
            first = self.outputs(name, "a", 1)
            for stem, threads in (("b", 2), ("c", 2), ("d", 7)):
                for ending, one, two in zip(ENDINGS, first, self.outputs(name, stem, threads)):
                    self.assertEqual(one, two, f"{name}{ending} with {threads} threads")


if __name__ == "__main__":
    main()
