# SPDX-License-Identifier: Apache-2.0
"""The Gymnasium environment: its contract, its verdicts, its misuse."""
from __future__ import annotations

import subprocess
import sys
import warnings
from typing import Any, Dict, List, Tuple

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed")

import floorproof  # noqa: E402
import floorproof.gym  # noqa: E402,F401
from floorproof import InputError  # noqa: E402

# 4 m x 2 m inside its walls; the robot stands at the lower left and looks along x.
ROOM: Dict[str, Any] = {
    "scenario": 1,
    "site": {"site": 1, "name": "room",
             "grid": {"cell_m": 0.5, "rows": "\n".join(
                 ["#" * 10] + ["#" + "." * 8 + "#"] * 4 + ["#" * 10])},
             "start": {"x_m": 1.0, "y_m": 1.0, "yaw_deg": 0}},
    "robot": "beluga",
    "plan": {"planner": "boustrophedon"},
    "sensors": {"lidar": {"beams": 36}},
}


def room(**changes: Any) -> Dict[str, Any]:
    return {**ROOM, **changes}


def make(scenario: Any = None, **options: Any) -> Any:
    return gymnasium.make("Floorproof-v0", scenario=ROOM if scenario is None else scenario,
                          **options)


@pytest.fixture
def env():
    made = make(reference=None)
    yield made
    made.close()


def drive(env: Any, action: Any, most: int = 10000) -> Tuple[Dict, float, bool, bool, Dict]:
    """Until it ends; the last step's answer, with all reward."""
    total = 0.0
    for _ in range(most):
        observation, reward, terminated, truncated, info = env.step(
            action(observation) if callable(action) else action)
        total += reward
        if terminated or truncated:
            break
    return observation, total, terminated, truncated, info


def follow(observation: Dict[str, np.ndarray]) -> np.ndarray:
    """Towards the point that a tracker would head for; first turned to it."""
    x, y = observation["plan_ahead"][:2]
    off = np.arctan2(y, x)
    return np.array([0.25 * (abs(off) < 0.4), 1.5 * off], dtype=np.float32)


# --- the contract

@pytest.mark.parametrize("reference", ["plan", None])
def test_it_passes_the_checks_of_gymnasium(reference: Any) -> None:
    from gymnasium.utils.env_checker import check_env

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        # Twists are in m/s and rad/s, on purpose; whoever wants -1 to 1 wraps a RescaleAction.
        warnings.filterwarnings("ignore", message=".*symmetric and normalized.*")
        env = make(reference=reference)
        check_env(env.unwrapped, skip_render_check=True)


def test_spaces_are_those_of_robot_and_lidar(env: Any) -> None:
    assert env.action_space.shape == (2,)
    robot = env.unwrapped.scenario.robot
    assert env.action_space.high == pytest.approx(
        [robot["max_speed_mps"], robot["max_yaw_rate_radps"]])
    assert env.observation_space["lidar"].shape == (36,)
    assert env.observation_space["local_map"].shape == (3, 40, 40)
    assert "plan_ahead" not in env.observation_space.spaces
    assert len(env.unwrapped.lidar_angles) == 36


def test_a_plan_that_folds_the_robot_is_for_its_own_tracker() -> None:
    gap = floorproof.models_folder() / "scenarios" / "htetro_narrow_gap.yaml"
    with pytest.raises(InputError, match=r"htetro_narrow_gap.yaml: plan.*: folds the robot"):
        make(floorproof.load(gap, {"sensors.lidar": {}})).reset()
    make(floorproof.load(gap, {"sensors.lidar": {}}), reference=None).reset()


def test_a_holonomic_robot_takes_three_numbers() -> None:
    env = make(room(robot="htetro"), reference=None)
    assert env.action_space.shape == (3,)
    env.reset(seed=0)
    for _ in range(60):
        observation, *_, info = env.step([0.0, 0.2, 0.0])
    assert info["truth"][1] > 1.1 and abs(info["truth"][0] - 1) < 0.05
    assert observation["twist"][1] == pytest.approx(0.2, abs=0.05)


def test_a_scenario_without_a_lidar_gets_one_and_a_word() -> None:
    bare = room()
    del bare["sensors"]
    with pytest.warns(UserWarning, match="sensors.lidar is added"):
        env = make(bare, reference=None)
    assert env.observation_space["lidar"].shape == (90,)


