# SPDX-License-Identifier: Apache-2.0
"""Errors are one printable line of bounded length, with files that are not text named."""
from __future__ import annotations

from pathlib import Path
from typing import Callable

import pytest

import floorproof

from conftest import ROOM


def line_of(call: Callable[[], object]) -> str:
    with pytest.raises((floorproof.InputError, floorproof.InternalError)) as raised:
        call()
    text = str(raised.value)
    assert len(text) <= 1000
    assert text.isprintable(), ascii(text)
    return text


@pytest.mark.parametrize("text", ["two\nlines", "\u202egnp", "\x1b[31m", "\u2028", "\x9b", "\udcff"])
def test_whoever_raises_it_it_is_one_printable_line(text: str) -> None:
    for kind in (floorproof.InputError, floorproof.InternalError):
        def call() -> None:
            raise kind(f"a{text}b")
        assert line_of(call).startswith("a")


def test_long_values_are_cut() -> None:
    line = line_of(lambda: floorproof.load({**ROOM, "plan": "x" * 100_000}))
    assert "xxx..." in line
    line_of(lambda: floorproof.load("x" * 3000 + "/y" * 500))


def test_a_planner_that_raises_lines_is_one_line() -> None:
    @floorproof.planner("raises_lines")
    def plan(request: object) -> object:
        raise ValueError("first\nsecond " + "x" * 100_000)

    scenario = floorproof.load({**ROOM, "plan": "raises_lines"})
    assert "ValueError: first second" in line_of(scenario.plan)


@pytest.mark.parametrize("name", ["result.json", "trace.csv", "encounters.csv", "plan.csv"])
def test_records_that_are_not_text_are_named(name: str, tmp_path: Path) -> None:
    floorproof.load(ROOM).run(out=tmp_path)
    (tmp_path / name).write_bytes(b"x_m,y_m,t_s\n\xff\xfe\n")

    def read() -> None:
        floorproof.read(tmp_path)
        if name == "plan.csv":
            from floorproof._recorded import plan_columns
            plan_columns(tmp_path / name)
    assert name in line_of(read)


def test_scenarios_that_are_not_text_are_named(tmp_path: Path) -> None:
    file = tmp_path / "scenario.yaml"
    file.write_bytes(b"scenario: 1\nname: \xff\n")
    assert str(file)[-40:] in line_of(lambda: floorproof.load(file))
    line_of(lambda: floorproof.load(tmp_path / "\udcff.yaml"))
