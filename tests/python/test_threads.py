# SPDX-License-Identifier: Apache-2.0
"""Several threads at a time, and threads that still work when the program ends. Each in a program of
its own, which must end by itself."""
from __future__ import annotations

import subprocess
import sys
import textwrap

import pytest

PROGRAM = """
import sys, tempfile, threading, time
import floorproof

def of(columns, rows, **more):
    grid = "\\n".join(["#" * columns] + ["#" + "." * (columns - 2) + "#"] * (rows - 2)
                     + ["#" * columns])
    return {"scenario": 1, "robot": "beluga", "start": {"x_m": 1, "y_m": 1},
            "site": {"site": 1, "grid": {"cell_m": 0.5, "rows": grid}}, **more}

ROOM, HALL = of(8, 5), of(30, 30)  # a second to drive, and many
room, hall = floorproof.load(ROOM), floorproof.load(HALL)
seeing = hall.with_({"sensors.lidar": {"beams": 9}, "time_limit_s": 100000})  # it circles

def out():
    return tempfile.mkdtemp() + "/out"

def forever(work):
    def loop():
        while True:
            work()
    thread = threading.Thread(target=loop, daemon=True)
    thread.start()
    return thread

def drive_into_a_folder():
    begun = threading.Event()
    forever(lambda: hall.run(out=out(), say=lambda line: begun.set()))
    assert begun.wait(30)
"""


def ends(code, *arguments):
    """Exit status, stdout, stderr."""
    done = subprocess.run([sys.executable, "-c", PROGRAM + textwrap.dedent(code), *arguments],
                          capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


def test_environments_go_while_another_thread_drives_into_a_folder():
    pytest.importorskip("gymnasium", reason="gymnasium is not installed")
    assert ends("""
    import gymnasium, floorproof.gym
    drive_into_a_folder()
    for seed in range(3):
        env = gymnasium.make("Floorproof-v0", scenario={**ROOM, "sensors": {"lidar": {"beams": 9}}},
                             reference=None)
        env.reset(seed=seed)
        del env
    print("gone")
    """) == (0, "gone\n", "")


def test_a_picture_does_not_wait_for_another_threads_drive():
    assert ends("""
    drive_into_a_folder()
    print(room.frame(64, 64).shape, hall.warnings())
    """) == (0, "(64, 64, 3) []\n", "")


def test_callbacks_may_ask_the_scenario():
    assert ends("""
    asked = []
    room.run([[1, 1], [1.2, 1]], out=out(), say=lambda line: asked.append(room.resolved()))
    @floorproof.planner("asks")
    class Asks:
        def __init__(self):
            asked.append(len(askers[-1].warnings() if askers else []))
        def plan(self, request):
            return [[1, 1], [1.2, 1]]
    askers = []
    askers.append(floorproof.load({**ROOM, "plan": "asks"}))
    print(askers[0].run().outcome, asked[-1])
    """) == (0, "success 0\n", "")


def test_an_episode_that_another_thread_drives_is_not_looked_at():
    assert ends("""
    env = floorproof._core.Stepped(seeing._file.read(0, None), None, 20, 0.1, 1, 0.1, False, None)
    forever(lambda: env.step(0.1, 0, 1, 100))
    for look in (lambda: env.num_events, lambda: env.events):
        while True:
            try:
                look()
            except floorproof.InputError as refused:
                print(refused)
                break
    """) == (0, 2 * "another thread is using this episode: each thread needs its own\n", "")


WORK = {
    "drives": """
        forever(room.run)
        forever(lambda: hall.run(observer=lambda view: None, progress=progress))
        forever(lambda: hall.run(out=out()))
        """,
    "plans": """
        forever(hall.plan)
        forever(floorproof.load({**HALL, "plan": "spiral"}).plan)
        """,
    "plug-ins": """
        @floorproof.planner("sleeps")
        def sleeps(request):
            time.sleep(1000)
        @floorproof.planner("thinks")
        def thinks(request):
            while True:
                try:
                    while True:
                        pass
                except BaseException:
                    pass
        @floorproof.tracker("stands")
        def stands(now):
            return 0, 0, 0
        for name in ("sleeps", "thinks"):
            forever(floorproof.load({**ROOM, "plan": name}).run)
        forever(floorproof.load({**ROOM, "controller": "stands"}).run)
        """,
    "programs": """
        import warnings
        warnings.simplefilter("ignore")
        forever(floorproof.load({**ROOM, "plan": {"command": ["sleep", "1000"]}}).plan)
        """,
    "campaigns": """
        wet = room.with_({"randomise": {"site.floor.friction": {"uniform": [0.3, 0.6]}}})
        forever(lambda: floorproof.campaign(wet, 50, out=out(), jobs=2, progress=progress))
        """,
    "environments": """
        env = floorproof._core.Stepped(seeing._file.read(0, None), None, 20, 0.1, 1, 0.1, True, None)
        env.render(64, 64, "top", True)
        forever(lambda: env.step(0.1, 0, 1, 5))
        forever(lambda: hall.frame(64, 64))
        """,
}


@pytest.mark.parametrize("work", WORK)
def test_a_program_ends_while_its_threads_work(work):
    assert ends("""
    class progress:
        def __init__(self, **about):
            pass
        def update(self, n):
            pass
        def close(self):
            pass
    exec(sys.argv[1])
    time.sleep(0.4)
    print("the end")
    sys.exit(3)
    """, textwrap.dedent(WORK[work])) == (3, "the end\n", "")


def test_a_program_may_wait_for_its_threads_when_it_ends():
    done = subprocess.run([sys.executable, "-c", "import atexit\nthreads = []\n"
                           "atexit.register(lambda: [thread.join() for thread in threads])\n"
                           + PROGRAM + "threads.append(forever(hall.run))\ntime.sleep(0.2)\n"],
                          capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")
