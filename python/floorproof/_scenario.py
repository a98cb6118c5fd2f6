# SPDX-License-Identifier: Apache-2.0
"""Scenarios, from files or dicts: what they are, and what becomes of them."""
from __future__ import annotations

import hashlib
from functools import cached_property
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union, cast

import numpy as np

from . import _core
from ._checks import path_of, picture_size, whole
from ._core import InputError
from ._progress import Progress, shown
from ._results import Episode, PathLike, Plan, Pose, episode_of, json_map
from ._site import Site
from ._yaml import overrides_of, yaml_text


class Scenario:
    """A scenario, read and checked. It pickles with all the files that it read."""

    def __init__(self, packed: Any) -> None:
        self._file = _core.ScenarioFile.unpack(packed)
        self._which: Tuple[int, Optional[str]] = (self._file.episode, None)
        self._read = self._file.read(*self._which)

    # --- what it is

    @property
    def name(self) -> str:
        return self._file.name

    @property
    def file(self) -> Path:
        """Where it was read from; of a dict a name that stands for it."""
        return self._file.file

    @property
    def seed(self) -> int:
        return self._file.seed

    @property
    def variants(self) -> List[str]:
        """The variants of its matrix; `default` where it has none."""
        return self._file.variants

    @cached_property
    def site(self) -> Site:
        return Site(self._read.site)

    @property
    def robot(self) -> Dict[str, Any]:
        """Name, drive, clear shape and tool, speeds."""
        return cast(Dict[str, Any], self._read.robot)

    @property
    def planner(self) -> str:
        return self._read.planner

    @property
    def tracker(self) -> str:
        return self._read.tracker

    @property
    def sensors(self) -> List[str]:
        return self._read.sensors

    @property
    def start(self) -> Pose:
        return self._read.start

    @property
    def control_hz(self) -> int:
        return self._read.control_hz

    def warnings(self) -> List[str]:
        """What is read as written but may not be meant; a line each."""
        return self._read.warnings()

    def resolved(self, folder: PathLike = ".") -> str:
        """The scenario with every default stated (YAML), paths valid from `folder`."""
        return self._read.resolved(Path(folder))

    # --- what becomes of it

    def with_(self, changes: Optional[Mapping[str, Any]] = None, **top: Any) -> "Scenario":
        """The same with keys set, as --set does: with_({"robot.clearance_m": 0.02}, seed=3)."""
        *source, overrides, inputs = self._packed()
        return Scenario((*source, overrides + overrides_of(changes, top), inputs))

    def with_plan(self, path: Any) -> "Scenario":
        """The same with a plan of one's own: [n, 2] to [n, 5], columns as `Plan.path`."""
        names = ("x_m", "y_m", "yaw_rad", "speed_mps", "dwell_s")
        rule = "must be [n, 2] to [n, 5]: " + ", ".join(names)
        try:
            rows = np.asarray(path, dtype=float)
        except (TypeError, ValueError) as error:
            raise InputError(f"path = {' '.join(repr(path).split())[:60]}: is no array of numbers: "
                             f"{rule}; planners and files are set as keys (plan, plan.file)") \
                from error
        if rows.ndim != 2 or not 2 <= rows.shape[1] <= 5 or len(rows) == 0:
            raise InputError(f"path: an array of shape {rows.shape}: {rule}")
        lines = [",".join(names[:rows.shape[1]])]
        lines += [",".join("" if c == 2 and np.isnan(v) else repr(float(v))
                           for c, v in enumerate(row)) for row in rows]
        csv = "\n".join(lines) + "\n"
        name = f"plan-{hashlib.sha256(csv.encode()).hexdigest()[:12]}.csv"
        *source, overrides, inputs = self._packed()
        inputs = inputs + [(str(self.file.parent / name), csv.encode())]
        return Scenario((*source, overrides + [("plan.file", yaml_text(name))], inputs))

    def episode(self, episode: int, variant: Optional[str] = None) -> "Scenario":
        """The scenario as one episode of a campaign has it, its draws made. Episodes count from 0."""
        episode = whole("episode", episode, 0, _core.MOST_EPISODES)
        made = Scenario.__new__(Scenario)
        made._file, made._which = self._file, (episode, variant)
        made._read = made._fresh()
        return made

    def plan(self) -> Plan:
        """Plans. That there is no plan is no exception: its `status` says so."""
        return Plan(self._fresh().make_plan())

    def predict(self, draws: int = 256) -> Dict[str, Any]:
        """How often its plan will fail, from the robot's measured rates and before any drive: what
        predict.json holds (docs/measured-risk.md), among it `no_failure`, `any_failure` and `modes`
        (each with probability, lower, upper), `hazards` and `meetings`. The key `risk.model` names
        the rates. Conditions are what `draws` episodes draw, the first ones, of episode(k) those
        from k on; one condition where nothing is drawn.

        Throws InputError where no rates are named, where there is no plan, or where it is made on
        the way."""
        draws = whole("draws", draws, 1, 100_000)
        episode, variant = self._which
        file = self._file if episode == self._file.episode else self.with_(episode=episode)._file
        return json_map(file.predict(variant, draws))

    def run(self, plan: Union[None, Plan, Any] = None, *, out: Optional[PathLike] = None,
            video: bool = False, progress: Progress = None,
            observer: Optional[Callable[[Any], None]] = None, observe_hz: Optional[float] = None,
            say: Optional[Callable[[str], None]] = None) -> Episode:
        """Plans (or takes `plan`: a Plan of this scenario, or an array as with_plan takes it),
        drives it through physics and judges it.

        out: a folder that gets what `floorproof run` writes there, the same bytes; `video`: the film
        as well. progress: True, tqdm, or what is shaped as it. observer: called with a view of the
        drive (t_s, pose, estimate, coverage, scan) in each control period, or `observe_hz` times a
        second. say: takes the lines that the command line would print.
        """
        if plan is not None and not isinstance(plan, Plan):
            return self.with_plan(plan).run(out=out, video=video, progress=progress,
                                            observer=observer, observe_hz=observe_hz, say=say)
        if video and out is None:
            raise InputError("video: needs `out`, the folder that gets the film")
        if out is not None and (plan is not None or observer is not None):
            raise InputError("out: the folder records a plan that is made anew; leave `plan` and "
                             "`observer` out, or pass an array as plan")
        with shown(progress, 100, "%", self.name) as show:
            tell = None if show is None else lambda share, t_s, coverage: show(round(100 * share))
            episode = self._driven(plan, out, video, say, tell, observer, observe_hz)
            if show is not None and episode.outcome == "success":
                show(100)  # a plan's end is reached where it is near enough
            return episode

    def frame(self, width: int = 960, height: int = 540, camera: str = "auto") -> np.ndarray:
        """A picture [height, width, 3] of the robot at its start. camera: auto, chase, top, side."""
        return _core.start_frame(self._read, *picture_size(width, height), camera)

    # --- inside

    def _driven(self, plan: Optional[Plan], out: Optional[PathLike], video: bool,
                say: Optional[Callable[[str], None]], tell: Optional[Callable[..., None]],
                observer: Optional[Callable[[Any], None]], observe_hz: Optional[float]) -> Episode:
        if out is not None:
            folder = path_of("out", out)
            return episode_of(_core.run_into(self._fresh(), folder, video, say, tell), folder)
        every = 1
        if observe_hz is not None:
            if not observe_hz > 0:
                raise InputError(f"observe_hz = {observe_hz}: must be > 0")
            every = round(min(max(1.0, self.control_hz / observe_hz), 1e9))
        return episode_of(_core.run(self._fresh(), None if plan is None else plan._core, tell,
                                    observer, every, True))

    def _fresh(self) -> Any:
        """As read, for one drive: several may go on in several threads."""
        return self._file.read(*self._which)

    def _packed(self) -> Any:
        *source, overrides, inputs = self._file.pack()
        return (*source, list(overrides), list(inputs))

    def __reduce__(self) -> Any:
        return _unpickled, (self._packed(), self._which)

    @cached_property
    def _png(self) -> Optional[bytes]:
        from ._notebook import site_png
        return site_png(self.site, self.start)

    def _repr_png_(self) -> Optional[bytes]:
        return self._png

    def _repr_html_(self) -> str:
        from ._notebook import scenario_html
        return scenario_html(self)

    def __repr__(self) -> str:
        return (f"<Scenario {self.name}: {self.robot['name']} on {self.site.name}, "
                f"{self.planner}>")


def _unpickled(packed: Any, which: Tuple[int, Optional[str]]) -> Scenario:
    scenario = Scenario(packed)
    return scenario if which == scenario._which else scenario.episode(*which)


def load(source: Union[PathLike, Mapping[str, Any]], changes: Optional[Mapping[str, Any]] = None, *,
         folder: Optional[PathLike] = None, trust: bool = False, **top: Any) -> Scenario:
    """Reads and checks a scenario: its file, or what would stand there as a dict, whose paths are
    relative to `folder` (default: the working directory). Keys are set as --set does:

        load("scenario.yaml", {"site.floor.friction": 0.6}, seed=3)

    `trust`: the file may name a program to plan, and files outside its folder, as --trust lets it
    (docs/security.md). A dict is the caller's own.
    """
    overrides = overrides_of(changes, top)
    if isinstance(source, Mapping):
        return Scenario((Path(folder or "") / "scenario", True, yaml_text(source), overrides, []))
    if folder is not None:
        raise InputError("folder: is for dicts; paths in a file are relative to that file")
    return Scenario((path_of("scenario", source), bool(trust), None, overrides, []))
