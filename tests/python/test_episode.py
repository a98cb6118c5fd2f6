# SPDX-License-Identifier: Apache-2.0
"""Plans and drives."""
from __future__ import annotations

import filecmp
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import floorproof


def test_a_plan_has_its_path_and_figures(room):
    plan = floorproof.load(room).plan()
    assert (plan.status, plan.message) == ("success", "")
    assert plan.path.shape == (len(plan.shapes), 5)
    steps = np.hypot(*np.diff(plan.path[:, :2], axis=0).T)
    assert steps.sum() == pytest.approx(plan.info["length_m"], rel=1e-9)
    assert plan.info["coverage"] > 0.9
    assert plan.risk.shape == (plan.risk_frame.height, plan.risk_frame.width)
    assert plan.check()["least_clearance"]["obstacle"] == "wall"


def test_that_there_is_no_plan_is_no_exception(room):
    plan = floorproof.load({**room, "plan": "path_transform", "goal": {"x_m": 0.2, "y_m": 0.2}}).plan()
    assert plan.status != "success"
    assert plan.message
    with pytest.raises(floorproof.InputError, match="no plan to check"):
        plan.check()
    episode = floorproof.load({**room, "plan": "path_transform",
                               "goal": {"x_m": 0.2, "y_m": 0.2}}).run()
    assert episode.outcome == "not_planned"


def test_an_episode_has_trace_metrics_and_maps(room):
    episode = floorproof.load(room).run()
    assert episode.outcome == "success" and episode.events == []
    trace = episode.trace
    assert len({len(column) for column in trace.values()}) == 1
    assert (trace["x_m"][0], trace["y_m"][0]) == pytest.approx((1, 1), abs=1e-3)
    assert trace["t_s"][-1] == pytest.approx(episode.metrics["duration_s"], abs=0.05)
    passes, sweepable = episode.maps["passes"], episode.maps["sweepable"]
    assert sweepable.dtype == bool and passes.shape == sweepable.shape
    covered = (passes[sweepable] > 0).mean()
    assert covered == pytest.approx(episode.metrics["coverage"], abs=1e-9)
    row, column = episode.maps["frame"].cell(1.0, 1.0)
    assert passes[row, column] > 0


def test_a_failure_has_its_evidence(room):
    # A glass pane across the room that nobody told the planner of.
    room["site"]["hazards"] = [{"type": "glass", "id": "pane", "known": False, "height_m": 1,
                                "thickness_m": 0.01, "line_m": [[2.0, 0.5], [2.0, 2.0]]}]
    episode = floorproof.load(room).run()
    assert episode.outcome == "failure"
    event = episode.events[0]
    assert event.mode in ("bounce_back", "stuck", "veer_off")
    assert event.hazard == "pane"
    assert event.evidence["value"] is not None and "threshold" in event.evidence
    assert abs(event.x_m - 2.0) < 0.5


def test_the_same_bytes_as_the_command_line(drawing, command_line, tmp_path):
    lines = []
    drawing.run(out=tmp_path / "python", say=lines.append)
    said = subprocess.run([command_line, "run", drawing.file, "--out", tmp_path / "shell"],
                          capture_output=True, text=True, check=True)
    def files(folder):
        return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file())
    names = files(tmp_path / "shell")
    assert "trace.csv" in names and "heatmap_coverage.png" in names
    assert files(tmp_path / "python") == names
    # The page has the command that drives its folder again, and the list the page's hash.
    same = [name for name in names if name not in ("report.html", "files.sha256")]
    _, differ, broken = filecmp.cmpfiles(tmp_path / "python", tmp_path / "shell", same,
                                         shallow=False)
    assert (differ, broken) == ([], [])
    python, shell = ((tmp_path / by / "report.html").read_text().replace(str(tmp_path / by), "")
                     for by in ("python", "shell"))
    assert python == shell
    # What is said is the same, but for wall times and what the command line says beside it.
    shell = [line.split(" in ")[0] for line in said.stdout.splitlines()]
    assert len(lines) >= 3 and lines[0].split(" in ")[0] in shell


def test_a_folder_is_read_back(drawing, tmp_path):
    driven = drawing.run(out=tmp_path / "run")
    read = floorproof.read(tmp_path / "run")
    assert read.result == driven.result
    assert driven.frame(0.0, 320, 180).std() > 10, "it keeps its states"
    assert list(read.trace) == list(driven.trace)
    np.testing.assert_allclose(read.trace["x_m"], driven.trace["x_m"], atol=6e-6)
    with pytest.raises(floorproof.InputError, match="no states to draw"):
        read.frame()
    with pytest.raises(floorproof.InputError, match="result.json"):
        floorproof.read(tmp_path)


