# SPDX-License-Identifier: Apache-2.0
"""Scenarios and sites from files and dicts; what is wrong with them."""
from __future__ import annotations

import pickle
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import floorproof

SHORT = [[1.0, 1.0], [1.4, 1.0]]  # a plan of a second or two


def test_a_dict_is_read_as_a_file_is(room, tmp_path):
    scenario = floorproof.load(room)
    assert (scenario.name, scenario.robot["name"], scenario.planner) == ("a room", "beluga",
                                                                         "boustrophedon")
    assert scenario.start == (1.0, 1.0, 0.0)
    assert scenario.variants == ["default"]
    text = scenario.resolved(tmp_path)
    file = tmp_path / "again.yaml"
    file.write_text(text, encoding="utf-8")
    assert floorproof.load(file).resolved(tmp_path) == text


def test_a_site_has_its_cells_and_hazards():
    site = floorproof.load_site({
        "site": 1, "name": "two",
        "grid": {"cell_m": 0.5, "rows": "####\n#..#\n####\n"},
        "hazards": [{"type": "step", "id": "sill", "height_m": 0.01, "known": False,
                     "polygon_m": [[0.6, 0.6], [0.8, 0.6], [0.8, 0.9], [0.6, 0.9]]}]})
    assert site.occupancy.shape == (3, 4)
    assert site.occupancy.tolist() == [[1, 1, 1, 1], [1, 0, 0, 1], [1, 1, 1, 1]]
    assert site.frame == floorproof.Frame(4, 3, 0.5, (0.0, 0.0, 0.0))
    sill, = site.hazards
    assert (sill.id, sill.type, sill.hazard_class, sill.known, sill.height_m) == (
        "sill", "step", "level_change", False, 0.01)
    assert sill.keep_off is None  # no robot is to drive there
    assert site.frame.cell(0.7, 0.7) == (1, 1)
    assert site.frame.centre(1, 2) == (1.25, 0.75)


@pytest.mark.parametrize("episode", [-1, 10**8 + 1, 1.5, "2", None])
def test_episodes_count_from_nought(room, episode):
    with pytest.raises(floorproof.InputError, match="episode = .*: must be (a whole number|at least 0)"):
        floorproof.load(room).episode(episode)


@pytest.mark.parametrize("change, says", [
    ({"robott": "beluga"}, "robott: unknown key; did you mean robot?"),
    ({"robot": "beluuga"}, "did you mean beluga?"),
    ({"plan": {"planner": "boustrophedonn"}}, "did you mean boustrophedon?"),
    ({"plan": {"planner": "boustrophedon", "overlapp": 0.1}}, "unknown key; did you mean"),
    ({"start": {"x_m": 0.1, "y_m": 0.1}}, "lies in a wall"),
    ({"start": {"x_m": float("nan"), "y_m": 1}}, "start.x_m"),
    ({"control_hz": "fast"}, "control_hz = fast"),
    ({"site": 7}, "site"),
])
def test_what_is_wrong_is_said_in_a_line(room, change, says):
    with pytest.raises(floorproof.InputError) as wrong:
        floorproof.load({**room, **change})
    assert says in str(wrong.value)
    assert "\n" not in str(wrong.value)
    assert isinstance(wrong.value, ValueError)


