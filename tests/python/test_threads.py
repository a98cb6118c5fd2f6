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

ROOM, HALL = of(8, 5), of(60, 60)  # seconds to drive, and minutes
room, hall = floorproof.load(ROOM), floorproof.load(HALL)

def out():
    return tempfile.mkdtemp() + "/out"

def forever(work):
    def loop():
        while True:
            work()
    thread = threading.Thread(target=loop, daemon=True)
    thread.start()
    return thread
"""


def ends(code, *arguments):
    """Exit status, stdout, stderr."""
    done = subprocess.run([sys.executable, "-c", PROGRAM + textwrap.dedent(code), *arguments],
                          capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


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
        env = floorproof._core.Stepped(hall._file.read(0, None), None, 20, 0.1, 1, 0.1, True)
        env.render(64, 64, "top", True)
        forever(lambda: env.step(0.1, 0, 0, 5))
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
