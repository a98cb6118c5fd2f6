# SPDX-License-Identifier: Apache-2.0
"""All episodes of a Gymnasium environment stay within its spaces, whatever is drawn."""
from __future__ import annotations

import warnings
from typing import Any, Dict

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")

import floorproof  # noqa: E402
import floorproof.gym  # noqa: E402,F401
from floorproof import InputError  # noqa: E402


def site(columns: int, rows: int, **more: Any) -> Dict[str, Any]:
    """So many free cells of 0.5 m; the robot stands in the middle of the last ones."""
    grid = "\n".join(["#" * (columns + 2)] + ["#" + "." * columns + "#"] * rows
                     + ["#" * (columns + 2)])
    return {"site": 1, "name": "room", "grid": {"cell_m": 0.5, "rows": grid},
            "start": {"x_m": 0.5 * columns, "y_m": 0.5 * rows, "yaw_deg": 0}, **more}


SMALL: Dict[str, Any] = {"scenario": 1, "site": site(4, 4), "robot": "beluga",
                         "sensors": {"lidar": {"beams": 36}},
                         "plan": {"planner": "boustrophedon"}}
SITES = {"size": [{"label": "small", "site": site(4, 4)}, {"label": "large", "site": site(18, 10)}]}


def make(scenario: Dict[str, Any], **options: Any) -> Any:
    return gymnasium.make("Floorproof-v0", scenario=scenario,
                          **{"reference": None, **options}).unwrapped


def driven(env: Any, steps: int = 15, **reset: Any) -> Dict[str, np.ndarray]:
    """The last observation, after all have been checked against the spaces."""
    observation, _ = env.reset(**reset)
    for _ in range(steps):
        assert env.observation_space.contains(observation), {
            name: value for name, value in observation.items()
            if not env.observation_space[name].contains(value)}
        observation, _, terminated, truncated, _ = env.step(env.action_space.high)
        if terminated or truncated:
            break
    assert env.observation_space.contains(observation)
    return observation


@pytest.mark.parametrize("robot", ["rover", "htetro"])
def test_the_action_is_that_of_the_variants_robot(robot: str) -> None:
    env = make({**SMALL, "site": site(10, 10), "matrix": {"robot": ["beluga", robot]}},
               variant=f"robot={robot}")
    alone = floorproof.load({**SMALL, "site": site(10, 10), "robot": robot}).robot
    speeds = [alone["max_speed_mps"]] * (2 if robot == "htetro" else 1)
    assert env.action_space.high == pytest.approx([*speeds, alone["max_yaw_rate_radps"]])
    assert env.observation_space["twist"].high[0] >= alone["max_speed_mps"]
    driven(env, seed=0)


def test_a_robot_that_takes_other_numbers_is_refused_and_named() -> None:
    env = make({**SMALL, "matrix": {"robot": ["beluga", "htetro"]}}, variant="robot=beluga")
    with pytest.raises(InputError, match=r"robot = htetro: takes vx_mps, vy_mps, wz_radps, but the "
                                         r"action space is beluga's: vx_mps, wz_radps") as raised:
        env.reset(options={"variant": "robot=htetro"})
    assert "\n" not in str(raised.value)
    with pytest.raises(InputError, match="reset"):
        env.step([0, 0])
    driven(env, seed=0)  # and it is whole after that


@pytest.mark.filterwarnings("ignore:.*observation space is too small.*")
def test_a_slower_robot_is_driven_in_the_faster_ones_spaces() -> None:
    env = make({**SMALL, "site": site(18, 10), "matrix": {"robot": ["rover", "beluga"]}},
               variant="robot=rover")
    driven(env, seed=0, options={"variant": "robot=beluga"})
    slow = floorproof.load({**SMALL, "robot": "beluga"}).robot["max_speed_mps"]
    assert env.action_space.high[0] > slow
    observation = driven(env, steps=60, seed=0, options={"variant": "robot=beluga"})
    assert observation["twist"][0] < 1.1 * slow


