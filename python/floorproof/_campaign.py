# SPDX-License-Identifier: Apache-2.0
"""Campaigns: many episodes, failure rates with intervals, a gate."""
from __future__ import annotations

import numbers
import os
from contextlib import nullcontext
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _core
from ._checks import among, path_of, whole
from ._core import InputError
from ._progress import Progress, shown
from ._recorded import checked, json_object
from ._results import PathLike
from ._scenario import Scenario, load
from ._warn import warn

_TABLES = ("episode", "encounter")


class Campaign:
    """What a campaign left in its folder."""

    def __init__(self, folder: PathLike, ended: Optional[Mapping[str, Any]] = None) -> None:
        self.folder = Path(folder)
        ended = ended or {"end": "", "lines": [], "status": None}
        self.end: str = ended["end"]
        """Why it ended, in words; empty where it was only read."""
        self._lines: List[str] = ended["lines"]  # as the command line says them
        self._status: Optional[int] = ended["status"]  # and its exit status
        file = self.folder / "summary.json"
        self.summary: Dict[str, Any] = json_object(file, "floorproof campaign", {"variants": dict})
        for name, variant in self.variants.items():
            checked(f"{file}: variants.{name}", variant, {"n": int, "failures": dict})

    @property
    def variants(self) -> Dict[str, Any]:
        """By name: n, failures (each with rate, lower, upper), coverage, ..."""
        variants: Dict[str, Any] = self.summary["variants"]
        return variants

    @property
    def gate(self) -> Optional[Mapping[str, Any]]:
        """What the gate says; None: there is none, or this is a shard."""
        return self.summary.get("gate")

    def to_pandas(self, table: str = "episode") -> Any:
        """A table of campaign.sqlite as a data frame: `episode`, a row an episode, or `encounter`,
        a row a hazard that one of them met (docs/exports.md)."""
        from . import exports
        among("table", table, _TABLES)
        return exports.episodes_frame(self.folder) if table == "episode" else \
            exports.encounters_frame(self.folder)

    def to_parquet(self, file: PathLike, table: str = "episode") -> Path:
        """The same as a Parquet file."""
        from . import exports
        among("table", table, _TABLES)
        return exports.episodes_parquet(self.folder, file) if table == "episode" else \
            exports.encounters_parquet(self.folder, file)

    def report(self) -> Path:
        """Writes the page; returns report.html."""
        return report(self.folder)

    def _repr_html_(self) -> str:
        from ._notebook import campaign_html
        return campaign_html(self)

    def __repr__(self) -> str:
        n = sum(v["n"] for v in self.variants.values())
        errors = sum(v["n_error"] for v in self.variants.values())
        return f"<Campaign {self.folder}: {n} episodes" + (f", {errors} errors>" if errors else ">")


def _range(episodes: Any) -> Tuple[int, int]:
    try:
        begin, end = episodes
    except (TypeError, ValueError):
        raise InputError(f"episodes = {episodes!r}: must be (a, b): the first id and the one behind "
                         "the last") from None
    return whole("episodes[0]", begin, 0), whole("episodes[1]", end, 0)


def campaign(scenario: Union[Scenario, PathLike, Mapping[str, Any]], n: int, *, out: PathLike,
             engine: str = "local", jobs: Optional[int] = None,
             episodes: Optional[Tuple[int, int]] = None, resume: bool = False,
             retry_errors: bool = False, fail_fast: bool = False,
             time_limit_s: Optional[float] = None, progress: Progress = None,
             **engine_options: Any) -> Campaign:
    """Drives n episodes of each variant and judges the gate; the folder `out` gets what `floorproof
    campaign --no-films` writes there, the same bytes whatever drives them.

    engine: `local`: worker processes of this machine, `jobs` of them (default: one a core); `ray`:
    the workers of a Ray cluster (docs/cluster.md; options go to floorproof.cluster.RayPool).
    episodes: (a, b), half-open: a shard for `merge`; its gate is judged there.
    """
    if not isinstance(scenario, Scenario):
        scenario = load(scenario)
    among("engine", engine, ("local", "ray"))
    if engine == "local" and engine_options:
        raise InputError(f"{next(iter(engine_options))}: is no option of engine local")
    if engine == "ray" and jobs is not None:
        raise InputError(f"jobs = {jobs}: is for engine local; a Ray cluster has the workers it has")
    n = whole("n", n, 1)
    shard = None if episodes is None else _range(episodes)
    workers = whole("jobs", _core.usable_cores() if jobs is None else jobs, most=(1 << 31) - 1)
    if not (time_limit_s is None or isinstance(time_limit_s, numbers.Real)):
        raise InputError(f"time_limit_s = {time_limit_s!r}: must be a number (s)")
    pool: Any = None
    if engine == "ray":
        from .cluster import RayPool
        pool = RayPool(scenario, **engine_options)
    total = n if shard is None else shard[1] - shard[0]
    with pool or nullcontext(), shown(progress, total * len(scenario.variants), "episode",
                                      scenario.name) as show:
        tell = None if show is None else lambda done, all_: show(done)
        ended = _core.drive_campaign(
            scenario._file, n, shard, workers, resume, retry_errors, fail_fast, time_limit_s,
            path_of("out", out), pool, warn, tell)
    if pool is not None and pool.refused is not None:
        raise pool.refused
    return Campaign(out, ended)


def merge(shards: Sequence[PathLike], out: PathLike) -> Campaign:
    """Joins shards of one campaign, driven anywhere, into `out`, and judges the gate."""
    if isinstance(shards, (str, bytes, os.PathLike)):
        raise InputError(f"shards = {shards!r}: must be a list of folders")
    return Campaign(out, _core.merge([os.fspath(s) for s in shards], Path(out)))


def report(folder: PathLike) -> Path:
    """Writes a campaign's page from its recorded results alone; returns report.html."""
    return _core.write_report(Path(folder))