@pytest.mark.parametrize("name, damaged, says", [
    ("result.json", lambda text: "", "result.json:1: is not what `floorproof run` writes: Expecting"),
    ("result.json", lambda text: text[:-20], r"result.json:\d+: is not what .* writes: "),
    ("result.json", lambda text: "[" * 100000, "result.json: is not what .* recursion"),
    ("result.json", lambda text: "[]", "result.json: is not what .* writes: must be an object"),
    ("result.json", lambda text: "{}", "result.json: is not what .* writes: scenario: is missing"),
    ("result.json", lambda text: text.replace('"events": []', '"events": 3'),
     "events = 3: must be a list"),
    ("result.json", lambda text: text.replace('"events": []', '"events": [{"mode": "stuck"}]'),
     r"events\[0\]: is no event: 't_s'"),
    ("trace.csv", lambda text: "", "trace.csv:1: must name the columns"),
    ("trace.csv", lambda text: text.replace("x_m", "t_s", 1), "trace.csv:1: must name the columns"),
    ("trace.csv", lambda text: text + "1,2\n", r"trace.csv:\d+: holds 2 values: must be 22"),
    ("trace.csv", lambda text: text.replace("\n0.000,", "\nzero,", 1),
     "trace.csv:2: t_s = zero: must be a number"),
    ("trace.csv", lambda text: text.replace("\n0.000,", "\n,", 1), "t_s = : must be a number"),
    ("trace.csv", lambda text: text + "\udcff", "trace.csv: is no text in UTF-8"),
    ("trace.csv", lambda text: text + "9" * 200000, "trace.csv: cannot be read: field larger"),
])
def test_a_damaged_folder_says_where(recorded, tmp_path, name, damaged, says):
    for file in ("result.json", "trace.csv"):
        text = (recorded / file).read_text(encoding="utf-8")
        text = damaged(text) if file == name else text
        (tmp_path / file).write_bytes(text.encode(errors="surrogateescape"))
    with pytest.raises(floorproof.InputError, match=says) as wrong:
        floorproof.read(tmp_path)
    assert str(wrong.value).startswith(str(tmp_path)) and "\n" not in str(wrong.value)


def test_a_plan_of_ones_own(room):
    scenario = floorproof.load(room)
    path = np.array([[1.0, 1.0], [2.0, 1.0], [2.5, 1.4]])
    episode = scenario.run(path)
    assert episode.outcome == "success"
    assert episode.metrics["path_length_m"] == pytest.approx(1 + np.hypot(0.5, 0.4), abs=0.05)
    np.testing.assert_array_equal(episode.plan.path[:, :2], path)
    assert scenario.run(scenario.with_plan(path).plan()).result["metrics"] == episode.metrics


@pytest.mark.parametrize("path, says", [
    ([1, 2, 3], "must be .n, 2. to .n, 5."),
    ([[1, 2, 3, 4, 5, 6]], "must be .n, 2. to .n, 5."),
    (np.empty((0, 2)), "must be .n, 2."),
    ("spiral", "path = 'spiral': is no array of numbers: must be .n, 2. to .n, 5."),
    ([[1, 1], [1]], "is no array of numbers"),
    ([["a", "b"]], "is no array of numbers"),
    ([[1j, 1]], "is no array of numbers"),
    ([[1, float("nan")]], "plan-.*csv:2: y_m = nan: must be a finite number"),
    ([[1, 1], [1, float("inf")]], "plan-.*csv:3: y_m = inf: must be a finite number"),
    ([[1, 1, float("nan"), float("nan")]], "speed_mps = nan: must be a finite number"),
    ([[1, 1], [99, 1]], "lies off the map"),
    ([[1, 1, 0, -1]], "speed_mps"),
])
def test_arrays_that_are_no_path(room, path, says):
    with pytest.raises(floorproof.InputError, match=says):
        floorproof.load(room).run(path)


def test_frames_show_the_floor(room):
    scenario = floorproof.load(room)
    start = scenario.frame(320, 180)
    assert start.shape == (180, 320, 3) and start.dtype == np.uint8
    assert start.std() > 10, "it is no single colour"
    episode = scenario.run([[1.0, 1.0], [2.5, 1.0]])
    first, last = episode.frame(0.0, 320, 180, "top"), episode.frame(None, 320, 180, "top")
    assert (first != last).any()
    with pytest.raises(floorproof.InputError, match="camera"):
        scenario.frame(camera="tpo")


