# SPDX-License-Identifier: Apache-2.0
"""Campaigns on a Ray cluster of several raylets: the bytes of one machine, whoever dies meanwhile."""
from __future__ import annotations

import functools
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable, Dict, List

import pytest

import floorproof

pytest.importorskip("ray", reason="the package ray is not installed")

N = 60

SITE = """
site: 1
name: room
grid:
  cell_m: 0.5
  rows: |
    ########
    #......#
    #......#
    #......#
    ########
start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}
"""

# A metre straight ahead, in two variants; of about half the episodes the time is too short for it.
SCENARIO = """
scenario: 1
site: room.yaml
robot: beluga
plan: {file: ahead.csv}
physics: {timestep_s: 0.005}
randomise:
  start.y_m: {uniform: [0.9, 1.1]}
  time_limit_s: {choice: [1.5, 20]}
success: {min_coverage: 0}
matrix:
  floors: [{label: dry, site.floor.friction: 0.8}, {label: wet, site.floor.friction: 0.5}]
"""
GATE = "gate: {metric: not_success, max_rate: 0.2, confidence: 0.9, mode: sequential}\n"


def written(folder: Path, text: str = SCENARIO) -> Path:
    folder.mkdir(parents=True)
    (folder / "room.yaml").write_text(SITE)
    (folder / "ahead.csv").write_text("x_m,y_m\n1.0,1.0\n2.0,1.0\n")
    (folder / "scenario.yaml").write_text(text)
    return folder / "scenario.yaml"


def assert_same(a: Path, b: Path) -> None:
    for name in ("summary.json", "episodes.csv"):
        assert (a / name).read_bytes() == (b / name).read_bytes(), name


def rows_of(folder: Path) -> List[Any]:
    base = sqlite3.connect(f"file:{folder / 'campaign.sqlite'}?mode=ro", uri=True)
    with base:
        rows = base.execute("select variant, episode from episode union all "
                            "select variant, episode from extra").fetchall()
    base.close()
    return sorted(rows)


def every(n: int) -> List[Any]:
    return [(f"floors={floor}", i) for floor in ("dry", "wet") for i in range(n)]


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cluster")


@pytest.fixture(scope="module")
def local(place: Path) -> Dict[str, Path]:
    """What one machine gives, made before Ray has threads here: with a gate and without."""
    made = {}
    for name, text in (("gated", SCENARIO + GATE), ("all", SCENARIO)):
        file = written(place / f"local_{name}", text)
        floorproof.campaign(file, N, out=place / name)
        made[name] = place / name
    return made


@pytest.fixture(scope="module")
def cluster(local: Dict[str, Path]) -> Any:
    """Two nodes of one CPU on this machine, and this process as the driver."""
    # As nice as all else: on a machine that does other work, workers of Ray's own 15 would wait for it.
    told = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_AUTH_MODE": "disabled", "RAY_worker_niceness": "0"}
    before = {name: os.environ.get(name) for name in told}
    os.environ.update(told)
    import ray
    from ray.cluster_utils import Cluster
    about = dict(num_cpus=1, object_store_memory=80 << 20)
    made = Cluster(initialize_head=True, head_node_args=dict(about, include_dashboard=False))
    made.about = about
    made.add_node(**about)
    ray.init(address=made.address, logging_level="warning", log_to_driver=False)
    yield made
    ray.shutdown()
    made.shutdown()
    for name, value in before.items():
        os.environ.pop(name) if value is None else os.environ.update({name: value})


