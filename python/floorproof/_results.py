# SPDX-License-Identifier: Apache-2.0
"""Plans and episodes: what came of a scenario."""
from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._checks import number, path_of, picture_size
from ._core import InputError
from ._recorded import encounters_of, json_object, recorded_encounters, trace_columns

PathLike = Union[str, "os.PathLike[str]"]
Pose = Tuple[float, float, float]


@dataclass(frozen=True)
class Frame:
    """Where the cells of a map lie: `width` x `height` of them, `cell_m` wide. `origin` is the pose
    of the outer lower-left corner of cell (0, 0) in the world."""

    width: int
    height: int
    cell_m: float
    origin: Pose

    def cell(self, x_m: float, y_m: float) -> Tuple[int, int]:
        """(row, column) of the cell that holds the point; it may lie outside the map."""
        x, y, yaw = self.origin
        c, s = np.cos(yaw), np.sin(yaw)
        dx, dy = x_m - x, y_m - y
        return (int(np.floor((-s * dx + c * dy) / self.cell_m)),
                int(np.floor((c * dx + s * dy) / self.cell_m)))

    def centre(self, row: int, column: int) -> Tuple[float, float]:
        """The centre of a cell, in the world."""
        x, y, yaw = self.origin
        c, s = np.cos(yaw), np.sin(yaw)
        gx, gy = (column + 0.5) * self.cell_m, (row + 0.5) * self.cell_m
        return (x + c * gx - s * gy, y + s * gx + c * gy)


@dataclass(frozen=True)
class Hazard:
    """A hazard of a site. `hazard_class`: blind_object, glass, level_change or terrain; `height_m` is
    signed; `known`: planners are told of it; `polygons_m`: its footprint, each polygon a list of
    [x, y] in the world frame; `keep_off`: the robot must, None where there is no robot."""

    id: str
    type: str
    hazard_class: str
    height_m: float
    known: bool
    polygons_m: List[List[Sequence[float]]]
    keep_off: Optional[bool] = None


@dataclass(frozen=True)
class Event:
    """A failure: `mode` is veer_off, stuck, roll_over or bounce_back. `evidence` holds the event as
    result.json has it."""

    mode: str
    kind: str
    t_s: float
    x_m: float
    y_m: float
    yaw_rad: float
    hazard: str
    evidence: Mapping[str, Any] = field(repr=False)


def event_of(json_event: Mapping[str, Any]) -> Event:
    return Event(json_event["mode"], json_event.get("kind") or "", json_event["t_s"],
                 json_event["x_m"], json_event["y_m"], json_event["yaw_rad"],
                 json_event.get("hazard") or "", json_event)


def frame_of(about: Mapping[str, Any]) -> Frame:
    return Frame(about["width"], about["height"], about["cell_m"], tuple(about["origin"]))


def hazards_of(about: Sequence[Mapping[str, Any]]) -> List[Hazard]:
    return [Hazard(hazard_class=h["class"], **{key: h[key] for key in h if key != "class"})
            for h in about]


def json_map(text: str) -> Dict[str, Any]:
    made: Dict[str, Any] = json.loads(text)
    return made


class Plan:
    """A plan of a scenario: `Scenario.plan()` makes it."""

    def __init__(self, core: _core.Plan) -> None:
        self._core = core

    @property
    def status(self) -> str:
        """success, or why there is none: start_blocked, no_floor, goal_unreachable, ... `online`:
        it is made on the way."""
        return self._core.status

    @property
    def message(self) -> str:
        """Why, in words; on success what was left out, or empty."""
        return self._core.message

    @property
    def path(self) -> np.ndarray:
        """[n, 5]: x_m, y_m, yaw_rad (nan: along the way), speed_mps (0: the robot's cruise),
        dwell_s. To be read: a copy of it, changed, is a plan of your own, which `run` takes."""
        return self._path

    @cached_property
    def _path(self) -> np.ndarray:
        path: np.ndarray = self._core.path
        path.flags.writeable = False
        return path

    @property
    def shapes(self) -> List[str]:
        """The shape taken at each waypoint, of a robot that has several; empty: as it is."""
        return self._core.shapes

    @cached_property
    def info(self) -> Dict[str, Any]:
        """What plan.json holds: length_m, turns, coverage, the planner's own figures."""
        return json_map(self._core.json)

    @cached_property
    def risk(self) -> np.ndarray:
        """The risk factor (RF) of each cell of `risk_frame`."""
        return self._core.risk

    @property
    def risk_frame(self) -> Frame:
        return frame_of(self._core.risk_frame)

    def check(self) -> Dict[str, Any]:
        """What `floorproof plan` says of it: clearance, hazards driven over, floor left out, time
        and energy."""
        if self.status != "success":
            raise InputError(f"there is no plan to check: {self.message}")
        return json_map(self._core.check())

    def save(self, folder: PathLike) -> Path:
        """Writes what `floorproof plan` writes: plan.csv, plan.json, pictures."""
        _core.save_plan(self._core, path_of("folder", folder))
        return Path(folder)

    @cached_property
    def _png(self) -> Optional[bytes]:
        from ._notebook import plan_png
        return plan_png(self)

    def _repr_png_(self) -> Optional[bytes]:
        return self._png

    def _repr_html_(self) -> str:
        from ._notebook import plan_html
        return plan_html(self)

    def __repr__(self) -> str:
        if self.status != "success":
            return f"<Plan {self.status}: {self.message}>"
        return f"<Plan of {len(self.path)} waypoints, {self.info['length_m']:.1f} m>"