class Bar:
    """Shaped as tqdm."""

    def __init__(self, total, unit, desc):
        self.total, self.unit, self.desc = total, unit, desc
        self.n, self.closed = 0.0, False
        Bar.last = self

    def update(self, n):
        assert n > 0
        self.n += n

    def close(self):
        self.closed = True


def test_progress_is_shown_as_tqdm_does(room):
    episode = floorproof.load(room).run([[1.0, 1.0], [1.4, 1.0]], progress=Bar)
    assert (Bar.last.total, Bar.last.unit, Bar.last.closed) == (100, "%", True)
    assert episode.outcome == "success" and Bar.last.n == 100


def test_progress_ends_where_the_drive_does(room):
    episode = floorproof.load({**room, "time_limit_s": 6}).run(progress=Bar)
    assert episode.outcome == "timeout"
    assert 0 < Bar.last.n < 100 and Bar.last.closed


def test_an_observer_looks_on(room):
    seen = []
    scenario = floorproof.load({**room, "sensors": {"lidar": {}}})
    episode = scenario.run([[1.0, 1.0], [1.5, 1.0]], observe_hz=10,
                           observer=lambda view: seen.append((view.t_s, view.pose, view.scan)))
    times = [t for t, _, _ in seen]
    assert np.diff(times) == pytest.approx(0.1, abs=1e-6)
    once = []
    scenario.run([[1.0, 1.0], [1.1, 1.0]], observe_hz=5e-324, observer=once.append)
    assert len(once) == 1
    t, pose, scan = seen[5]
    at = np.searchsorted(episode.trace["t_s"], t - 1e-9)
    assert pose[0] == pytest.approx(episode.trace["x_m"][at], abs=1e-5)
    assert len(scan["angle_rad"]) == len(scan["range_m"]) > 10


def test_what_an_observer_raises_ends_the_drive(room):
    def bad(view):
        raise RuntimeError("enough")
    with pytest.raises(floorproof.InternalError, match="the observer raised RuntimeError: enough") as e:
        floorproof.load(room).run(observer=bad)
    assert isinstance(e.value.__cause__, RuntimeError)


def test_ctrl_c_ends_a_drive(tmp_path):
    script = tmp_path / "long.py"
    script.write_text(textwrap.dedent("""
        import os, signal, threading
        import floorproof
        rows = "\\n".join(["#" * 60] + ["#" + "." * 58 + "#"] * 58 + ["#" * 60])
        scenario = floorproof.load({"scenario": 1, "robot": "beluga", "start": {"x_m": 5, "y_m": 5},
                                    "site": {"site": 1, "grid": {"cell_m": 0.5, "rows": rows}}})
        threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
        try:
            scenario.run()
            print("not interrupted")
        except KeyboardInterrupt:
            print("interrupted")
        print(scenario.run([[5, 5], [5.5, 5]]).outcome)
    """), encoding="utf-8")
    run = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60,
                         check=False)
    assert run.stdout.split("\n")[:2] == ["interrupted", "success"], run.stderr
    assert run.returncode != -signal.SIGSEGV


def test_a_foreign_model_in_the_same_process_is_left_alone():
    """What MuJoCo's own bindings simulate is the same with and without this package."""
    code = textwrap.dedent("""
        import sys, hashlib
        import mujoco
        if sys.argv[1] == "with":
            import floorproof
            scenario = floorproof.load(floorproof.models_folder() / "scenarios" / "smoke_gate.yaml",
                                       robot="htetro", gate="none")
            scenario.run([list(scenario.start[:2])])
        model = mujoco.MjModel.from_xml_string('''<mujoco><size nuser_geom="2"/><worldbody>
          <geom type="plane" size="1 1 .1"/>
          <body pos="0 0 .05" euler="80 3 0"><freejoint/>
            <geom type="cylinder" size=".02 .01" user=".007 .785"/></body>
          <body pos=".3 0 .2"><freejoint/><geom type="box" size=".02 .03 .04"/></body>
          </worldbody></mujoco>''')
        data = mujoco.MjData(model)
        for _ in range(500):
            mujoco.mj_step(model, data)
        print(hashlib.sha256(data.qpos.tobytes()).hexdigest(), mujoco.__version__)
    """)
    pytest.importorskip("mujoco")
    states = [subprocess.run([sys.executable, "-c", code, which], capture_output=True, text=True,
                             check=True).stdout for which in ("with", "without")]
    assert states[0] == states[1]


def test_other_threads_run_while_physics_does(room):
    """The GIL is released: a thread of Python goes on while the robot drives."""
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    scenario = floorproof.load(room)
    plan = scenario.plan()
    thread.start()
    try:
        before = counted[0]
        scenario.run(plan)
        assert counted[0] - before > 100
    finally:
        stop.set()
        thread.join()
