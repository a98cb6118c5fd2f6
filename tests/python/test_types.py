# SPDX-License-Identifier: Apache-2.0
"""The package is typed: a type checker sees what a user's program does with it."""
from __future__ import annotations

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import floorproof

PROGRAM = """
    import numpy as np
    import floorproof
    scenario = floorproof.load({"scenario": 1}, seed=3)
    reveal_type(scenario.plan().path)
    reveal_type(scenario.run().metrics["coverage"])
    reveal_type(scenario.run().events[0].mode)
    reveal_type(scenario.site.frame.cell(1.0, 2.0))
    reveal_type(floorproof.campaign(scenario, 3, out="c").variants)
    scenario.run(speed=3)
    floorproof.load(7)
"""


def test_a_type_checker_knows_the_package(tmp_path):
    pytest.importorskip("mypy")
    package = Path(floorproof.__file__).parent
    if not (package / "_core.pyi").exists():
        pytest.skip("the package is not installed with its stubs")
    file = tmp_path / "program.py"
    file.write_text(textwrap.dedent(PROGRAM), encoding="utf-8")
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache",
                          file], capture_output=True, text=True, check=False)
    said = [line.split(": ", 1)[1] for line in run.stdout.splitlines() if "program.py:" in line]
    assert [("ndarray" in said[0]), said[1:5]] == [True, [
        'note: Revealed type is "float | None"',
        'note: Revealed type is "str"',
        'note: Revealed type is "tuple[int, int]"',
        'note: Revealed type is "dict[str, Any]"',
    ]], run.stdout
    errors = [line for line in said if line.startswith("error")]
    assert len(errors) == 2, run.stdout
    assert "Unexpected keyword argument" in errors[0] and "incompatible type" in errors[1]


@pytest.mark.slow  # it reads pandas and Ray, too
def test_the_package_is_typed_itself(tmp_path):
    pytest.importorskip("mypy")
    package = Path(floorproof.__file__).parent
    if not (package / "_core.pyi").exists():
        pytest.skip("the package is not installed with its stubs")
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path, package],
                         capture_output=True, text=True, check=False)
    assert "checked" in run.stdout or "no issues" in run.stdout, run.stdout + run.stderr
    # The stubs are generated, and name dict and tuple without what they hold.
    assert [line for line in run.stdout.splitlines()
            if "error:" in line and "_core.pyi:" not in line] == []