@pytest.mark.parametrize("key", ["matrix", "randomise"])
def test_another_number_of_beams_is_refused_and_named(key: str) -> None:
    beams = [36, 72] if key == "matrix" else {"choice": [36, 72]}
    env = make({**SMALL, key: {"sensors.lidar.beams": beams}},
               **({"variant": "beams=36"} if key == "matrix" else {}))
    shape = env.observation_space["lidar"].shape
    refused = 0
    for episode in range(8):
        named = {"variant": "beams=72"} if key == "matrix" else {}
        try:
            driven(env, steps=1, options={"episode": episode, **named})
        except InputError as error:
            refused += 1
            assert f"must be {shape[0]}, as in the observation space" in str(error)
    assert refused == 8 if key == "matrix" else 0 < refused < 8


def test_a_variants_own_lidar_is_enough_and_none_is_refused() -> None:
    bare = {k: v for k, v in SMALL.items() if k != "sensors"}
    two = {**bare, "matrix": {"with": [{"label": "lidar", "sensors": {"lidar": {"beams": 8}}},
                                       {"label": "bumper", "sensors": {"bumper": {}}}]}}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = make(two, variant="with=lidar")
    assert env.observation_space["lidar"].shape == (8,)
    with pytest.raises(InputError, match="sensors.lidar: is missing"):
        env.reset(options={"variant": "with=bumper"})


@pytest.mark.parametrize("draws", [
    {"randomise": {"sensors.lidar.range_m": {"uniform": [0.5, 3]}}},
    {"site": {"site": 1, "generate": {"kind": "room", "cells": [8, 8]}},
     "randomise": {"site.generate.cells": {"choice": [[8, 8], [30, 30]]}}},
], ids=["range", "site"])
def test_what_is_drawn_is_cut_to_the_spaces_and_a_warning_says_so(draws: Dict[str, Any]) -> None:
    env = make({**SMALL, **draws}, max_time_s=1)
    with pytest.warns(UserWarning, match="the observation space is too small for") as said:
        for episode in range(10):
            driven(env, options={"episode": episode})
    assert len(said) == 1


def test_a_lidar_of_shorter_range_ends_where_it_ends() -> None:
    env = make({**SMALL, "site": site(18, 10), "matrix": {"sensors.lidar.range_m": [25, 2]}},
               variant="range_m=25")
    assert driven(env, seed=0)["lidar"].max() > 3
    nearer = driven(env, seed=0, options={"variant": "range_m=2"})["lidar"]
    assert nearer.max() == 2


@pytest.mark.parametrize("reference", ["plan", None])
def test_a_larger_site_is_held_where_the_environment_is_made_with_it(reference: Any) -> None:
    scenario = {**SMALL, "matrix": SITES}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = make(scenario, reference=reference, variant="size=large")
        for variant in ("size=large", "size=small"):
            driven(env, seed=0, options={"variant": variant})
    env = make(scenario, reference=reference, variant="size=small")
    with pytest.warns(UserWarning, match="too small for pose, plan_ahead"):
        pose = driven(env, seed=0, options={"variant": "size=large"})["pose"]
    assert pose[0] == env.observation_space["pose"].high[0]


@pytest.mark.filterwarnings("ignore:.*observation space is too small.*")
@pytest.mark.parametrize("mode", ["sync", "async"])
def test_many_with_other_draws_go_together(mode: str) -> None:
    drawn = {**SMALL, "randomise": {"sensors.lidar.range_m": {"uniform": [0.5, 3]}}}
    envs = gymnasium.make_vec("Floorproof-v0", num_envs=3, vectorization_mode=mode, scenario=drawn,
                              reference=None, max_time_s=0.1)
    try:
        for _ in range(3):
            assert envs.observation_space.contains(envs.reset()[0])
            for _ in range(7):
                assert envs.observation_space.contains(envs.step(envs.action_space.sample())[0])
    finally:
        envs.close()
