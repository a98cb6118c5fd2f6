#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What arrows.py says of small trees: one that is as drawn, and that one broken in each way."""
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import arrows  # noqa: E402

PAGE = """
```mermaid
flowchart TD
  top["top"] --> middle["middle"] --> base["base"]
```

| folder | target | holds | may use |
|---|---|---|---|
| middle | `fp_middle` | things | MuJoCo |
"""

TREE = {
    "docs/architecture.md": PAGE,
    "top/a.cc": '#include "middle/b.h"\n#include "base/c.h"\n',
    "middle/b.h": '#include <mujoco/mujoco.h>\n#include "base/c.h"\n',
    "base/c.h": "",
    "base/CMakeLists.txt": "fp_library(fp_base SOURCES c.cc)\n",
    "middle/CMakeLists.txt": "fp_library(fp_middle SOURCES b.cc PUBLIC fp_base)\n",
    "tests/t.cc": '#include "top/a.h"\n',
}


class Arrows(unittest.TestCase):
    def of(self, changes):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**TREE, **changes}.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return arrows.findings(pathlib.Path(folder))

    def test_a_tree_as_drawn_has_no_findings(self):
        self.assertEqual(self.of({}), [])

    def test_an_include_against_the_arrows(self):
        self.assertEqual(self.of({"base/c.h": '\n#include "middle/b.h"\n'}),
                         ["base/c.h:2: base may not include middle"])

    def test_an_include_of_a_test(self):
        self.assertEqual(self.of({"base/c.h": '#include "tests/t.h"\n'}),
                         ["base/c.h:1: includes tests/t.h, which is not drawn"])

    def test_an_arrow_that_nobody_uses(self):
        self.assertEqual(self.of({"top/a.cc": '#include "base/c.h"\n'}),
                         ["docs/architecture.md: no #include uses the arrow from top to middle"])

    def test_a_header_that_reaches_too_many_files(self):
        limit = PAGE + "\n| header | files |\n|---|---|\n| `base/c.h` | {} |\n"
        for most, said in ((2, []), (1, ["base/c.h: reaches 2 files, at most 1"])):
            self.assertEqual(self.of({"docs/architecture.md": limit.format(most)}), said)
        gone = limit.format(2).replace("base/c.h", "base/d.h")
        self.assertEqual(self.of({"docs/architecture.md": gone}),
                         ["docs/architecture.md: nobody includes base/d.h"])

    def test_a_circle(self):
        page = PAGE.replace('base["base"]', 'base["base"]\n  base --> top')
        self.assertIn("docs/architecture.md: the arrows of base lead back to it",
                      self.of({"docs/architecture.md": page}))

    def test_a_folder_that_is_not_drawn(self):
        self.assertEqual(self.of({"attic/d.cc": ""}),
                         ["attic/d.cc: its folder is not drawn in docs/architecture.md"])

    def test_a_library_where_it_must_not_be(self):
        self.assertEqual(self.of({"top/a.cc": TREE["top/a.cc"] + "#include <mujoco/mujoco.h>\n"}),
                         ["top/a.cc:3: top may not use MuJoCo"])

    def test_a_link_line_against_the_arrows(self):
        self.assertEqual(
            self.of({"base/CMakeLists.txt": "fp_library(fp_base SOURCES c.cc PRIVATE fp_middle)\n"}),
            ["base/CMakeLists.txt: fp_base may not link fp_middle"])


if __name__ == "__main__":
    unittest.main()
