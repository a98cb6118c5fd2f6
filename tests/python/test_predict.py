# SPDX-License-Identifier: Apache-2.0
"""How often a plan will fail, by planted rates."""
from __future__ import annotations

import hashlib
import json
import math
import pickle
import re
import subprocess
from pathlib import Path
from typing import Any, Dict

import pytest

import floorproof

STUCK_AT_A_COVER = 0.2  # rate
NEVER = 1e-12


def constant(eta: float) -> Dict[str, Any]:
    return {"events": 0, "blocks": [], "coefficients": [eta], "members": [[eta]] * 16}


def kind(type_: str, passage: str, rate: float, per: str = "encounter") -> Dict[str, Any]:
    """Of one rate at any meeting, all of it of getting stuck."""
    shares = {"veer_off": -100, "stuck": 100, "roll_over": -100}
    return {"type": type_, "passage": passage, "manner": "any", "per": per,
            "encounters": 1000, "cleared": 1000,
            "censored": 0, "way_m": 1000, "theta": 1, "axes": [], "any": constant(math.log(math.expm1(rate))),
            "splits": [{"mode": mode, **constant(eta)} for mode, eta in shares.items()]}


def hash_of(model: Path) -> str:
    """By which a model is known: its text without comments, space squeezed."""
    text = re.sub(r"<!--.*?-->", " ", model.read_text(encoding="utf-8"), flags=re.DOTALL)
    text = re.sub(r" ?([<>]) ?", r"\1", re.sub(r"\s+", " ", text))
    return hashlib.sha256((hashlib.sha256(text.encode()).hexdigest() + "\n").encode()).hexdigest()


@pytest.fixture(scope="module")
def rates(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("rates") / "risk_model.json"
    robot = {"name": "beluga", "drive": "differential", "mass_kg": 12.16, "clearance_m": 0.025,
             "model": hash_of(floorproof.models_folder() / "beluga.xml")}
    kinds = [kind("cable_cover", "over", STUCK_AT_A_COVER),
             kind("free_floor", "beside", NEVER, "metre"),
             kind("wall_beside", "beside", NEVER, "metre")]
    file.write_text(json.dumps({"risk_model": 3, "robot": robot, "mirrored": True,
                                "encounters": 3000, "kinds": kinds, "unmeasured": []}),
                    encoding="utf-8")
    return file


@pytest.fixture
def covers(room: Dict[str, Any], rates: Path) -> floorproof.Scenario:
    """A straight way over two covers."""
    room["site"]["hazards"] = [
        {"type": "cable_cover", "id": name, "height_m": 0.01, "line_m": [[x_m, 0.5], [x_m, 2.0]]}
        for name, x_m in (("first", 1.7), ("second", 2.5))]
    return floorproof.load({**room, "risk": {"model": rates}}).with_plan([[1, 1.25], [3, 1.25]])


def test_a_plan_is_predicted_by_measured_rates(covers: floorproof.Scenario) -> None:
    told = covers.predict()
    assert (told["conditions"], told["complete"], told["robot"]) == (1, True, "beluga")
    first = 1 - math.exp(-STUCK_AT_A_COVER)
    second = math.exp(-STUCK_AT_A_COVER) * first
    assert told["any_failure"]["probability"] == pytest.approx(first + second, abs=1e-6)
    assert told["modes"]["stuck"]["probability"] == pytest.approx(first + second, abs=1e-6)
    assert told["hazards"]["first"] == pytest.approx(first, abs=1e-6)
    assert told["hazards"]["second"] == pytest.approx(second, abs=1e-6)
    over = [meeting for meeting in told["meetings"] if meeting["type"] == "cable_cover"]
    driven = [met for met in covers.run().encounters if met["type"] == "cable_cover"]
    assert [m["hazard"] for m in over] == [m["hazard"] for m in driven] == ["first", "second"]
    for expected, met in zip(over, driven):
        assert expected["size"] == met["size"]
        assert expected["x_m"] == pytest.approx(met["x_m"], abs=0.06)
        assert expected["met"]["speed_mps"] == pytest.approx(met["speed_mps"], abs=0.03)


def test_conditions_are_what_episodes_draw(covers: floorproof.Scenario) -> None:
    drawing = covers.with_({"randomise": {"site.floor.friction": {"uniform": [0.4, 0.8]}}})
    assert drawing.predict(draws=7)["conditions"] == 7
    third = drawing.episode(3)
    met = third.predict(draws=1)["meetings"][0]["met"]
    assert met["friction"] == third.site.floor_friction != drawing.episode(0).site.floor_friction


def test_of_a_variant_it_is_the_variants_plan(covers: floorproof.Scenario) -> None:
    two = covers.with_({"matrix": {"robot.clearance_m": [0.025, 0.02]}})
    heights = [two.episode(0, name).predict()["meetings"][0]["met"]["clearance_m"]
               for name in two.variants]
    assert heights == pytest.approx([0.025, 0.02], abs=1e-6)


def test_it_goes_where_its_scenario_goes(covers: floorproof.Scenario) -> None:
    assert pickle.loads(pickle.dumps(covers)).predict() == covers.predict()


def test_a_plan_made_in_python_is_predicted(covers: floorproof.Scenario) -> None:
    @floorproof.planner("test_over_one_cover")
    def over_one(request: Any) -> Any:
        return [request.start[:2], (2.1, request.start[1])]
    told = covers.with_({"plan": {"planner": "test_over_one_cover"}}).predict()
    assert told["hazards"]["first"] == pytest.approx(1 - math.exp(-STUCK_AT_A_COVER), abs=1e-6)
    assert "second" not in told["hazards"]


def test_what_cannot_be_predicted_is_refused(covers: floorproof.Scenario,
                                             room: Dict[str, Any]) -> None:
    with pytest.raises(floorproof.InputError, match="risk.model: is missing"):
        floorproof.load(room).predict()
    with pytest.raises(floorproof.InputError, match="plan = rolling_window: is made on the way"):
        covers.with_({"plan": "rolling_window"}).predict()
    for draws in (0, 100_001, 1.5):
        with pytest.raises(floorproof.InputError, match=f"draws = {draws}: must be"):
            covers.predict(draws=draws)  # type: ignore[arg-type]


def test_the_command_line_says_the_same(covers: floorproof.Scenario, command_line: Path,
                                        tmp_path: Path) -> None:
    drawing = covers.with_({"randomise": {"robot.mass_kg": {"uniform": [11, 13]}}})
    drawing.run(out=tmp_path / "run")
    subprocess.run([command_line, "predict", tmp_path / "run" / "scenario.resolved.yaml", "--out",
                    tmp_path / "told", "--draws", "5"], capture_output=True, check=True)
    told = json.loads((tmp_path / "told" / "predict.json").read_text(encoding="utf-8"))
    assert floorproof.load(tmp_path / "run" / "scenario.resolved.yaml").predict(5) == told
