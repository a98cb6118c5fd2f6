# SPDX-License-Identifier: Apache-2.0
"""Episodes on a worker of a Ray cluster: what runs there."""
from __future__ import annotations

import functools
import json
import os
import pickle
import time
from typing import Any, Callable, List, Optional, Tuple

_NAMESPACE = b"floorproof"

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


def _hung(note: bytes, job: int, why: str) -> None:
    """Leaves word in the cluster, as no answer can be given any more, and ends the process."""
    from ray.experimental import internal_kv
    try:
        internal_kv._internal_kv_put(note, json.dumps([job, why]).encode(), namespace=_NAMESPACE)
    finally:
        os._exit(1)


def hung(note: bytes) -> Optional[Tuple[int, str]]:
    """Which job hung, and what is said of it, where the task that died left word."""
    from ray.experimental import internal_kv
    word = internal_kv._internal_kv_get(note, namespace=_NAMESPACE)
    if word is None:
        return None
    internal_kv._internal_kv_del(note, namespace=_NAMESPACE)
    job, why = json.loads(word)
    return job, why


def drive(key: str, load: Callable[[], bytes], jobs: List[int], note: bytes) -> Answers:
    """Drives the jobs one after another. `load` gives the scenario with its plug-ins, pickled, and
    is asked once for each `key`. `note`: under which word is left where a plug-in hangs."""
    global _kept
    from . import _core, _watchdog
    _core.end_where_overdue()
    began = time.perf_counter()
    worker = _worker(key, load)
    answers: List[Tuple[int, Any, str]] = []
    for job in jobs:
        _watchdog.overdue = functools.partial(_hung, note, job)
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

    def floorproof_drive(versions: str, key: str, scenario: List[Any], jobs: List[int],
                         note: bytes) -> Any:
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
            return _remote.drive(key, lambda: ray.get(scenario[0]), jobs, note)
        except Exception as error:
            return f"{node}: cannot take the scenario up: {type(error).__name__}: {error}"

    return floorproof_drive
