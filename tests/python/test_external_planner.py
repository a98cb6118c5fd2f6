# SPDX-License-Identifier: Apache-2.0
"""A planner that is any program is named, as a warning, before it is run."""
from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from typing import Any, Callable, Dict

import pytest

import floorproof

MOWER = Path(__file__).resolve().parents[2] / "docs" / "examples" / "mower.py"

Call = Callable[[floorproof.Scenario, Path], Any]

# Whatever has a program asked.
CALLS: Dict[str, Call] = {
    "plan": lambda scenario, out: scenario.plan(),
    "run": lambda scenario, out: scenario.run(),
    "run into": lambda scenario, out: scenario.run(out=out),
    "run into, lines taken": lambda scenario, out: scenario.run(out=out, say=lambda line: None),
    "run, progress shown": lambda scenario, out: scenario.run(progress=lambda **_: Bar()),
    "campaign": lambda scenario, out: floorproof.campaign(scenario, 1, out=out, jobs=1),
}


class Bar:
    def update(self, n: float) -> None:
        pass

    def close(self) -> None:
        pass


@pytest.fixture(params=CALLS, name="call")
def each_call(request: pytest.FixtureRequest) -> Call:
    return CALLS[request.param]


@pytest.fixture
def asked(tmp_path: Path) -> Path:
    """Is there once the program was run."""
    return tmp_path / "asked"


@pytest.fixture
def scenario(room: Dict[str, Any], asked: Path, tmp_path: Path) -> floorproof.Scenario:
    program = tmp_path / "plan.sh"
    program.write_text("#!/bin/sh\ntouch asked\n"
                       "printf 'x_m,y_m\\n1,1\\n1.2,1\\n' > \"$1\"/plan.csv\n", encoding="utf-8")
    program.chmod(0o755)
    return floorproof.load({**room, "plan": {"command": ["./plan.sh"]}}, folder=tmp_path)


def test_of_a_file_it_is_started_only_with_trust(room: Dict[str, Any], scenario: floorproof.Scenario,
                                                 asked: Path, tmp_path: Path) -> None:
    file = tmp_path / "scenario.yaml"
    file.write_text(json.dumps({**room, "plan": {"command": ["./plan.sh"]}}), encoding="utf-8")
    with pytest.raises(floorproof.InputError, match=r"plan.command = ./plan.sh: .*--trust"):
        floorproof.load(file).plan()
    assert not asked.exists()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert floorproof.load(file, trust=True).plan().status == "success"
    assert asked.exists()


def test_it_is_named_at_the_line_that_asks(call: Call, scenario: floorproof.Scenario, asked: Path,
                                           tmp_path: Path) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call(scenario, tmp_path / "out")
    told, = [w for w in caught if "runs a program" in str(w.message)]
    assert str(told.message).endswith("names: ./plan.sh")
    assert told.filename == __file__
    asks = Path(told.filename).read_text(encoding="utf-8").splitlines()[told.lineno - 1]
    assert "lambda scenario, out:" in asks
    assert asked.exists()


def test_as_an_error_it_keeps_the_program_from_being_run(call: Call, scenario: floorproof.Scenario,
                                                         asked: Path, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "runs a program")
        with pytest.raises(floorproof.InternalError, match="runs a program") as error:
            call(scenario, tmp_path / "out")
    assert isinstance(error.value.__cause__, UserWarning)
    assert not asked.exists() and not (tmp_path / "out").exists()


def test_a_plan_that_is_there_asks_nobody(scenario: floorproof.Scenario, asked: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scenario.run([[1, 1], [1.2, 1]])
    assert not asked.exists()


def test_which_program_is_not_drawn(scenario: floorproof.Scenario) -> None:
    with pytest.raises(floorproof.InputError, match=r"randomise.plan.command.*cannot be drawn"):
        scenario.with_({"randomise": {"plan.command": {"choice": [["./plan.sh"], ["./other"]]}}})


@pytest.mark.parametrize("pattern", ["lines", "squares", "rings"])
@pytest.mark.filterwarnings("ignore:runs a program")
def test_the_example_asks_a_planner_that_others_wrote(room: Dict[str, Any], pattern: str) -> None:
    pytest.importorskip("coverage_path_planner",
                        reason="the package coverage-path-planner is not installed")
    # A pillar in the middle: the garden has a hole.
    rows = ["#" * 14] + ["#" + "." * 12 + "#"] * 8 + ["#" * 14]
    rows[5] = "#......#.....#"
    room["site"]["grid"]["rows"] = "\n".join(rows)
    plan = floorproof.load({**room, "plan": {"command": [sys.executable, str(MOWER), pattern]}}).plan()
    assert plan.status == "success", plan.message
    assert 0.8 < plan.info["coverage"] < 1


@pytest.mark.filterwarnings("ignore:runs a program")
def test_the_example_says_where_it_has_no_room(room: Dict[str, Any]) -> None:
    pytest.importorskip("coverage_path_planner",
                        reason="the package coverage-path-planner is not installed")
    room["site"]["grid"] = {"cell_m": 0.4, "rows": "#####\n#...#\n#####"}
    room["start"] = {"x_m": 1, "y_m": 0.6}
    plan = floorproof.load({**room, "plan": {"command": [sys.executable, str(MOWER), "lines"]}}).plan()
    assert plan.status == "failed"
    assert plan.message.endswith("there is no room for a garden")
