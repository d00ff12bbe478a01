#!/usr/bin/env python3
"""Rules that the sources keep: who may know whom, which libraries show in headers, every diagnostic is tested and explained."""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["LASCAUX_SOURCE"])
# What each module may include besides itself (docs/architecture.md).
MAY_KNOW = {
    "base": set(),
    "sketch": {"base"},
    "field": {"base"},
    "skeleton": {"base", "sketch", "field"},
    "volume": {"base", "sketch", "field", "skeleton"},
    "io": {"base", "sketch", "field", "skeleton", "volume"},
}
LONGEST = 450  # lines
# Where a diagnostic is made: one of these functions, perhaps an argument, then the code.
CODE = re.compile(r'\b(?:Note|Warning|Error|Usage|InputError|Fail|Warn|Describe|add)\(\s*'
                  r'(?:[\w:.]+,\s*)?"([a-z]+(?:-[a-z]+)*)"')


def sources(*folders, endings=(".h", ".cpp", ".inc")):
    for folder in folders:
        for path in sorted((SOURCE / folder).rglob("*")):
            if path.suffix in endings:
                yield path


def includes(path):
    return re.findall(r'^#include\s+["<]([^">]+)[">]', path.read_text(), re.M)


class SourcesTest(unittest.TestCase):
    def test_imports_run_one_way(self):
        for path in sources("include/lascaux", "src"):
            module = path.relative_to(SOURCE).parts[2 if "include" in path.parts else 1]
            for name in includes(path):
                parts = name.split("/")
                other = parts[1] if parts[0] == "lascaux" else parts[0]
                if len(parts) > 1 and other in MAY_KNOW and other != module:
                    with self.subTest(file=path.relative_to(SOURCE), includes=name):
                        self.assertIn(other, MAY_KNOW[module])

    def test_libraries_stay_behind_the_headers(self):
        for path in sources("include/lascaux"):
            module = path.relative_to(SOURCE).parts[2]
            for name in includes(path):
                with self.subTest(file=path.relative_to(SOURCE), includes=name):
                    self.assertNotRegex(name, r"^(CGAL|OpenImageIO|pugixml|2geom|CLI|fmt|nlohmann)")
                    if name.startswith("openvdb"):
                        self.assertIn(module, ("volume", "io"))

    def test_every_diagnostic_is_provoked_by_a_test_and_explained(self):
        texts = [path.read_text() for path in sources("src", "tools")]
        codes = {code for text in texts for code in CODE.findall(text)}
        self.assertGreater(len(codes), 20)
        tests = "\n".join(p.read_text() for p in sources("tests", endings=(".cpp", ".h", ".py")))
        page = (SOURCE / "docs/diagnostics.md").read_text()
        explained = set(re.findall(r"^\| `([a-z0-9-]+)`", page, re.M))
        for code in sorted(codes):
            with self.subTest(code=code):
                self.assertTrue(code in explained, "docs/diagnostics.md has no row for it")
        for code in sorted(explained - codes):
            with self.subTest(code=code, why="explained, but nothing says it"):
                self.assertTrue(any(f'"{code}"' in text for text in texts))
        for code in sorted(explained):
            with self.subTest(code=code, why="no test names it"):
                self.assertTrue(re.search(rf'"(?:[^"\n]* )?{code}(?: [^"\n]*)?"', tests))

    def test_files_are_small(self):
        for path in sources("include", "src", "tools", "tests", endings=(".h", ".cpp", ".py")):
            with self.subTest(file=path.relative_to(SOURCE)):
                self.assertLessEqual(len(path.read_text().splitlines()), LONGEST)

    def test_headers_are_included_once(self):
        for path in sources("include", "src", "tools", endings=(".h",)):
            self.assertIn("#pragma once", path.read_text(), path)


if __name__ == "__main__":
    unittest.main()