def test_errors_are_the_command_lines(command_line, tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("scenario: 1\nsite: nowhere.yaml\nrobot: beluga\n", encoding="utf-8")
    with pytest.raises(floorproof.InputError) as wrong:
        floorproof.load(file)
    said = subprocess.run([command_line, "plan", file], capture_output=True, text=True, check=False)
    assert said.returncode == 2
    assert said.stderr == f"floorproof: {wrong.value}\n"


def test_what_yaml_has_not_is_refused(room):
    with pytest.raises(floorproof.InputError, match="is nothing that YAML has"):
        floorproof.load({**room, "goal": object()})
    endless = {}
    endless["name"] = endless
    for odd in ({(1, 2): 3}, endless, {"name": {1, 2}}):
        with pytest.raises(floorproof.InputError, match="is nothing that YAML has"):
            floorproof.load({**room, **odd})
    with pytest.raises(floorproof.InputError, match="for dicts"):
        floorproof.load("scenario.yaml", folder="elsewhere")


# Of one, two, three and four bytes; what no one sees; what YAML's own words begin with.
WORDS = ["caf\u00e9 \u4e2d", "\U0001f916 \U0010ffff", "\u00a0\ufeff|",
         "tab\tand \\ud83e \"quoted\"\nline", ": - # {a: 1} & *b", " spaces "]


@pytest.mark.filterwarnings("ignore:runs a program")
@pytest.mark.parametrize("word", WORDS)
def test_any_character_may_stand_in_a_text(room, tmp_path, word):
    assert floorproof.load({**room, "name": word}).name == word
    assert floorproof.load(room, name=word).name == word
    assert floorproof.load(room).with_(name=word).name == word
    assert floorproof.load_site({**room["site"], "name": word}).name == word
    command = ["sh", "-c", 'printf %s "$1" > "$2"; exit 1', "sh", word, tmp_path / word.strip()]
    assert floorproof.load({**room, "plan": {"command": command}}).plan().status == "failed"
    assert (tmp_path / word.strip()).read_text(encoding="utf-8") == word


@pytest.mark.parametrize("use", [
    lambda room, half: floorproof.load({**room, "name": half}),
    lambda room, half: floorproof.load({**room, half: 1}),
    lambda room, half: floorproof.load({**room, "plan": {"command": ["echo", half]}}),
    lambda room, half: floorproof.load(room, {f"plan.{half}": 1}),
    lambda room, half: floorproof.load(room).with_(name=half),
    lambda room, half: floorproof.load_site({**room["site"], "name": half}),
])
def test_half_a_character_is_none(room, use):
    with pytest.raises(floorproof.InputError, match=r"\\udcff.*: a lone surrogate is no character"):
        use(room, "half \udcff")


def test_keys_are_set_as_on_the_command_line(room):
    scenario = floorproof.load(room, {"robot.clearance_m": 0.02}, seed=7)
    assert scenario.seed == 7
    assert scenario.with_(seed=8).seed == 8
    assert scenario.seed == 7
    assert scenario.with_({"plan.planner": "spiral"}).planner == "spiral"
    assert scenario.with_(gate="none").variants == ["default"]


def test_numbers_of_numpy_are_numbers(room):
    scenario = floorproof.load({**room, "start": {"x_m": np.float32(1.0), "y_m": np.array(1.0)}})
    assert scenario.start[:2] == (1.0, 1.0)


def test_a_pickled_scenario_needs_none_of_its_files(room, tmp_path):
    folder = tmp_path / "there"
    folder.mkdir()
    site = folder / "site.yaml"
    site.write_text("site: 1\nname: filed\ngrid:\n  cell_m: 0.5\n  rows: |\n    #####\n    #...#\n"
                    "    #...#\n    #####\n", encoding="utf-8")
    scenario = floorproof.load({**room, "site": "site.yaml"}, folder=folder).with_plan(SHORT)
    before = scenario.run()
    kept = pickle.dumps(scenario)
    site.rename(folder / "gone.yaml")
    again = pickle.loads(kept)
    assert again.site.name == "filed"
    assert again.run().result == before.result
    assert pickle.loads(pickle.dumps(scenario.episode(3)))._which == (3, None)


def test_an_episode_has_its_draws(room):
    drawing = floorproof.load({**room, "randomise": {"site.floor.friction": {"uniform": [0.6, 1]}}})
    drawing = drawing.with_plan(SHORT)
    drawn = [drawing.episode(e).run().drawn["site.floor.friction"] for e in range(3)]
    assert len(set(drawn)) == 3
    assert drawing.episode(1).run().drawn["site.floor.friction"] == drawn[1]
    with pytest.raises(floorproof.InputError, match="variant = wide: unknown"):
        drawing.episode(0, "wide")


def test_threads_drive_side_by_side(room):
    scenario = floorproof.load({**room, "randomise": {"start.y_m": {"uniform": [0.9, 1.1]}}})
    scenario = scenario.with_plan(SHORT)
    alone = [scenario.episode(e).run().result for e in range(4)]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda e: scenario.episode(e).run().result, range(4)))
    assert together == alone


def test_bundled_models_are_there():
    for name in ("htetro.xml", "beluga.xml"):
        assert (floorproof.models_folder() / name).is_file()


def test_a_folder_says_that_it_is_none(tmp_path):
    with pytest.raises(floorproof.InputError, match=str(tmp_path)):
        floorproof.load(Path(tmp_path))
