# SPDX-License-Identifier: Apache-2.0
"""The pages' Python is run as it stands there, block after block."""
from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
# What a page's code needs beside the package.
NEEDS = {"gym.md": ["gymnasium"], "exports.md": ["pandas", "pyarrow", "mcap", "rosbags"]}


def pages():
    return [page.name for page in sorted(DOCS.glob("*.md"))
            if "```python\n" in page.read_text(encoding="utf-8")]


@pytest.mark.parametrize("page", pages())
def test_the_code_of_a_page_runs(page, tmp_path, monkeypatch):
    for package in NEEDS.get(page, []):
        pytest.importorskip(package)
    monkeypatch.chdir(tmp_path)
    text = (DOCS / page).read_text(encoding="utf-8")
    names = {"__name__": "page"}
    for block in re.finditer(r"```python\n(.*?)```", text, re.S):
        line = text.count("\n", 0, block.start(1))
        exec(compile("\n" * line + block[1], str(DOCS / page), "exec"), names)


def test_there_is_a_tutorial():
    assert "python.md" in pages()