def test_its_name_may_say_where_it_is() -> None:
    loads = ("import gymnasium, sys; env = gymnasium.make('floorproof.gym:Floorproof-v0', "
             "scenario={}); print(env.unwrapped.scenario.name, env.spec.id)")
    said = subprocess.run([sys.executable, "-c", loads.format(ROOM)], check=True,
                          capture_output=True, text=True)
    assert said.stdout.split() == ["scenario", "Floorproof-v0"]
    without = "import floorproof, sys; print('gymnasium' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", without], check=True, capture_output=True,
                          text=True)
    assert said.stdout.split() == ["False"]


@pytest.mark.parametrize("mode,context", [("sync", None), ("async", "spawn"), ("async", "fork")])
def test_vector_environments_have_workers(mode: str, context: Any) -> None:
    kwargs = {} if context is None else {"context": context}
    envs = gymnasium.make_vec("Floorproof-v0", num_envs=2, vectorization_mode=mode,
                              vector_kwargs=kwargs, scenario=ROOM, reference=None, max_time_s=0.1)
    try:
        observation, info = envs.reset(seed=[3, 4])
        assert observation["local_map"].shape == (2, 3, 40, 40)
        assert list(info["episode_id"]) == [3, 4]
        for _ in range(7):  # beyond the end: each begins its next episode
            _, _, _, truncated, info = envs.step(np.zeros((2, 2), dtype=np.float32))
        assert not truncated.any() and info["t_s"][0] < 0.1
    finally:
        envs.close()


# --- what is observed and earned

def test_what_is_seen_around_agrees(env: Any) -> None:
    observation, info = env.reset(seed=1)
    x, y, c, s = observation["pose"]
    assert (x, y, np.arctan2(s, c)) == pytest.approx(info["truth"], abs=1e-6)
    # The wall behind is 0.5 m off, the one to the right too; the beams are told from the lidar.
    angles, lidar = env.unwrapped.lidar_angles, observation["lidar"]
    ahead, left, behind = (lidar[np.argmin(np.abs(angles - a))] for a in (0, np.pi / 2, -np.pi))
    assert ahead == pytest.approx(3.5, abs=0.25) and left == pytest.approx(1.5, abs=0.25)
    assert behind == pytest.approx(0.5, abs=0.25)
    # Of the map, 4 m x 4 m, x to the right: the wall behind is at column 20 - 5, that on the left
    # (up) at row 20 - 15, that on the right at row 20 + 5.
    walls, swept, left_over = observation["local_map"]
    assert (walls[19, :15] == 255).all() and (walls[19, 15:] == 0).all()
    assert (walls[:5, 20] == 255).all() and (walls[5:25, 20] == 0).all()
    assert (walls[25:, 20] == 255).all()
    assert swept[20, 20] == 255 and left_over[20, 20] == 0  # under the tool
    assert swept[20, 30] == 0 and left_over[20, 30] == 255
    assert not (swept & left_over).any() and not (walls & left_over).any()


def test_the_local_map_turns_with_the_robot(env: Any) -> None:
    before = env.reset(seed=1)[0]["local_map"][0]
    info = {"truth": (0, 0, 0)}
    for _ in range(300):
        observation, *_, info = env.step([0, 2 * (np.pi / 2 - info["truth"][2])])
    turned = np.arctan2(observation["pose"][3], observation["pose"][2])
    assert turned == pytest.approx(np.pi / 2, abs=0.03)
    # What was to the left is ahead: the picture has turned clockwise.
    same = observation["local_map"][0] == np.rot90(before, -1)
    assert same.mean() > 0.93


def test_reward_is_the_coverage_gained() -> None:
    env = make(coverage_reward=10, max_time_s=4)
    observation, info = env.reset(seed=0)
    begun = info["coverage"]
    total = 0.0
    while True:
        observation, reward, terminated, truncated, info = env.step(follow(observation))
        total += reward
        assert observation["coverage"][0] == pytest.approx(info["coverage"])
        if terminated or truncated:
            break
    assert truncated and not terminated and info["outcome"] == "timeout"
    assert total == pytest.approx(10 * (info["coverage"] - begun)) and total > 0.2


