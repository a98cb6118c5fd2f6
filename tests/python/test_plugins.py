# SPDX-License-Identifier: Apache-2.0
"""Planners and trackers of one's own."""
from __future__ import annotations

import functools
import math
import time

import numpy as np
import pytest

import floorproof


@floorproof.planner("test_rows")
class Rows:
    """Back and forth, by the tool's width."""

    overlap: float = 0.2
    first_to_the_left: bool = True

    def plan(self, request):
        free = ~request.obstacles
        frame = request.obstacle_frame
        margin = request.robot["circumscribed_radius_m"]
        rows, columns = np.nonzero(free)
        low = np.array(frame.centre(rows.min(), columns.min())) + margin
        high = np.array(frame.centre(rows.max(), columns.max())) - margin
        path, left = [request.start[:2]], self.first_to_the_left
        apart = (1 - self.overlap) * request.robot["tool_width_m"]
        for y in np.linspace(low[1], high[1], 1 + math.ceil((high[1] - low[1]) / apart)):
            ends = (low[0], high[0]) if left else (high[0], low[0])
            path += [(ends[0], y), (ends[1], y)]
            left = not left
        return path


def test_a_planner_is_named_as_the_built_in_ones_are(room):
    scenario = floorproof.load({**room, "plan": {"planner": "test_rows", "overlap": 0.3}})
    plan = scenario.plan()
    assert plan.status == "success" and scenario.planner == "test_rows"
    assert plan.info["coverage"] > 0.9
    assert "overlap: 0.3" in scenario.resolved()
    assert "first_to_the_left: true" in scenario.resolved()
    more = floorproof.load({**room, "plan": {"planner": "test_rows", "overlap": 0.6}}).plan()
    assert len(more.path) > len(plan.path)
    assert scenario.run(plan).outcome == "success"


@pytest.mark.parametrize("plan, says", [
    ({"planner": "test_rows", "overlapp": 0.1}, "unknown key; did you mean overlap?"),
    ({"planner": "test_rows", "overlap": "much"}, "plan.overlap = much"),
    ({"planner": "test_rowss"}, "did you mean test_rows?"),
])
def test_its_keys_are_checked(room, plan, says):
    with pytest.raises(floorproof.InputError) as wrong:
        floorproof.load({**room, "plan": plan})
    assert says in str(wrong.value)


def planned(room, name, made, **promises):
    floorproof.planner(name, **promises)(made)
    return floorproof.load({**room, "plan": name}).plan()


def test_what_a_planner_says_of_no_plan(room):
    none = planned(room, "test_none", lambda request: None)
    assert (none.status, none.message) == ("failed", "the planner found no plan")
    why = planned(room, "test_why", lambda request: "the goal is walled in")
    assert (why.status, why.message) == ("failed", "the goal is walled in")


@pytest.mark.parametrize("answer, error, says", [
    ([[1, math.nan]], floorproof.InputError, r"planner test_bad, path\[0\]: y_m = nan: must be a number"),
    ([[1, 1], [math.inf, 1]], floorproof.InputError, r"path\[1\]: x_m = inf"),
    ([[1, 1], [500, 1]], floorproof.InputError, "lies off the map"),
    ([1, 1], floorproof.InternalError, "a path of shape"),
    ([[1]], floorproof.InputError, "n x 2 to n x 5"),
    ([], floorproof.InternalError, "a path of shape"),
    ([["a", "b"]], floorproof.InternalError, "ValueError"),
    (7, floorproof.InternalError, "a path of shape"),
])
def test_an_answer_that_is_no_path(room, answer, error, says):
    with pytest.raises(error, match=says):
        planned(room, "test_bad", lambda request: answer)


def test_a_planner_that_raises_is_named(room):
    def broken(request):
        return {}["goal"]
    with pytest.raises(floorproof.InternalError,
                       match=r"planner test_broken raised KeyError: 'goal' \(test_plugins.py:") as e:
        planned(room, "test_broken", broken)
    assert isinstance(e.value.__cause__, KeyError)


def test_a_planner_that_hangs_is_ended(room):
    def hangs(request):
        while True:
            try:
                time.sleep(0.01)
            except Exception:  # it cannot be kept from being ended
                pass
    begin = time.monotonic()
    with pytest.raises(floorproof.InternalError, match=r"took more than 0.2 s \(timeout_s\)"):
        planned(room, "test_hangs", hangs, timeout_s=0.2)
    assert time.monotonic() - begin < 5
    floorproof.planner("test_hangs")(hangs)
    with pytest.raises(floorproof.InternalError, match="took more than 0.1 s"):
        floorproof.load({**room, "plan": {"planner": "test_hangs", "timeout_s": 0.1}}).plan()


