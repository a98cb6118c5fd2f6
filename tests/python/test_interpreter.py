# SPDX-License-Identifier: Apache-2.0
"""Whatever a program does with the package, its interpreter lives on and hears what was wrong."""
from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
import threading

import pytest

import floorproof
from floorproof import _core


def test_a_plug_in_may_be_replaced_while_it_is_made(room):
    class Renews:
        def __init__(self):
            floorproof.planner("test_renews")(Renews)

        def plan(self, request):
            return [[1, 1], [1.2, 1]]
    floorproof.planner("test_renews")(Renews)
    for _ in range(20):
        assert floorproof.load({**room, "plan": "test_renews"}).plan().status == "success"


def test_a_plug_in_may_be_replaced_from_another_thread(room):
    done = threading.Event()

    def renew():
        while not done.is_set():
            floorproof.planner("test_raced")(lambda request: [[1, 1], [1.2, 1]])
    floorproof.planner("test_raced")(lambda request: [[1, 1], [1.2, 1]])
    thread = threading.Thread(target=renew)
    thread.start()
    try:
        for _ in range(50):
            assert floorproof.load({**room, "plan": "test_raced"}).plan().status == "success"
    finally:
        done.set()
        thread.join()


@pytest.mark.parametrize("change, says", [
    ({"plan": "rolling_window", "drive": "cells"}, "its drive is physics, not cells"),
    ({"plan": "rolling_window"}, "its plan was made beforehand"),
    ({"robot": "htetro"}, "its robot is beluga, not htetro"),
    ({"site": {"site": 1, "grid": {"cell_m": 0.5, "rows": "#####\n#...#\n#...#\n#####\n"}}},
     "its map lies elsewhere"),
])
def test_a_plan_of_another_scenario_is_refused(room, change, says):
    plan = floorproof.load(room).plan()
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.load({**room, **change}).run(plan)


@pytest.mark.parametrize("name", [name for name, _ in _core.planners()])
def test_every_planner_plans_from_python(room, name):
    # Big enough for audits and cells of the robot's width.
    room["site"]["grid"]["rows"] = "\n".join(["#" * 14] + ["#" + "." * 12 + "#"] * 8 + ["#" * 14])
    plan = floorproof.load({**room, "plan": name, "goal": {"x_m": 5, "y_m": 3}}).plan()
    if name == "survival_coverage":  # plans by measured rates, of which this scenario has none
        assert (plan.status, "risk.model" in plan.message) == ("failed", True), plan.message
        return
    assert plan.status == "success", plan.message


def test_an_error_has_its_own_cause(room):
    def broken(request):
        return 1 / 0
    floorproof.planner("test_caused")(broken)
    scenario = floorproof.load({**room, "plan": "test_caused"})
    row = _core.Worker(_core.ScenarioFile.unpack(scenario._packed())).answer(0)
    assert b"ZeroDivisionError" in row
    with pytest.raises(floorproof.InputError) as wrong:
        floorproof.load({"robott": 1})
    assert wrong.value.__cause__ is None
    with pytest.raises(floorproof.InternalError) as raised:
        scenario.plan()
    assert isinstance(raised.value.__cause__, ZeroDivisionError)


class Unspeakable(Exception):
    def __str__(self):
        raise RuntimeError("no words")


@pytest.mark.parametrize("error, says", [
    (ValueError("x\udcff"), r"raised ValueError: x\\udcff"),
    (Unspeakable(), r"raised Unspeakable \(test_interpreter.py:"),
    (ValueError("two\nlines"), "raised ValueError: two"),
])
def test_an_error_that_can_hardly_be_told_is_told(room, error, says):
    def broken(request):
        raise error
    floorproof.planner("test_told")(broken)
    with pytest.raises(floorproof.InternalError, match=says) as wrong:
        floorproof.load({**room, "plan": "test_told"}).plan()
    assert wrong.value.__cause__ is error
    assert "\n" not in str(wrong.value)


def run(code):
    return subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True,
                          text=True, timeout=60, check=False)


LONG = """
    import os, signal, sys
    import floorproof
    rows = "\\n".join(["#" * 60] + ["#" + "." * 58 + "#"] * 58 + ["#" * 60])
    scenario = floorproof.load({"scenario": 1, "robot": "beluga", "start": {"x_m": 5, "y_m": 5},
                                "site": {"site": 1, "grid": {"cell_m": 0.5, "rows": rows}}})
"""


def test_what_a_signals_handler_raises_is_raised():
    done = run(LONG + """
    class Alarm(Exception):
        pass
    def ring(*_):
        raise Alarm("now")
    signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    try:
        scenario.run()
    except Alarm as alarm:
        print("alarm", alarm)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))
    signal.setitimer(signal.ITIMER_REAL, 0)
    import threading
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGTERM)).start()
    scenario.run()
    """)
    assert done.stdout == "alarm now\n", done.stderr
    assert done.returncode == 7


def test_a_tracker_may_end_the_program():
    done = run(LONG + """
    @floorproof.tracker("ends")
    def ends(now):
        sys.exit(5)
    scenario.with_(controller="ends").run([[5, 5], [6, 5]])
    """)
    assert done.returncode == 5, done.stderr


def test_an_interpreter_ends_with_plug_ins_and_episodes_alive():
    done = run(LONG + """
    @floorproof.planner("stays")
    def stays(request):
        return [[5, 5], [5.5, 5]]
    kept = scenario.with_(plan="stays")
    episode, maps = kept.run(), kept.run().maps
    print(episode.outcome)
    """)
    assert (done.stdout, done.returncode) == ("success\n", 0), done.stderr


@pytest.mark.parametrize("options, says", [
    ({"n": 10**8 + 1}, "-n: 100000001: must be in"),
    ({"jobs": 10**6}, "--jobs: 1000000: must be in"),
    ({"jobs": -1}, "--jobs: -1: must be in"),
    ({"time_limit_s": -5.0}, "--time-limit: -5: must be > 0"),
    ({"time_limit_s": float("nan")}, "--time-limit: nan: must be > 0"),
])
def test_what_a_campaign_cannot_be_asked(drawing, tmp_path, options, says):
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.campaign(drawing, **{"n": 2, **options}, out=tmp_path / "c")


@pytest.mark.parametrize("shards, says", [([], "shards: there are none to merge"),
                                          ("folder", "shards = 'folder': must be a list")])
def test_what_cannot_be_merged(tmp_path, shards, says):
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.merge(shards, tmp_path / "merged")


def test_a_plan_without_an_end_is_refused(room):
    for path, says in (([[1, 1, 0, 1e-9]], "speed_mps = 1e-09: must be at least"),
                       ([[1, 1, 0, 0, 1e300]], "dwell_s")):
        floorproof.planner("test_endless")(lambda request, rows=1: path)
        with pytest.raises(floorproof.InputError, match=says):
            floorproof.load({**room, "plan": "test_endless"}).plan()
        with pytest.raises(floorproof.InputError, match=says):
            floorproof.load(room).run(path)


def test_signals_are_python_s():
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
