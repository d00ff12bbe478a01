#!/usr/bin/env python3
"""The command line as scripts see it: exit codes, messages, names of outputs, interrupts."""
import os
import pathlib
import re
import signal
import subprocess
import time

from program import EXAMPLES, PROGRAM, SLOWER, ProgramTest, main, messages, run

CAT = EXAMPLES / "cat.svg"
SMALL = ("--resolution", 48)


class CommandTest(ProgramTest):
    def test_main_job_leaves_all_its_files(self):
        names = ["cat.vdb", "cat.stl", "cat.ply", "cat.png", "cat.json", "cat.svg"]
        outputs = [a for name in names for a in ("-o", self.folder / name)]
        process = run("build", CAT, *outputs, *SMALL)
        self.assert_code(process, 0)
        self.assertEqual(process.stdout, "")
        self.assertEqual(self.files(), sorted(names))
        self.assertEqual(len([m for m in messages(process, "note") if ": built: " in m]), 1)

    def test_openvdb_is_loaded_only_where_it_is_used(self):
        # The dynamic loader says what it loads.
        environment = {**os.environ, "LD_DEBUG": "files"}
        cases = (("cat.stl", [], False), ("cat.json", [], False), ("cat.vdb", [], False), ("cat.png", [], False),
                 ("cat.png", ["--material", "parts"], True), ("cat.vdb", ["--fog"], True))
        for name, options, uses in cases:
            process = run("build", CAT, "-o", self.folder / name, *options, *SMALL, env=environment)
            self.assert_code(process, 0)
            self.assertEqual("libopenvdb" in process.stderr, uses, [name, *options])

    def test_without_outputs_it_is_a_check(self):
        process = run("build", CAT, *SMALL)
        self.assert_code(process, 0)
        self.assertIn("nothing was asked to be written", process.stderr)

    def test_messages_have_file_severity_and_code(self):
        process = run("build", CAT, *SMALL)
        for line in process.stderr.splitlines():
            self.assertRegex(line, r"^.*cat\.svg(:\d+)?: (note|warning|error): [a-z0-9-]+: \S")

    def test_pipes_hear_no_progress(self):
        process = run("build", CAT, *SMALL)
        self.assertNotIn("\r", process.stderr)
        self.assertNotIn("\x1b", process.stderr)

    def test_quiet_leaves_warnings_alone(self):
        self.assertEqual(messages(run("build", CAT, *SMALL, "--quiet"), "note"), [])

    def test_several_sketches_need_braces(self):
        process = run("build", CAT, EXAMPLES / "dog.svg", "-o", self.folder / "a.stl", *SMALL)
        self.assert_code(process, 2)
        self.assertIn("{}", process.stderr)
        self.assertEqual(self.files(), [])

    def test_several_sketches_are_built_one_after_the_other(self):
        process = run("build", CAT, EXAMPLES / "dog.svg", "-o", self.folder / "{}.stl", "--report",
                      self.folder / "{}.txt", *SMALL)
        self.assert_code(process, 0)
        self.assertEqual(self.files(), ["cat.stl", "cat.txt", "dog.stl", "dog.txt"])
        self.assertEqual(self.report("dog.txt")["sketch"]["file"], str(EXAMPLES / "dog.svg"))

    def test_the_worst_of_several_exit_codes_wins_and_the_others_are_built(self):
        empty = self.write("empty.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>")
        process = run("build", empty, CAT, "-o", self.folder / "{}.stl", *SMALL)
        self.assert_code(process, 3)
        self.assertEqual(self.files(), ["cat.stl", "empty.svg"])

    def test_standard_input_needs_its_format(self):
        text = CAT.read_text()
        out = self.folder / "{}.stl"
        self.assert_code(run("build", "-", "-o", out, *SMALL, input=text), 2)
        self.assert_code(run("build", "-", "--format", "svg", "-o", out, *SMALL, input=text), 0)
        self.assertEqual(self.files(), ["stdin.stl"])

    def test_wrong_command_lines_are_2(self):
        for arguments in ([], ["build"], ["build", CAT, "--wings", "2"], ["paint", CAT],
                          ["inspect", CAT, "-o", "-"], ["build", CAT, "-o", self.folder / "cat.fbx"],
                          ["build", CAT, "--pose", "drawn"], ["build", CAT, CAT, "--overrides", "x"],
                          ["build", CAT, "-o", CAT], ["inspect", CAT],
                          ["build", CAT, "--voxel-size", "1e-5"]):
            process = run(*arguments)
            with self.subTest(arguments=arguments):
                self.assert_code(process, 2)
                self.assertEqual(len(messages(process, "error")), 1, process.stderr)
        self.assertEqual(self.files(), [])

    def test_memory_that_is_not_there_is_refused_with_the_estimate(self):
        process = run("build", CAT, "-o", self.folder / "cat.vdb", "--voxel-size", "0.004")
        self.assert_code(process, 2)
        self.assertIn("out-of-memory", process.stderr)
        self.assertRegex(process.stderr, r"\d [MG]B")
        self.assertEqual(self.files(), [])

    def test_help_and_version_go_to_standard_output(self):
        help_text = run("--help")
        self.assert_code(help_text, 0)
        self.assertLess(help_text.stdout.index("Examples:"), help_text.stdout.index("Usage:"))
        version = run("--version")
        self.assert_code(version, 0)
        for library in ("OpenVDB", "CGAL", "OpenImageIO"):
            self.assertRegex(version.stdout, library + r" \d+\.\d+")

    def test_inspect_draws_and_dumps_the_parse(self):
        process = run("inspect", CAT, "-o", self.folder / "{}.svg", "-o", self.folder / "{}.json")
        self.assert_code(process, 0)
        self.assertEqual(self.report("cat.json")["format"], "lascaux.parse/1")
        self.assertIn('<g id="parts"', (self.folder / "cat.svg").read_text())

    def test_the_body_can_be_named(self):
        report = self.folder / "r.json"
        body = self.report_of(report)["body"]["id"]
        outline = next(p for p in self.report_of(report)["parts"] if p["id"] == body)["outlines"][0]
        x = sum(p[0] for p in outline) / len(outline)
        y = sum(p[1] for p in outline) / len(outline)
        self.assertEqual(self.report_of(report, "--body", f"{x},{y}")["body"]["id"], body)

    def report_of(self, path, *options):
        self.assert_code(run("build", CAT, "--report", path, *SMALL, *options), 0)
        return self.report(path.name)

    def test_an_interrupt_is_130_and_leaves_nothing(self):
        for wait in (0.0, 0.3):
            arguments = [PROGRAM, "build", str(CAT), "-o", str(self.folder / "cat.vdb"), "-o",
                         str(self.folder / "cat.stl"), "--resolution", "1500"]
            process = subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)
            self.wait_until_it_listens(process)
            time.sleep(wait * SLOWER)
            process.send_signal(signal.SIGINT)
            stderr = process.communicate(timeout=60 * SLOWER)[1]
            self.assertEqual(process.returncode, 130, stderr)
            self.assertIn("cancelled", stderr)
            self.assertEqual(self.files(), [])

    def wait_until_it_listens(self, process):
        """Until the program has a handler for SIGINT: loading libraries takes a while."""
        status = pathlib.Path(f"/proc/{process.pid}/status")
        while process.poll() is None:
            caught = re.search(r"^SigCgt:\s*(\w+)", status.read_text(), re.M)
            if caught and int(caught[1], 16) >> (signal.SIGINT - 1) & 1:
                return
            time.sleep(0.005)

    def test_files_that_were_there_stay_when_a_build_fails(self):
        old = self.write("empty.stl", "old")
        empty = self.write("empty.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>")
        self.assert_code(run("build", empty, "-o", old), 3)
        self.assertEqual(old.read_text(), "old")


if __name__ == "__main__":
    main()