class Episode:
    """A plan driven once: `Scenario.run()` makes it, `read(folder)` takes it from a folder."""

    def __init__(self, result: Mapping[str, Any], trace: Mapping[str, Any],
                 plan: Optional[Plan] = None, core: Optional[_core.Episode] = None,
                 folder: Optional[Path] = None,
                 encounters: Optional[List[Dict[str, Any]]] = None) -> None:
        self.result: Dict[str, Any] = dict(result)
        self.plan = plan
        self.folder = folder
        self._core = core
        self._trace = trace
        self._recorded = encounters

    @property
    def outcome(self) -> str:
        """success, failure, timeout, aborted, not_planned or error."""
        return str(self.result["outcome"])

    @property
    def message(self) -> str:
        return self.result.get("message") or ""

    @cached_property
    def events(self) -> List[Event]:
        """The failures, in order; the first names the episode's."""
        return [event_of(e) for e in self.result["events"]]

    @property
    def metrics(self) -> Dict[str, Optional[float]]:
        """By name, as docs/results.md lists them; None: not measured."""
        metrics: Dict[str, Optional[float]] = self.result["metrics"]
        return metrics

    @property
    def margins(self) -> Dict[str, float]:
        """By detector: the least distance from failing; positive is safe."""
        margins: Dict[str, float] = self.result.get("margins", {})
        return margins

    @property
    def drawn(self) -> Dict[str, Any]:
        """What `randomise` drew for it."""
        drawn: Dict[str, Any] = self.result.get("drawn", {})
        return drawn

    @property
    def trace(self) -> Mapping[str, Any]:
        """Column by column, as trace.csv has them; arrays of one length, `shape` a list of words."""
        return self._trace

    @cached_property
    def encounters(self) -> List[Dict[str, Any]]:
        """The hazards that it met, in order, each a dict with the columns of encounters.csv
        (docs/results.md lists them with their units); `size` is a dict by key. Last what it drove
        along walls and over free floor. Empty of `drive: cells`. Throws InputError of a folder in
        which an earlier version recorded none."""
        if self._core is not None:
            return encounters_of(self._core.encounters)
        if self._recorded is None:
            raise InputError(f"{self.folder}: holds no encounters.csv; earlier versions wrote none: "
                             "run its scenario.resolved.yaml again")
        return self._recorded

    @cached_property
    def maps(self) -> Dict[str, Any]:
        """`passes` (of the tool, per cell) and `sweepable` on `frame`; `known` (0 free, 1 occupied,
        2 unknown) on `known_frame`, of a robot that draws a map. Empty of an episode that was read
        from a folder: pictures hold them there."""
        if self._core is None:
            return {}
        maps = dict(self._core.maps)
        for name in ("frame", "known_frame"):
            if name in maps:
                maps[name] = frame_of(maps[name])
        return maps

    def frame(self, t_s: Optional[float] = None, width: int = 960, height: int = 540,
              camera: str = "auto") -> np.ndarray:
        """A picture [height, width, 3] of the drive at a time (none: its end), as the film has it."""
        if self._core is None:
            raise InputError("an episode that was read from a folder has no states to draw; run its "
                             "scenario.resolved.yaml again")
        last = float(self.trace["t_s"][-1] if len(self.trace["t_s"]) else 0.0)
        at_s = last if t_s is None else number("t_s", t_s)
        if not 0 <= at_s <= last:
            raise InputError(f"t_s = {at_s}: must lie within the drive: 0 to {last}")
        picture: np.ndarray = _core.frames(
            self._core, [at_s], *picture_size(width, height), camera)[0]
        return picture

    def to_pandas(self) -> Any:
        """The trace as a data frame."""
        from .exports import trace_frame
        return trace_frame(self)

    @cached_property
    def _png(self) -> Optional[bytes]:
        from ._notebook import episode_png
        return episode_png(self)

    def _repr_png_(self) -> Optional[bytes]:
        return self._png

    def _repr_html_(self) -> str:
        from ._notebook import episode_html
        return episode_html(self)

    def __repr__(self) -> str:
        coverage = self.metrics.get("coverage")
        covered = "" if coverage is None else f", covered {100 * coverage:.1f} %"
        return f"<Episode {self.outcome}{covered}>"


def episode_of(core: _core.Episode, folder: Optional[Path] = None) -> Episode:
    return Episode(json_map(core.result), core.trace, Plan(core.plan), core, folder)


_RESULT = {"scenario": str, "robot": str, "site": str, "outcome": str, "events": list,
           "metrics": dict}


def read(folder: PathLike) -> Episode:
    """The episode that `floorproof run` left in a folder: result.json, trace.csv and
    encounters.csv. Throws InputError where they are damaged."""
    folder = Path(folder)
    file = folder / "result.json"
    result = json_object(file, "floorproof run", _RESULT)
    for i, event in enumerate(result["events"]):
        try:
            event_of(event)
        except (KeyError, TypeError, AttributeError) as error:
            raise InputError(f"{file}: events[{i}]: is no event: {error}") from error
    if (folder / "trace.csv").exists():
        trace = trace_columns(folder / "trace.csv")
    else:
        trace = {name: np.empty(0) for name, _ in _core.trace_columns()}
    return Episode(result, trace, folder=folder, encounters=recorded_encounters(folder))