def drivers_on(nodes: Any) -> List[int]:
    """The processes of these nodes that drive episodes now."""
    raylets = {node.all_processes["raylet"][0].process.pid for node in nodes}
    found = []
    for process in Path("/proc").iterdir():
        if not process.name.isdecimal():
            continue
        try:
            name = (process / "cmdline").read_text()
            parent = int((process / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
        if parent in raylets and name.startswith("ray::floorproof_drive"):
            found.append(int(process.name))
    return found


class Killer(threading.Thread):
    """Ends what `victims` finds while a campaign runs, up to so often, every 0.2 s."""

    def __init__(self, victims: Callable[[], List[int]], times: int) -> None:
        super().__init__(daemon=True)
        self._victims, self._times = victims, times
        self.killed = 0
        self.over = threading.Event()

    def run(self) -> None:
        while self.killed < self._times and not self.over.is_set():
            for pid in self._victims()[:1]:
                os.kill(pid, signal.SIGKILL)
                self.killed += 1
                self.over.wait(0.2)
            time.sleep(0.01)

    def __enter__(self) -> "Killer":
        self.start()
        return self

    def __exit__(self, *_: Any) -> None:
        self.over.set()
        self.join()


def test_bytes_of_one_machine_with_files_that_are_only_here(cluster: Any, local: Dict[str, Path],
                                                            place: Path) -> None:
    scenario = floorproof.load(written(place / "only_here", SCENARIO + GATE))
    shutil.move(place / "only_here", place / "gone")
    made = floorproof.campaign(scenario, N, out=place / "ray", engine="ray", batch_s=0.2)
    assert made.gate and made.gate["verdict"] == "failed" and "verdict" in made.end
    assert all(0 < v["n"] < N for v in made.variants.values())  # it ended early
    assert_same(place / "ray", local["gated"])


def test_a_killed_worker_costs_nothing(cluster: Any, local: Dict[str, Path], place: Path) -> None:
    with Killer(lambda: drivers_on(cluster.list_all_nodes()), 3) as killer:
        floorproof.campaign(place / "local_all" / "scenario.yaml", N, out=place / "killed",
                            engine="ray", batch_s=0.2)
    assert killer.killed > 0
    assert rows_of(place / "killed") == every(N)
    assert_same(place / "killed", local["all"])


def the_error_of(planner: str, place: Path, **options: Any) -> str:
    """Of 12 episodes, of which the one that begins farthest up (above bad_y_m) is bad: that one's."""
    file = written(place / planner,
                   SCENARIO.replace("{file: ahead.csv}", f"{{planner: {planner}}}"))
    drawn = [floorproof.load(file).episode(i).start[1] for i in range(12)]
    bad = max(range(12), key=lambda i: drawn[i])
    bound = (sorted(drawn)[-1] + sorted(drawn)[-2]) / 2
    scenario = floorproof.load(file, {"plan.bad_y_m": bound, "matrix": None})
    folder = place / f"of_{planner}"
    made = floorproof.campaign(scenario, 12, out=folder, engine="ray", batch_s=5, **options)
    summary = made.variants["default"]
    assert summary["n_error"] == 1 and summary["n"] == 11
    base = sqlite3.connect(folder / "campaign.sqlite")
    (episode, message), = base.execute(
        "select episode, message from episode where outcome = 'error'").fetchall()
    base.close()
    assert episode == bad
    return str(message)


def test_an_episode_that_kills_its_process_is_one_error(cluster: Any, place: Path) -> None:
    # Pickled by value: no worker can import this file.
    @floorproof.planner("deadly", uses_seed=True)
    def deadly(request: Any, bad_y_m: float = 9.0) -> Any:
        x_m, y_m, _ = request.start
        if y_m > bad_y_m:
            os.kill(os.getpid(), signal.SIGKILL)
        return [(x_m, y_m), (x_m + 1, y_m)]

    assert the_error_of("deadly", place) == "crashed: its process died, 4 times"


def test_an_episode_that_hangs_is_one_error(cluster: Any, place: Path) -> None:
    @floorproof.planner("deaf", uses_seed=True, timeout_s=0.2)
    def deaf(request: Any, bad_y_m: float = 9.0) -> Any:
        x_m, y_m, _ = request.start
        while y_m > bad_y_m:
            try:
                time.sleep(1)
            except BaseException:
                pass
        return [(x_m, y_m), (x_m + 1, y_m)]

    assert the_error_of("deaf", place, retries=0, time_limit_s=60) == (
        "planner deaf raised TimeoutError: took more than 0.2 s (timeout_s)")


def test_shards_by_command_and_merged(cluster: Any, local: Dict[str, Path], place: Path,
                                      capsys: pytest.CaptureFixture[str]) -> None:
    from floorproof._cluster_command import main
    file = str(written(place / "shards", SCENARIO + GATE))
    for name, ids in (("a", "0:20"), ("b", f"20:{N}")):
        assert main([file, "-n", str(N), "--episodes", ids, "--out", str(place / name)]) == 0
    assert "a shard" in capsys.readouterr().out
    floorproof.merge([place / "a", place / "b"], place / "merged")
    assert_same(place / "merged", local["gated"])
    assert main([file, "-n", str(N), "--out", str(place / "a")]) == 2
    assert "--resume" in capsys.readouterr().err
    assert main([file, "-n", str(N), "--out", str(place / "a"), "--resume"]) == 1  # the gate says no
    assert main([file, "-n", "1", "--out", str(place / "no"), "--set", "robot=belluga"]) == 2
    assert "belluga" in capsys.readouterr().err


def test_a_node_with_another_version_is_named(cluster: Any, place: Path) -> None:
    other = place / "other" / "floorproof"
    other.mkdir(parents=True)
    (other / "__init__.py").write_text("__version__ = '0.0.7'\n")
    node = cluster.add_node(**cluster.about, env_vars={"PYTHONPATH": str(other.parent)})
    try:
        with pytest.raises(floorproof.InputError) as raised:
            floorproof.campaign(place / "local_all" / "scenario.yaml", 100_000, out=place / "mixed",
                                engine="ray", batch_s=0.05, time_limit_s=60)
    finally:
        cluster.remove_node(node)
    said = str(raised.value)
    assert "Ray node" in said and node.node_id[:12] in said
    assert f"floorproof 0.0.7 where the driver has {floorproof.__version__}" in said
    assert rows_of(place / "mixed")  # what was driven is kept


def test_a_planner_that_raised_leaves_no_plan_behind(place: Path) -> None:
    # A worker keeps the plan as long as its inputs stay the same; else what an episode gives would
    # hang on those that its worker drove before.
    @floorproof.planner("moody")
    def moody(request: Any) -> Any:
        x_m, y_m, _ = request.start
        if y_m > 1:
            raise RuntimeError("not from here")
        return [(x_m, y_m), (x_m + 1, y_m)]

    text = SCENARIO.replace("{file: ahead.csv}", "{planner: moody}")
    file = written(place / "moody", text.replace("uniform", "choice"))
    scenario = floorproof.load(file, {"matrix": None, "drive": "none", "success": None})
    worker = floorproof._core.Worker(scenario._file)
    bad = [scenario.episode(i).start[1] > 1 for i in range(12)]
    for episode in (bad.index(False), bad.index(True), bad.index(True)):
        assert ("not from here" in str(worker.answer(episode))) == bad[episode]


def ahead(way_m: float, request: Any) -> Any:
    return [request.start[:2], (request.start[0] + way_m, request.start[1])]


def test_a_partial_travels_with_the_module_of_its_function(tmp_path: Path) -> None:
    from floorproof import cluster
    floorproof.planner("ahead_by")(functools.partial(ahead, 0.25))
    scenario = floorproof.load(written(tmp_path / "there"), plan="ahead_by")
    (tmp_path / "plugins").write_bytes(cluster._pickled_plugins(scenario._packed()))
    # Elsewhere this module is not there to be imported.
    code = ("import pickle, sys, types; (made, _), = pickle.load(open(sys.argv[1], 'rb')).values(); "
            "print(made(types.SimpleNamespace(start=(1, 2, 0))))")
    run = subprocess.run([sys.executable, "-c", code, tmp_path / "plugins"], cwd=tmp_path,
                         capture_output=True, text=True, check=False)
    assert run.stdout == "[(1, 2), (1.25, 2)]\n", run.stderr


@pytest.mark.parametrize("option, text", [
    ({"batch_s": 0}, "batch_s = 0: must be > 0"), ({"retries": -1}, "retries = -1: must be >= 0"),
    ({"num_cpus": 0}, "num_cpus = 0: must be > 0")])
def test_options_are_checked(place: Path, local: Dict[str, Path], option: Dict[str, Any],
                             text: str) -> None:
    with pytest.raises(floorproof.InputError, match=text):
        floorproof.campaign(place / "local_all" / "scenario.yaml", 1, out=place / "none", engine="ray",
                            **option)
    assert not (place / "none").exists()


def test_more_cpus_than_this_machine_has(local: Dict[str, Path], place: Path,
                                         monkeypatch: pytest.MonkeyPatch) -> None:
    import ray
    monkeypatch.delenv("RAY_ADDRESS", raising=False)
    monkeypatch.setattr(ray, "is_initialized", lambda: False)
    monkeypatch.setattr(ray, "init", lambda **_: pytest.fail("no cluster can drive this"))
    with pytest.raises(floorproof.InputError, match=r"num_cpus = 100000: no node has as many; this ma"):
        floorproof.campaign(place / "local_all" / "scenario.yaml", 1, out=place / "large", engine="ray",
                            num_cpus=100_000)
    assert not (place / "large").exists()


def test_more_cpus_than_any_node_has(cluster: Any, local: Dict[str, Path], place: Path,
                                     monkeypatch: pytest.MonkeyPatch) -> None:
    from floorproof import cluster as engine
    monkeypatch.setattr(engine, "_SIZE_S", 0.05)
    monkeypatch.setattr(engine, "_PATIENCE_S", 0.2)
    with pytest.warns(UserWarning, match="num_cpus = 2: no node has as many; the largest has 1") as w:
        made = floorproof.campaign(place / "local_all" / "scenario.yaml", 1, out=place / "waits",
                                   engine="ray", num_cpus=2, time_limit_s=1)
    assert len(w) == 1 and "time limit" in made.end


def test_a_killed_raylet_costs_nothing(cluster: Any, local: Dict[str, Path], place: Path) -> None:
    node, = cluster.worker_nodes
    raylet = node.all_processes["raylet"][0].process
    with Killer(lambda: [raylet.pid] if drivers_on([node]) else [], 1) as killer:
        floorproof.campaign(place / "local_all" / "scenario.yaml", N, out=place / "node_died",
                            engine="ray", batch_s=0.1)
    assert killer.killed == 1 and raylet.wait(10) == -signal.SIGKILL
    cluster.remove_node(node, allow_graceful=False)
    cluster.add_node(**cluster.about)
    assert rows_of(place / "node_died") == every(N)
    assert_same(place / "node_died", local["all"])


def start_driver(cluster: Any, file: Path, out: Path, *more: str) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-m", "floorproof.cluster", str(file), "-n", str(N), "--out", str(out),
         "--address", cluster.address, "--batch", "0.1", *more], stderr=subprocess.PIPE, text=True,
        env=dict(os.environ, PYTHONPATH=str(Path(floorproof.__file__).parent.parent)))


@pytest.mark.parametrize("how, status", [
    (signal.SIGKILL, -signal.SIGKILL), pytest.param(signal.SIGINT, 130, marks=pytest.mark.slow)])
def test_a_driver_that_ended_is_started_again(cluster: Any, local: Dict[str, Path], place: Path,
                                              how: signal.Signals, status: int) -> None:
    file, out = place / "local_all" / "scenario.yaml", place / f"driver_{how.name}"
    driver = start_driver(cluster, file, out)
    log, first = out / "campaign.sqlite-wal", 0
    while driver.poll() is None:  # until rows are there; the database is the driver's alone
        now = log.stat().st_size if log.exists() else 0
        if first and now > first + 20_000:
            break
        first = first or now
        time.sleep(0.02)
    driver.send_signal(how)
    said = driver.communicate(timeout=60)[1]
    assert driver.returncode == status, said
    assert 0 < len(rows_of(out)) < 2 * N
    assert (out / "summary.json").exists() == (how == signal.SIGINT)
    again = start_driver(cluster, file, out, "--resume")
    said = again.communicate(timeout=120)[1]
    assert again.returncode == 0, said
    assert rows_of(out) == every(N)
    assert_same(out, local["all"])
