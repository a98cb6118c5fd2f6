# SPDX-License-Identifier: Apache-2.0
"""Campaigns on a Ray cluster: floorproof.campaign(..., engine="ray", **options of RayPool), and
`python -m floorproof.cluster`. See docs/cluster.md.

The driver hands out episode ids in batches, as Ray tasks; nothing but ids goes there and nothing
but rows comes back. It alone writes the campaign's folder and judges the gate, on the prefix of ids
that is whole. So the files are those of a campaign on one machine, byte for byte.
"""
from __future__ import annotations

import functools
import hashlib
import math
import os
import pickle
import socket
import sys
import time
import uuid
from collections import deque
from typing import Any, Deque, Dict, List, Mapping, Optional, Sequence, Tuple

from . import _core, _plugins, _remote
from ._core import InputError
from ._scenario import Scenario
from ._warn import warn

_ASK_S = 0.1  # at most, between two looks at what the campaign says
_SIZE_S = 2.0  # between two looks at how large the cluster is
_PATIENCE_S = 10.0  # until it is said that no node is large enough
_GROWTH = 4  # of a batch, from one to the next: the first episodes may be the short ones
_PIECES = 16  # answers are fetched when a sixteenth of what flies is there, or after _ASK_S


def _ray() -> Any:
    try:
        import ray
        import ray.exceptions
    except ImportError as error:
        raise InputError("engine = ray: needs the package ray: pip install ray") \
            from error
    return ray


def _knock(address: str) -> None:
    """Ray itself takes minutes to find that nobody is there."""
    host, colon, port = address.rpartition(":")
    if not colon or not port.isdecimal() or "/" in host:
        return
    try:
        socket.create_connection((host, int(port)), timeout=10).close()
    except (OSError, OverflowError) as error:
        raise InputError(f"address = {address}: no Ray cluster answers there: {error}") from error


def _connect(ray: Any, address: Optional[str], runtime_env: Optional[Mapping[str, Any]],
             task_cpus: float) -> bool:
    """True where a connection was made here, which is closed here."""
    if ray.is_initialized():
        if address is not None or runtime_env is not None:
            raise InputError("address, runtime_env: ray.init() was called already; give them there")
        return False
    own = address is None and not os.environ.get("RAY_ADDRESS")
    _knock(address or os.environ.get("RAY_ADDRESS", ""))
    # A cluster of one's own, on this machine, serves this campaign alone.
    if own:
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    here = _core.usable_cores()
    if own and task_cpus > here:
        raise InputError(f"num_cpus = {task_cpus:g}: no node has as many; this machine has {here}")
    alone: Dict[str, Any] = {"include_dashboard": False, "num_cpus": here} if own else {}
    try:
        ray.init(address=address, runtime_env=dict(runtime_env) if runtime_env else None,
                 logging_level="warning", log_to_driver=False, **alone)
    except (ConnectionError, ValueError, RuntimeError) as error:
        said = str(error).strip().splitlines()
        where = address or os.environ.get("RAY_ADDRESS", "local")
        raise InputError(f"address = {where}: ray.init: "
                         f"{said[0] if said else type(error).__name__}") from error
    return True


def _pickled_plugins(packed: Any) -> bytes:
    """The plug-ins registered here whose names the scenario holds: by value, with the modules that
    they are written in, unless these are installed ones."""
    import ray
    cloudpickle: Any = ray.cloudpickle
    *_, text, overrides, inputs = packed
    words = [(text or "").encode(), repr(overrides).encode(), *(data for _, data in inputs)]
    used = {at: what for at, what in _plugins.registered.items()
            if any(at[1].encode() in word for word in words)}
    modules = []
    for made, _ in used.values():
        while isinstance(made, functools.partial):
            made = made.func
        module = sys.modules.get(made.__module__)
        where = getattr(module, "__file__", None) or ""
        if module is not None and module.__name__ != "__main__" and "site-packages" not in where:
            modules.append(module)
    for module in modules:
        cloudpickle.register_pickle_by_value(module)
    try:
        pickled: bytes = cloudpickle.dumps(used)
        return pickled
    except Exception as error:
        names = ", ".join(name for _, name in used)
        raise InputError(f"plug-ins {names}: cannot be sent to workers: {error}") from error
    finally:
        for module in set(modules):
            cloudpickle.unregister_pickle_by_value(module)