def test_a_tiny_policy_covers_the_room_along_its_plan() -> None:
    small = {**ROOM["site"], "grid": {"cell_m": 0.5, "rows": "\n".join(
        ["######"] + ["#....#"] * 4 + ["######"])}}
    env = make(room(site=small, success={"min_coverage": 0.8}), action_repeat=5)
    observation, _ = env.reset(seed=0)
    while True:
        observation, _, terminated, truncated, info = env.step(follow(observation))
        if terminated or truncated:
            break
    assert terminated and info["outcome"] == "success", info["message"]
    assert info["metrics"]["coverage"] > 0.8 and info["failure"] == {}
    assert env.unwrapped.episode.metrics == info["metrics"]


def test_a_free_drive_is_done_when_enough_is_covered() -> None:
    env = make(room(success={"min_coverage": 0.12}), reference=None)
    env.reset(seed=0)
    *_, terminated, truncated, info = drive(env, [0.25, 0.0])
    assert terminated and not truncated and info["outcome"] == "success"
    assert 0.12 <= info["coverage"] < 0.13


@pytest.mark.parametrize("reference,twist,mode", [("plan", [0.2, 0.5], "veer_off"),
                                                  (None, [0.3, 0.0], "stuck")])
def test_failures_end_it_with_their_evidence(reference: Any, twist: List[float], mode: str) -> None:
    env = make(reference=reference, failure_penalty=7)
    _, info = env.reset(seed=0)
    begun = info["coverage"]
    _, total, terminated, truncated, info = drive(env, twist)
    assert terminated and not truncated and info["outcome"] == "failure"
    assert [e.mode for e in info["events"]] == [mode]
    assert info["failure"]["mode"] == mode and info["failure"]["t_s"] == info["events"][0].t_s
    assert total == pytest.approx(100 * (info["coverage"] - begun) - 7)


@pytest.mark.parametrize("repeat,steps", [(1, 5), (3, 2), (5, 1)])
def test_the_step_that_reaches_the_time_limit_is_the_last(repeat: int, steps: int) -> None:
    env = make(reference=None, max_time_s=0.1, action_repeat=repeat)
    _, info = env.reset(seed=0)
    times = [info["t_s"]]
    for _ in range(steps):
        *_, truncated, info = env.step([0.2, 0])
        times.append(info["t_s"])
    assert truncated and times[-1] == pytest.approx(0.1)
    assert (np.diff(times) > 0.019).all()


@pytest.mark.parametrize("estimator", ["truth", "odometry"])
@pytest.mark.parametrize("options,changes,action,outcome", [
    ({"reference": None}, {"success": {"min_coverage": 0.12}}, [0.25, 0.0], "success"),
    ({"reference": None}, {}, [0.3, 0.0], "failure"),
    ({"reference": "plan"}, {}, [0.2, 0.5], "failure"),
    ({"reference": "plan"}, {}, follow, "success"),
], ids=["covered", "stuck", "veer_off", "plan"])
def test_the_last_step_drives_and_its_observation_is_of_the_end(
        options: Any, changes: Any, action: Any, outcome: str, estimator: str) -> None:
    scenario = floorproof.load(room(estimator=estimator, **changes))
    env = make(scenario.with_plan([[1, 1], [1.8, 1], [1.8, 1.4]]), **options)
    observation, info = env.reset(seed=0)
    over = False
    while not over:
        before, t_s = observation, info["t_s"]
        observation, reward, terminated, truncated, info = env.step(
            action(observation) if callable(action) else action)
        over = terminated or truncated
    assert info["outcome"] == outcome, info["message"]
    # At its plan's end it comes to rest within the last step.
    rests = options.get("reference") == "plan" and outcome == "success"
    assert 0 < info["t_s"] - t_s < (2 if rests else 0.0201)
    # What the metrics count is observed, and earned, when it is over.
    assert observation["coverage"][0] == pytest.approx(info["metrics"]["coverage"], abs=1e-6)
    off_m = np.abs(observation["pose"][:2] - info["truth"][:2]).max()
    if estimator == "truth":
        assert off_m < 1e-5
    if "plan" in options.values() and outcome == "failure":
        assert (observation["pose"] != before["pose"]).any()


# --- the same bytes