def test_what_is_recorded_is_what_is_used(room):
    @floorproof.planner("test_own_init")
    class OwnInit:
        way_m: float = 0.5

        def __init__(self):
            self.way_m = 1.5  # no key: the key's default is the class's

        def plan(self, request):
            return [request.start[:2], (request.start[0] + self.way_m, request.start[1])]

    for plan, way_m in (({}, 0.5), ({"way_m": 0.5}, 0.5), ({"way_m": 0.75}, 0.75)):
        scenario = floorproof.load({**room, "plan": {"planner": "test_own_init", **plan}})
        assert scenario.plan().path[-1, 0] == 1 + way_m
        assert f"way_m: {way_m}" in scenario.resolved()


@pytest.mark.parametrize("timeout_s", [0, -1, math.nan, math.inf, "long", True])
def test_a_limit_of_time_is_one(room, timeout_s):
    with pytest.raises(floorproof.InputError, match="timeout_s = .*: must be > 0 and finite"):
        floorproof.planner("test_limit", timeout_s=timeout_s)(lambda request: None)


def test_a_scenarios_limit_of_time_is_one(room):
    floorproof.planner("test_limit")(lambda request: None)
    # What Python raises within the core is told by the core.
    with pytest.raises((floorproof.InputError, floorproof.InternalError),
                       match="timeout_s = -1.0: must be > 0 and finite"):
        floorproof.load({**room, "plan": {"planner": "test_limit", "timeout_s": -1}})


def test_names_and_parameters(room):
    with pytest.raises(floorproof.InputError, match="is built in"):
        floorproof.planner("spiral")(lambda request: None)
    with pytest.raises(TypeError, match="needs a default"):
        floorproof.planner("test_x")(lambda request, gain: None)
    with pytest.raises(TypeError, match="must be a bool, int, float or str"):
        floorproof.planner("test_x")(lambda request, gain=None: None)
    with pytest.raises(TypeError, match="inf: its default must be finite"):
        floorproof.planner("test_x")(lambda request, gain=math.inf: None)
    for made in (lambda request, timeout_s=5.0: None, lambda request, planner="x": None,
                 lambda request, command="x": None, lambda request, file="x": None):
        with pytest.raises(TypeError, match="parameter .*: is another key's name already"):
            floorproof.planner("test_x")(made)
    with pytest.raises(TypeError, match="parameter radius_m: is another key's name already"):
        @floorproof.online_planner("test_x")
        class Near:
            radius_m: float = 0.3  # every planner of unknown floors has one; the task says it

            def next(self, known):
                return None
    with pytest.raises(TypeError, match="parameter name: is another key's name already"):
        floorproof.tracker("test_x")(lambda now, name="x": None)


class Callable:
    """Neither function nor class, but called as a function is."""

    def __call__(self, request, way_m: float = 0.5):
        x, y, _ = request.start
        return [(x, y), (x + way_m, y)]


@pytest.mark.parametrize("made", [
    Callable(), Callable().__call__, functools.partial(Callable()),
    functools.partial(lambda half, request, way_m=0.5: Callable()(request, half * way_m), 1),
    lambda request, *, way_m=0.5: Callable()(request, way_m),
    functools.partial(Callable(), way_m=0.5),
])
def test_what_is_called_as_a_function_is_one(room, made):
    floorproof.planner("test_callable")(made)
    for way_m in (0.5, 0.75):
        plan = floorproof.load({**room, "plan": {"planner": "test_callable", "way_m": way_m}}).plan()
        assert plan.path[-1, 0] == 1 + way_m


class NeedsOne:
    def __init__(self, one):
        self.one = one

    def plan(self, request):
        return None


@pytest.mark.parametrize("kind, made, says", [
    ("planner", 7, "7: must be a function or a class"),
    ("planner", NeedsOne(1), "must be a function or a class"),
    ("planner", NeedsOne, "NeedsOne: must be made without arguments"),
    ("planner", Callable, "Callable: has no plan"),
    ("tracker", NeedsOne, "NeedsOne: has no update"),
    ("online_planner", lambda known: None, "must be a class with next"),
    ("planner", max, "must be a function of one argument"),
    ("planner", lambda: None, "must be a function of one argument"),
    ("planner", lambda *, request: None, "must take its first argument by position"),
    ("planner", lambda request, *more: None, r"parameter \*more: must be one that is given by its n"),
    ("planner", lambda request, **more: None, r"parameter \*\*more: must be one"),
    ("planner", lambda request, n=3_000_000_000: None, "n = 3000000000: .* within 32 bits"),
])
def test_what_cannot_be_a_plug_in(kind, made, says):
    with pytest.raises(TypeError, match=says):
        getattr(floorproof, kind)("test_x")(made)