class _Batches:
    """Jobs in batches of about so much work, from what the answers took."""

    def __init__(self, batch_s: float) -> None:
        self._batch_s = batch_s
        self._jobs, self._wall_s = 0.0, 0.0
        self._largest = 0
        self.queue: Deque[int] = deque()
        self.all = False  # there are no more

    def learn(self, jobs: int, wall_s: float) -> None:
        self._jobs, self._wall_s = 0.8 * self._jobs + jobs, 0.8 * self._wall_s + wall_s
        self._largest = max(self._largest, jobs)

    def size(self) -> int:
        if not self._largest:
            return 1
        wanted = self._batch_s * self._jobs / max(self._wall_s, 1e-6)
        return max(1, int(min(wanted, _GROWTH * self._largest)))

    def take(self, calls: Any, workers: int) -> List[int]:
        size = self.size()
        while not self.all and len(self.queue) < 2 * workers * size:
            job = calls.next()
            self.all = job is None
            if job is not None:
                self.queue.append(job)
        if self.all:  # the last ones in smaller pieces, so that all workers end at about one time
            size = min(size, max(math.ceil(size / 8), math.ceil(len(self.queue) / (2 * workers))))
        return [self.queue.popleft() for _ in range(min(size, len(self.queue)))]


class RayPool:
    """The workers of a Ray cluster, for one campaign.

    address: of the cluster, as ray.init takes it (`auto`: the one that runs on this machine); none:
    what RAY_ADDRESS says, else a cluster of one's own on this machine. runtime_env: as ray.init
    takes it. Where ray.init() was called already, neither. batch_s: the work of a task (s).
    retries: how often an episode is tried again whose process or node died. num_cpus: of a task.
    """

    def __init__(self, scenario: Scenario, *, address: Optional[str] = None,
                 runtime_env: Optional[Mapping[str, Any]] = None, batch_s: float = 0.75,
                 retries: int = 3, num_cpus: float = 1) -> None:
        for name, value, rule in (("batch_s", batch_s, batch_s > 0),
                                  ("num_cpus", num_cpus, num_cpus > 0)):
            if not rule:
                raise InputError(f"{name} = {value}: must be > 0")
        if retries < 0:
            raise InputError(f"retries = {retries}: must be >= 0")
        ray = _ray()
        packed = scenario._packed()
        self._blob = pickle.dumps((packed, _pickled_plugins(packed)))
        self._key = hashlib.sha256(self._blob).hexdigest()
        self._versions: str = _core.versions()
        self._connection = (address, runtime_env)
        self._retries, self._cpus = retries, num_cpus
        self._batches = _Batches(batch_s)
        self._ray = ray
        self._name = uuid.uuid4().hex
        self._flight: Dict[Any, Tuple[List[int], bytes]] = {}  # jobs, and where they leave word
        self._again: Deque[int] = deque()
        self._deaths: Dict[int, int] = {}  # of jobs that are to be tried again
        self._workers, self._asked = 1, -math.inf
        self._fits, self._warned = 0.0, False  # when a node last had enough CPUs; that none has
        self._connected = False
        self.refused: Optional[InputError] = None
        """What ended the campaign: a node that cannot take part."""
        # What it took: tasks, bytes of rows, and the wall time that workers were at it (s).
        self.tasks, self.bytes_back, self.busy_s = 0, 0, 0.0

    def __enter__(self) -> "RayPool":
        """Connects, unless ray.init() was called already."""
        self._connected = _connect(self._ray, *self._connection, self._cpus)
        return self

    def __exit__(self, *_: Any) -> None:
        if self._connected:
            self._ray.shutdown()

    def run(self, calls: Any) -> None:
        """Drives what `calls.next()` gives until there is no more, or `calls.stop()`."""
        ray = self._ray
        try:
            scenario = [ray.put(self._blob)]
            # One that dies is counted and tried again here, alone; Ray would take the whole batch.
            remote = ray.remote(num_cpus=self._cpus, max_retries=0)(_remote.task())
            while not calls.stop():
                self._submit(calls, remote, scenario)
                if not self._flight:
                    break
                some = max(1, len(self._flight) // _PIECES)
                ready, _ = ray.wait(list(self._flight), num_returns=some, timeout=_ASK_S)
                for ref in ready:
                    self._take(calls, ref)
                del ready
                if self.refused:
                    break
        finally:
            # What flies is forgotten. ray.cancel() may end the driver's process (a check within Ray
            # 2.60 fails where a task ends meanwhile); a batch is short, and a connection that is
            # closed ends its workers.
            self._flight.clear()

    def _submit(self, calls: Any, remote: Any, scenario: List[Any]) -> None:
        if time.monotonic() - self._asked > _SIZE_S:  # nodes come and go
            cpus = [node["Resources"].get("CPU", 0) for node in self._ray.nodes() if node["Alive"]]
            self._workers = max(1, sum(int(here / self._cpus) for here in cpus))
            self._asked = time.monotonic()
            self._mind(max(cpus, default=0))
        while len(self._flight) < 2 * self._workers:
            jobs = ([self._again.popleft()] if self._again
                    else self._batches.take(calls, self._workers))
            if not jobs:
                return
            note = f"{self._name}.{self.tasks}".encode()
            ref = remote.remote(self._versions, self._key, scenario, jobs, note)
            self._flight[ref] = (jobs, note)
            self.tasks += 1

    def _mind(self, largest: float) -> None:
        """Says it where tasks wait for a node larger than any; one may be on its way."""
        if largest >= self._cpus or not self._fits:
            self._fits = time.monotonic()
        elif not self._warned and time.monotonic() - self._fits > _PATIENCE_S:
            self._warned = True
            warn(f"warning: num_cpus = {self._cpus:g}: no node has as many; the largest has "
                 f"{largest:g}, so nothing is driven until a larger one comes")

    def _take(self, calls: Any, ref: Any) -> None:
        errors = self._ray.exceptions
        jobs, note = self._flight.pop(ref)
        try:
            answer = self._ray.get(ref)
        except (errors.RayTaskError, errors.RuntimeEnvSetupError) as error:
            self.refused = InputError("a Ray node cannot drive episodes: "
                                      + " ".join(str(error).split())[-500:])
            return
        except errors.OutOfMemoryError:
            answer = [(job, None, "was killed: its node ran out of memory") for job in jobs], 0
        except errors.NodeDiedError:
            answer = [(job, None, "died with its node") for job in jobs], 0
        except errors.RayError:
            word = _remote.hung(note)
            if word is not None:  # it would hang again; those beside it are not to blame
                hung, why = word
                self._deaths.pop(hung, None)
                calls.hung(hung, why)
                self._again.extend(job for job in jobs if job != hung)
                return
            answer = [(job, None, "died") for job in jobs], 0
        if isinstance(answer, str):
            self.refused = InputError(answer)
            return
        answers, wall_s = answer
        if wall_s:
            self._batches.learn(len(jobs), wall_s)
            self.busy_s += wall_s
        for job, row, why in answers:
            if row is not None:
                self._deaths.pop(job, None)
                self.bytes_back += len(row)
                calls.done(job, row)
            elif self._deaths.setdefault(job, 0) < self._retries:
                self._deaths[job] += 1
                self._again.append(job)
            else:
                calls.crashed(job, f"its process {why}, {self._deaths.pop(job) + 1} times")


if __name__ == "__main__":
    from ._cluster_command import main
    sys.exit(main())
