# SPDX-License-Identifier: Apache-2.0
"""Episodes on a worker of a Ray cluster: what runs there."""
from __future__ import annotations

import pickle
import time
from typing import Any, Callable, List, Tuple

# The answer to a batch: (job, the row's bytes or None, why not) of each, and the wall time (s).
Answers = Tuple[List[Tuple[int, Any, str]], float]

# The scenario that this process drives, and its worker: the plans that it made stay with it.
_kept: Tuple[str, Any] = ("", None)


def _worker(key: str, load: Callable[[], bytes]) -> Any:
    global _kept
    if _kept[0] != key:
        from . import _core, _plugins
        packed, plugins = pickle.loads(load())
        for (kind, name), (made, promises) in pickle.loads(plugins).items():
            _plugins.register(kind, name, made, promises)
        _kept = (key, _core.Worker(_core.ScenarioFile.unpack(packed)))
    return _kept[1]


def drive(key: str, load: Callable[[], bytes], jobs: List[int]) -> Answers:
    """Drives the jobs one after another. `load` gives the scenario with its plug-ins, pickled, and
    is asked once for each `key`."""
    global _kept
    began = time.perf_counter()
    worker = _worker(key, load)
    answers: List[Tuple[int, Any, str]] = []
    for job in jobs:
        try:
            answers.append((job, worker.answer(job), ""))
        except Exception as error:  # where it is a process of this machine, it would be a crash
            answers.append((job, None, f"raised {type(error).__name__}: {error}"))
            _kept = ("", None)
            worker = _worker(key, load)
    return answers, time.perf_counter() - began


def task() -> Callable[..., Any]:
    """The function that Ray ships. It travels by value and leans on nothing of this package before
    it has seen that the package there is the one that the driver has."""

    def floorproof_drive(versions: str, key: str, scenario: List[Any], jobs: List[int]) -> Any:
        # Returns Answers, or in words why this node cannot take part.
        import json
        import socket

        import ray

        about = ray.get_runtime_context()
        node = f"Ray node {socket.gethostname()} ({about.get_node_id()[:12]})"
        rule = ("results need the same version on the same type of machine everywhere "
                "(docs/cluster.md)")
        try:
            import floorproof
        except Exception as error:
            return f"{node}: cannot import floorproof: {type(error).__name__}: {error}; {rule}"
        try:
            from floorproof import _core
            here = _core.versions()
        except Exception:
            here = json.dumps({"floorproof": getattr(floorproof, "__version__", "?")})
        if here != versions:
            mine, there = json.loads(here), json.loads(versions)
            other = [f"{what} {mine.get(what, '?')} where the driver has {value}"
                     for what, value in there.items() if mine.get(what, "?") != value]
            return f"{node}: has " + ", ".join(other) + f"; {rule}"
        try:
            from floorproof import _remote
            return _remote.drive(key, lambda: ray.get(scenario[0]), jobs)
        except Exception as error:
            return f"{node}: cannot take the scenario up: {type(error).__name__}: {error}"

    return floorproof_drive