def test_a_planner_registered_again_is_the_new_one(room):
    first = planned(room, "test_again", lambda request: [[1, 1], [1.5, 1]])
    second = planned(room, "test_again", lambda request: [[1, 1], [2, 1]])
    assert (first.path[-1, 0], second.path[-1, 0]) == (1.5, 2)


# --- planners of unknown floors

@floorproof.online_planner("test_there_and_back")
class ThereAndBack:
    way_m: float = 0.6

    def start(self, task):
        self.targets = [(task.start[0] + self.way_m, task.start[1]), task.start[:2]]
        assert task.frame.cell_m > 0 and task.radius_m > 0

    def next(self, known):
        assert known.cells.shape == (known.frame.height, known.frame.width)
        assert set(np.unique(known.cells)) <= {0, 1, 2}
        return self.targets.pop(0) if self.targets else None


def test_an_online_planner_leads_the_robot(room):
    episode = floorproof.load({**room, "plan": "test_there_and_back"}).run()
    assert episode.outcome == "success", episode.message
    x_m = episode.trace["x_m"]
    assert x_m.max() == pytest.approx(1.6, abs=0.08)
    assert x_m[-1] == pytest.approx(1.0, abs=0.08)


@pytest.mark.parametrize("answer, error, says", [
    ((math.nan, 1.0), floorproof.InputError, "planner test_lost: target.x_m = nan: must be finite"),
    ((900.0, 1.0), floorproof.InputError, "lies off the map"),
    (5, floorproof.InternalError, "planner test_lost raised TypeError"),
])
def test_an_online_planner_that_is_wrong(room, answer, error, says):
    class Lost:
        def next(self, known):
            return answer
    floorproof.online_planner("test_lost")(Lost)
    with pytest.raises(error, match=says):
        floorproof.load({**room, "plan": "test_lost"}).run()


# --- trackers

@floorproof.tracker("test_pursuit")
def pursuit(now, gain: float = 2.0):
    dx, dy = now.target[0] - now.pose[0], now.target[1] - now.pose[1]
    off = math.remainder(math.atan2(dy, dx) - now.pose[2], math.tau)
    forward = now.speed_mps * max(0.0, math.cos(off)) if abs(off) < 0.7 else 0.0
    return forward, 0.0, gain * off


def test_a_tracker_follows_the_plan(room):
    scenario = floorproof.load({**room, "controller": {"name": "test_pursuit", "gain": 2.5}})
    assert scenario.tracker == "test_pursuit"
    episode = scenario.run([[1.0, 1.0], [2.5, 1.0], [2.5, 1.5], [1.0, 1.5]])
    assert episode.outcome == "success", (episode.message, episode.events)
    assert episode.metrics["max_cross_track_m"] < 0.1


def test_a_trackers_twist_is_within_the_robots_limits(room):
    @floorproof.tracker("test_wild")
    def wild(now):
        return 50.0, 0.0, 900.0
    episode = floorproof.load({**room, "controller": "test_wild"}).run([[1.0, 1.0], [2.5, 1.0]])
    robot = floorproof.load(room).robot
    assert episode.trace["cmd_vx_mps"].max() == pytest.approx(robot["max_speed_mps"])
    assert episode.trace["cmd_wz_radps"].max() == pytest.approx(robot["max_yaw_rate_radps"])
    hz = 50
    assert np.diff(episode.trace["cmd_vx_mps"]).max() <= robot["max_accel_mps2"] / hz + 1e-6


@pytest.mark.parametrize("answer, says", [
    ((math.nan, 0.0, 0.0), "controller test_odd returned vx_mps = nan at 0 s: must be finite"),
    ((0.1, 0.0), "controller test_odd raised ValueError"),
    (None, "controller test_odd raised TypeError"),
])
def test_a_tracker_that_is_wrong(room, answer, says):
    floorproof.tracker("test_odd")(lambda now: answer)
    with pytest.raises(floorproof.InternalError, match=says):
        floorproof.load({**room, "controller": "test_odd"}).run()


# --- what is lent for one call

def test_what_was_lent_is_taken_back(room):
    kept = []

    class Keeps:
        def next(self, known):
            kept.append(known)
            return None
    floorproof.online_planner("test_keeps")(Keeps)
    floorproof.load({**room, "plan": "test_keeps"}).run()
    with pytest.raises(floorproof.InputError, match="is of its own call alone"):
        kept[0].cells
    views = []
    floorproof.load(room).run([[1.0, 1.0], [1.1, 1.0]], observer=views.append)
    with pytest.raises(floorproof.InputError, match="is of its own call alone"):
        views[0].pose


def test_a_planner_may_plan_itself(room):
    @floorproof.planner("test_of_planners")
    def of_planners(request):
        return floorproof.load({**room, "plan": "spiral"}).plan().path
    plan = floorproof.load({**room, "plan": "test_of_planners"}).plan()
    assert plan.info["coverage"] > 0.9
