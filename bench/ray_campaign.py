# SPDX-License-Identifier: Apache-2.0
"""A campaign on Ray against the same one in worker processes of this machine, in one run, the repeats
interleaved: wall time and the CPU time of all processes; then what the driver alone can take.

    python bench/ray_campaign.py [--repeats 5] [--workers 2] [--only drive|plan|task|driver]

drive: episodes of about 50 ms; plan: `drive: none`, about 1.5 ms each; task: the same, a task each;
driver: rows that are ready, handed in by a pool that does nothing else.
"""
from __future__ import annotations

import argparse
import os
import shutil
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any, Callable, Dict, List, Tuple

os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
os.environ.setdefault("RAY_worker_niceness", "0")  # as the workers of this machine; Ray's own is 15

import psutil  # noqa: E402
import ray  # noqa: E402

import floorproof  # noqa: E402
from floorproof import _core, cluster  # noqa: E402

BASE = {"scenario": 1, "name": "bench", "robot": "beluga", "plan": {"planner": "boustrophedon"},
        "site": str(floorproof.models_folder() / "sites" / "small_room.yaml"),
        "physics": {"timestep_s": 0.005}, "randomise": {"site.floor.friction": {"uniform": [0.5, 1]}}}
KINDS: Dict[str, Tuple[Dict[str, Any], int, Dict[str, Any]]] = {
    "drive": ({"time_limit_s": 13}, 400, {}),
    "plan": ({"drive": "none"}, 8000, {}),
    "task": ({"drive": "none"}, 3000, {"batch_s": 1e-9}),
}


def cpu_s() -> float:
    """Of this process, of what it has waited for, and of all below it that live."""
    own = os.times()
    total = own.user + own.system + own.children_user + own.children_system
    for child in psutil.Process().children(recursive=True):
        try:
            times = child.cpu_times()
            total += times.user + times.system + times.children_user + times.children_system
        except psutil.NoSuchProcess:
            pass
    return total


def timed(drive: Callable[[Path], None], folder: Path) -> Tuple[float, float]:
    shutil.rmtree(folder, ignore_errors=True)
    cpu, wall = cpu_s(), time.perf_counter()
    drive(folder)
    return time.perf_counter() - wall, cpu_s() - cpu


def compare(kind: str, repeats: int, workers: int, folder: Path) -> None:
    changes, n, options = KINDS[kind]
    scenario = floorproof.load({**BASE, **changes})
    walls: List[Tuple[float, float]] = []
    cpus: List[Tuple[float, float]] = []
    own: List[float] = []  # CPU time of the driver
    pools: List[cluster.RayPool] = []
    made = cluster.RayPool

    def noted(*args: Any, **named: Any) -> cluster.RayPool:
        pools.append(made(*args, **named))
        return pools[-1]

    cluster.RayPool = noted  # type: ignore[assignment,misc]
    try:
        floorproof.campaign(scenario, 50, out=folder / "warm", engine="ray")
        shutil.rmtree(folder / "warm")
        for _ in range(repeats):
            here = timed(lambda f: floorproof.campaign(scenario, n, out=f, jobs=workers) and None,
                         folder / "local")
            driver_s = time.process_time()
            there = timed(lambda f: floorproof.campaign(scenario, n, out=f, engine="ray",
                                                        **options) and None, folder / "ray")
            own.append(time.process_time() - driver_s)
            for name in ("summary.json", "episodes.csv"):
                assert ((folder / "local" / name).read_bytes()
                        == (folder / "ray" / name).read_bytes()), name
            walls.append((here[0], there[0]))
            cpus.append((here[1], there[1]))
    finally:
        cluster.RayPool = made  # type: ignore[misc]
    pool = pools[-1]
    for what, pairs in (("wall", walls), ("CPU", cpus)):
        ratios = sorted(a / b for a, b in pairs)
        print(f"{kind}: {what}: local {min(a for a, _ in pairs):.2f} s, Ray "
              f"{min(b for _, b in pairs):.2f} s at least; local / Ray: median "
              f"{statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f})")
    each = [1000 * (b - a) / pool.tasks for a, b in cpus]
    busy = [p.busy_s / (workers * wall) for p, (_, wall) in zip(pools[1:], walls)]
    print(f"{kind}: Ray's workers were at it for {statistics.median(busy):.3f} of the campaign's wall "
          "time (median)")
    print(f"{kind}: {n} episodes of {1000 * min(a for a, _ in cpus) / n:.2f} ms of CPU in "
          f"{pool.tasks} tasks; CPU beyond the local campaign's: median {statistics.median(each):.2f} "
          f"ms a task, the driver's all in all {1000 * min(own) / pool.tasks:.2f} ms a task; "
          f"{pool.bytes_back / n:.0f} bytes a row")


def driver(folder: Path, n: int = 100_000) -> None:
    """One drive's row under other numbers, as fast as they are taken."""
    scenario = floorproof.load({**BASE, **KINDS["drive"][0]})
    worker = _core.Worker(scenario._file)
    head = b'["default",0,'
    row = worker.answer(0)
    assert row.startswith(head)

    class Ready:
        refused = None

        def run(self, calls: Any) -> None:
            job = calls.next()
            while job is not None and not (job % 256 == 0 and calls.stop()):
                calls.done(job, b'["default",%d,' % job + row[len(head):])
                job = calls.next()

    out = folder / "driver"
    cpu, wall = time.process_time(), time.perf_counter()
    marks: List[float] = []

    class Timed(Ready):
        def run(self, calls: Any) -> None:
            super().run(calls)
            marks.append(time.process_time())

    _core.drive_campaign(scenario._file, n, None, 1, False, False, False, None, out, Timed(), None,
                         None)
    print(f"driver: {n} rows in {time.perf_counter() - wall:.2f} s, {time.process_time() - cpu:.2f} s "
          f"of CPU, {n / (marks[0] - cpu):.0f} rows a second of CPU while they come; after it the "
          f"files take {time.process_time() - marks[0]:.2f} s")
    for name in ("campaign.sqlite", "episodes.csv"):
        print(f"driver: {name}: {(out / name).stat().st_size / n:.0f} bytes an episode")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--only", choices=[*KINDS, "driver"])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if options.only in (None, "driver"):
            driver(folder)
        kinds = [k for k in KINDS if options.only in (None, k)]
        if not kinds:
            return
        began = time.perf_counter()
        ray.init(num_cpus=options.workers, include_dashboard=False, log_to_driver=False,
                 logging_level="warning")
        print(f"Ray's own start: {time.perf_counter() - began:.1f} s")
        for kind in kinds:
            compare(kind, options.repeats, options.workers, folder)


if __name__ == "__main__":
    main()