TWISTS = [(0.2 + 0.05 * (i % 3), 0.0, 0.25 * ((i // 50) % 2) - 0.125) for i in range(400)]
EXACT = [tuple(float(np.float32(v)) for v in t) for t in TWISTS]


def test_twists_give_what_a_tracker_with_the_same_twists_gives() -> None:
    @floorproof.tracker("listed_twists")
    class Listed:
        def start(self, path: Any, robot: Any) -> None:
            self.given = 0

        def update(self, now: Any) -> Tuple[float, float, float]:
            self.given += 1  # at the end it is asked once more, and nothing comes of it
            return EXACT[min(self.given, 350) - 1]

    lasting = room(time_limit_s=7, sensors={"lidar": {"beams": 36, "noise_m": 0.01}})
    other = floorproof.load(lasting, {"controller": "listed_twists"}).run()
    env = make(lasting)
    env.reset(options={"episode": 0})
    for twist in EXACT:
        *_, terminated, truncated, info = env.step(np.array(twist, np.float32)[[0, 2]])
        if terminated or truncated:
            break
    dut = env.unwrapped.episode
    assert dut.outcome == other.outcome and len(dut.trace["t_s"]) > 50
    for name, column in other.trace.items():
        if name == "shape":
            assert column == dut.trace[name]
        else:
            np.testing.assert_array_equal(column, dut.trace[name], err_msg=name)
    assert dut.metrics == other.metrics
    assert [e.evidence for e in dut.events] == [e.evidence for e in other.events]


def bytes_of(env: Any, **reset: Any) -> bytes:
    observation, info = env.reset(**reset)
    told = [observation]
    for twist in EXACT[:25]:
        told.append(env.step([twist[0], twist[2]])[0])
    return b"".join(v.tobytes() for o in told for v in o.values())


def test_the_same_seed_gives_the_same_bytes() -> None:
    drawn = room(sensors={"lidar": {"beams": 36, "noise_m": 0.02}},
                 randomise={"site.floor.friction": {"uniform": [0.3, 0.9]}})
    env, other = make(drawn, reference=None), make(drawn, reference=None)
    first = bytes_of(env, seed=5)
    following = bytes_of(env)
    assert bytes_of(env, seed=5) == first and bytes_of(env) == following
    assert first != following and bytes_of(other, seed=6) != first
    assert bytes_of(other, seed=1, options={"episode": 5}) == first
    assert env.reset(seed=5)[1]["episode_id"] == 5


def test_observations_are_the_callers_own(env: Any) -> None:
    first, _ = env.reset(seed=0)
    kept = {name: value.copy() for name, value in first.items()}
    for _ in range(30):
        env.step([0.2, 0.3])
    env.close()
    for name, value in kept.items():
        np.testing.assert_array_equal(first[name], value)


def test_an_episode_is_freed_before_the_next_begins_and_by_close(
        env: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    make_core, made, others = floorproof._core.Stepped, [env.unwrapped._core], []

    def count_holders() -> None:  # of the last episode, beside this test
        others.append(sys.getrefcount(made[-1]) - alone)

    def stepped(*args: Any) -> Any:
        count_holders()
        made.append(make_core(*args))
        return made[-1]

    lone = [object()]
    alone = sys.getrefcount(lone[-1])
    monkeypatch.setattr(floorproof._core, "Stepped", stepped)
    env.reset(seed=0)
    env.reset(seed=1)
    env.step([0, 0])
    env.close()
    count_holders()
    assert others == [0, 0, 0]


# --- misuse

@pytest.mark.parametrize("action,said", [
    ([0.1], r"action: an array of shape \(1,\): must be \[2\]: vx_mps, wz_radps"),
    ([0.1, 0, 0], r"shape \(3,\): must be \[2\]"),
    ([[0.1, 0]], r"shape \(1, 2\)"),
    ([0.1, float("nan")], "action.wz_radps = nan: must be finite"),
    ([float("inf"), 0], "action.vx_mps = inf: must be finite"),
    ("fast", "action = 'fast': must be 2 numbers"),
    (None, r"action"),
])
def test_a_wrong_action_is_named_and_nothing_moves(env: Any, action: Any, said: str) -> None:
    env.reset(seed=0)
    with pytest.raises(InputError, match=said):
        env.step(action)
    assert env.step([0, 0])[4]["t_s"] == pytest.approx(0.02)


def test_after_its_end_and_after_close_it_says_so() -> None:
    env = make(max_time_s=0.05, reference=None, render_mode="rgb_array")
    with pytest.raises(InputError, match=r"step\(\): reset\(\) comes first"):
        env.step([0, 0])
    env.reset()
    drive(env, [0, 0])
    with pytest.raises(InputError, match="the episode has ended: reset"):
        env.step([0, 0])
    env.close()
    env.close()
    for use in (lambda: env.step([0, 0]), env.reset, env.render):
        with pytest.raises(InputError, match="the environment is closed"):
            use()


@pytest.mark.filterwarnings("ignore:.*render_mode='ansi'.*")
@pytest.mark.parametrize("changes,options,said", [
    ({"drive": "cells", "plan": {"planner": "rolling_window"}}, {"reference": None}, "drive = cells"),
    ({"plan": {"planner": "rolling_window"}}, {}, "gives no plan to follow"),
    ({}, {"reference": "line"}, "reference = line: unknown"),
    ({}, {"action_repeat": 0}, "action_repeat = 0: must be at least 1"),
    ({}, {"action_repeat": 1.5}, "action_repeat = 1.5: must be a whole number"),
    ({}, {"local_map_cells": 1000}, "local_map_cells = 1000: must be between 1 and 512"),
    ({}, {"local_map_cell_m": -1}, "local_map_cell_m"),
    ({}, {"failure_penalty": -1}, "failure_penalty"),
    ({}, {"max_time_s": 0}, "time_limit_s"),
    ({}, {"render_mode": "ansi"}, "render_mode = ansi"),
    ({}, {"width": 481}, "width = 481: must be even"),
    ({}, {"variant": "blue"}, "variant = blue: unknown"),
    ({"robot": "nobody"}, {}, "nobody"),
])
def test_what_cannot_be_is_refused_in_a_line(changes: Any, options: Any, said: str) -> None:
    with pytest.raises(InputError, match=said) as raised:
        make(room(**changes), **options)
    assert "\n" not in str(raised.value)


def test_options_of_reset_are_checked(env: Any) -> None:
    with pytest.raises(InputError, match="options.episodes: unknown"):
        env.reset(options={"episodes": 3})
    with pytest.raises(InputError, match=r"options = \[1\]: must be a dict"):
        env.reset(options=[1])
    with pytest.raises(InputError, match="options.episode = -1"):
        env.reset(options={"episode": -1})
    env.reset(seed=1)  # and it is whole after that
    env.step([0, 0])


# --- pictures

def test_it_draws_the_drive_as_it_stands() -> None:
    env = make(reference=None, render_mode="rgb_array", width=160, height=90)
    env.reset(seed=0)
    try:
        first = env.render()
    except floorproof.InternalError as error:
        pytest.skip(f"there is no GL: {error}")
    assert first.shape == (90, 160, 3) and first.dtype == np.uint8 and first.std() > 10
    np.testing.assert_array_equal(first, env.render())  # nothing moved
    for _ in range(40):
        env.step([0.25, 0.5])
    moved = env.render()
    assert (moved != first).mean() > 0.02
    env.reset(seed=0)
    np.testing.assert_array_equal(first, env.render())


def test_the_last_frame_of_an_episode_can_be_drawn() -> None:
    env = make(reference=None, render_mode="rgb_array", width=160, height=90, max_time_s=0.5)
    env.reset(seed=0)
    *_, info = drive(env, [0.2, 0])
    try:
        assert env.render().std() > 10
        assert env.unwrapped.episode.frame(width=160, height=90).std() > 10
    except floorproof.InternalError as error:
        pytest.skip(f"there is no GL: {error}")


def test_a_failure_that_ends_nothing_costs_and_the_time_limit_truncates() -> None:
    env = make(room(on_failure="ignore"), reference=None, max_time_s=25, failure_penalty=7)
    _, info = env.reset(seed=0)
    begun = info["coverage"]
    _, total, terminated, truncated, info = drive(env, [0.3, 0.0])
    assert truncated and not terminated and info["t_s"] == pytest.approx(25, abs=0.03)
    assert [e.mode for e in info["events"]] == ["stuck"] and info["outcome"] == "failure"
    assert total == pytest.approx(100 * (info["coverage"] - begun) - 7)
