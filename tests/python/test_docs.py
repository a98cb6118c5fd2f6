# SPDX-License-Identifier: Apache-2.0
"""The pages' Python is run as it stands there, block after block."""
from __future__ import annotations

import re
from importlib.util import find_spec
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
# What a page's code needs beside the package.
NEEDS = {"gym.md": ["gymnasium"], "exports.md": ["pandas", "pyarrow", "mcap", "rosbags"]}
OF_THE_TEST_EXTRA_ALONE = "mcap_ros2"


def pages():
    return [page.name for page in sorted(DOCS.glob("*.md"))
            if "```python\n" in page.read_text(encoding="utf-8")]


@pytest.mark.parametrize("page", pages())
def test_the_code_of_a_page_runs(page, tmp_path, monkeypatch):
    for package in NEEDS.get(page, []):
        if find_spec(package) is None:
            assert find_spec(OF_THE_TEST_EXTRA_ALONE) is None, f"{package} is of the extra `test`, too"
            pytest.skip(f"{page} needs {package}: pip install '.[test]'")
    monkeypatch.chdir(tmp_path)
    text = (DOCS / page).read_text(encoding="utf-8")
    names = {"__name__": "page"}
    for block in re.finditer(r"```python\n(.*?)```", text, re.S):
        line = text.count("\n", 0, block.start(1))
        exec(compile("\n" * line + block[1], str(DOCS / page), "exec"), names)


def test_the_pages_are_there():
    assert {"python.md", *NEEDS} <= set(pages())
