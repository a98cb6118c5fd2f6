# SPDX-License-Identifier: Apache-2.0
"""What an episode's log says, topic by topic (docs/exports.md lists them)."""
from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Sequence, Tuple

import numpy as np

from . import _core
from ._core import InputError
from ._png import png_bytes
from ._recorded import plan_columns
from ._results import Episode
from ._ros import Colour, Ros
from ._scenario import Scenario

Message = Tuple[float, Any]  # its time (s), itself

_PATH_STEP_M = 0.05  # of the driven path's points
_PATHS = 50  # how often the driven path is told anew, at most
_PICTURES = 32  # drawn in one go, and so in memory at once
_KNOWN: Colour = (0.13, 0.47, 0.71, 1)
_UNKNOWN: Colour = (0.90, 0.45, 0.0, 1)  # to the planner
_FAILURE: Colour = (0.0, 0.0, 0.0, 1)
_BODY: Colour = (0.2, 0.2, 0.2, 1)
_TOOL: Colour = (0.0, 0.6, 0.5, 1)


@dataclass(frozen=True)
class Topic:
    name: str
    kind: str
    messages: Iterable[Message]  # ascending
    latched: bool = False


def floor(ros: Ros, scenario: Scenario) -> Iterator[Topic]:
    """The map, its hazards, the robot's outlines."""
    site = scenario.site
    yield Topic("/map", "nav_msgs/OccupancyGrid", [(0, ros.grid(0, site.frame, site.occupancy))],
                latched=True)
    marks: List[Any] = []
    for hazard in site.hazards:
        colour = _KNOWN if hazard.known else _UNKNOWN
        z_m = max(hazard.height_m, 0.0) + 0.01
        for polygon in hazard.polygons_m:
            marks.append(ros.outline(0, "hazards", len(marks), polygon, z_m, colour))
        if hazard.polygons_m:
            x_m, y_m = np.mean(hazard.polygons_m[0], axis=0)
            text = f"{hazard.id} ({hazard.type}, {1000 * hazard.height_m:.0f} mm)"
            marks.append(ros.marker(0, "hazards", len(marks), "TEXT_VIEW_FACING", colour=colour,
                                    at=(x_m, y_m, 0), z_m=z_m + 0.1, size_m=(0, 0, 0.12),
                                    text=text if hazard.known else text + ", not on the map"))
    yield Topic("/hazards", "visualization_msgs/MarkerArray", [(0, ros.markers(marks))],
                latched=True)
    body = [ros.outline(0, "robot", i, _corners(scenario.robot[part]), 0.02, colour,
                        frame="base_link", follows=True)
            for i, (part, colour) in enumerate((("clear", _BODY), ("tool", _TOOL)))]
    yield Topic("/robot", "visualization_msgs/MarkerArray", [(0, ros.markers(body))], latched=True)


def _corners(shape: Mapping[str, Any]) -> List[Sequence[float]]:
    if "polygon_m" in shape:
        return list(shape["polygon_m"])
    r, turns = shape["circle_radius_m"], np.linspace(0, 2 * math.pi, 36, endpoint=False)
    return [(r * math.cos(a), r * math.sin(a)) for a in turns]


def planned(ros: Ros, folder: Path) -> Iterator[Topic]:
    """Of plan.csv; none where there is none."""
    file = folder / "plan.csv"
    if not file.exists():  # it is made on the way, or there is none
        return
    columns = plan_columns(file)
    if "y_m" not in columns:
        raise InputError(f"{file}:1: y_m: is missing")
    places = list(zip(columns["x_m"].tolist(), columns["y_m"].tolist()))
    yaws = columns.get("yaw_rad", np.full(len(places), math.nan)).tolist()
    poses = []
    for i, ((x_m, y_m), yaw) in enumerate(zip(places, yaws)):
        # Where the plan leaves the yaw open, along the way.
        a, b = (places[i], places[i + 1]) if i + 1 < len(places) else (places[i - 1], places[i])
        poses.append(ros.pose_stamped(0, ros.pose(
            x_m, y_m, math.atan2(b[1] - a[1], b[0] - a[0]) if math.isnan(yaw) else yaw)))
    yield Topic("/plan", "nav_msgs/Path", [(0, ros.path(0, poses))], latched=True)


def _due(t_s: Iterable[float], hz: float) -> Iterator[int]:
    """Which of ascending times come first at or after each multiple of 1 / hz."""
    due = -math.inf
    for i, now_s in enumerate(t_s):
        slot = math.floor(now_s * hz + 1e-6)
        if slot >= due:
            yield i
            due = slot + 1


def driven(ros: Ros, episode: Episode, hz: float) -> Iterator[Topic]:
    """Of the trace: where the robot was, thought to be, what it was told to do."""
    t = episode.trace
    times = [float(v) for v in t["t_s"]]
    if not times:
        return
    rows = list(_due(times, hz))
    if rows[-1] != len(times) - 1:
        rows.append(len(times) - 1)

    def of(names: str, i: int) -> List[float]:
        return [float(t[name][i]) for name in names.split()]

    def pose(i: int) -> Any:
        return ros.pose(*of("x_m y_m yaw_rad z_m roll_rad pitch_rad", i))

    def odometry(i: int) -> Any:
        unknown = np.zeros(36)
        return ros.make("nav_msgs/Odometry", ros.header(times[i]), "base_link",
                        ros.make("geometry_msgs/PoseWithCovariance", pose(i), unknown),
                        ros.make("geometry_msgs/TwistWithCovariance",
                                 ros.twist(*of("vx_mps vy_mps wz_radps", i)), unknown))

    def estimate(i: int) -> Any:
        variance = float(t["est_position_std_m"][i]) ** 2 / 2  # of x and y, which share it
        covariance = np.zeros(36)
        covariance[0] = covariance[7] = variance
        believed = ros.make("geometry_msgs/PoseWithCovariance",
                            ros.pose(*of("est_x_m est_y_m est_yaw_rad", i)), covariance)
        return ros.make("geometry_msgs/PoseWithCovarianceStamped", ros.header(times[i]), believed)

    for name, kind, message in (
            ("/pose", "geometry_msgs/PoseStamped",
             lambda i: ros.pose_stamped(times[i], pose(i))),
            ("/tf", "tf2_msgs/TFMessage",
             lambda i: ros.transforms(times[i], "map", "base_link", pose(i))),
            ("/odometry", "nav_msgs/Odometry", odometry),
            ("/estimate", "geometry_msgs/PoseWithCovarianceStamped", estimate),
            ("/command", "geometry_msgs/TwistStamped",
             lambda i: ros.make("geometry_msgs/TwistStamped", ros.header(times[i], "base_link"),
                                ros.twist(*of("cmd_vx_mps cmd_vy_mps cmd_wz_radps", i)))),
            *((f"/{column}", "std_msgs/Float64", lambda i, c=column: ros.number(t[c][i]))
              for column in ("coverage", "cross_track_m", "power_w"))):
        yield Topic(name, kind, _at(times, rows, message))
    yield Topic("/driven", "nav_msgs/Path", _paths(ros, times, rows, pose), latched=True)


def _at(times: Sequence[float], rows: Sequence[int],
        message: Callable[[int], Any]) -> Iterator[Message]:
    for i in rows:
        yield times[i], message(i)


def _paths(ros: Ros, times: Sequence[float], rows: Sequence[int], pose: Any) -> Iterator[Message]:
    """The way so far, again and again; the last to the end."""
    poses: List[Any] = []
    every, told = max(1, math.ceil(len(rows) / _PATHS)), 0
    last = None
    for n, i in enumerate(rows):
        at = pose(i)
        p = at.position
        end = n == len(rows) - 1
        if last is None or end or math.hypot(p.x - last.x, p.y - last.y) >= _PATH_STEP_M:
            poses.append(ros.pose_stamped(times[i], at))
            last = p
        if end or n % every == 0 and len(poses) > told:
            told = len(poses)
            yield times[i], ros.path(times[i], poses)


def sensed(ros: Ros, again: Episode, scans: Sequence[Dict[str, Any]],
           hz: float) -> Iterator[Topic]:
    """Scans, and the map that the robot drew."""
    if scans:
        x_m, y_m, yaw_rad, height_m = scans[0]["mount"]
        mount = ros.transforms(0, "base_link", "lidar", ros.pose(x_m, y_m, yaw_rad, height_m))
        yield Topic("/tf_static", "tf2_msgs/TFMessage", [(0, mount)], latched=True)
        chosen = _due((scan["t_s"] for scan in scans), hz)
        yield Topic("/scan", "sensor_msgs/LaserScan",
                     ((scans[i]["t_s"], ros.scan(scans[i])) for i in chosen))
    if "known" in again.maps:
        end_s = float(again.trace["t_s"][-1])
        frame = again.maps["known_frame"]
        yield Topic("/known_map", "nav_msgs/OccupancyGrid",
                     [(end_s, ros.grid(end_s, frame, again.maps["known"]))], latched=True)


def failed(ros: Ros, episode: Episode) -> Iterator[Topic]:
    """Failures, alarms and the outcome."""
    events = [e.evidence for e in episode.events]
    yield Topic("/events", "std_msgs/String",
                 [(e["t_s"], ros.string(json.dumps(e))) for e in events])
    marks: List[Message] = []
    for i, e in enumerate(events):
        at = (e["x_m"], e["y_m"], 0.0)
        marks.append((e["t_s"], ros.markers([
            ros.marker(e["t_s"], "failures", 2 * i, "CYLINDER", colour=_FAILURE, at=at,
                       z_m=0.25, size_m=(0.1, 0.1, 0.5)),
            ros.marker(e["t_s"], "failures", 2 * i + 1, "TEXT_VIEW_FACING", colour=_FAILURE,
                       at=at, z_m=0.6, size_m=(0, 0, 0.12), text=f"{i + 1} {e['mode']}")])))
    yield Topic("/events/markers", "visualization_msgs/MarkerArray", marks)
    end_s = float(episode.trace["t_s"][-1]) if len(episode.trace["t_s"]) else 0.0
    ended = episode.outcome + (f": {episode.message}" if episode.message else "")
    lines = [(e["t_s"], "ERROR", f"{e['mode']}: {e['text']}") for e in events]
    lines += [(a["t_s"], "WARN", ", ".join(filter(None, [f"alarm of {a['monitor']}", a["wheel"]])))
              for a in episode.result.get("alarms", [])]
    lines.append((max([end_s, *(t_s for t_s, _, _ in lines)]),
                  "INFO" if episode.outcome == "success" else "ERROR", ended))
    lines.sort(key=lambda line: line[0])
    yield Topic("/rosout", "rcl_interfaces/Log",
                 [(t_s, ros.log(t_s, level, text)) for t_s, level, text in lines])


def filmed(ros: Ros, again: Episode, hz: float, size: Tuple[int, int],
           camera: str) -> Iterator[Topic]:
    """Pictures as the film has them, where there was physics."""
    episode = again._core
    if episode is None or episode.qpos is None:
        return
    times = [float(v) for v in again.trace["t_s"]]
    chosen = [times[i] for i in _due(times, hz)]

    def pictures() -> Iterator[Message]:
        for first in range(0, len(chosen), _PICTURES):
            some = chosen[first:first + _PICTURES]
            for t_s, picture in zip(some, _core.frames(episode, some, *size, camera)):
                yield t_s, ros.picture(t_s, "png", png_bytes(picture))

    yield Topic("/camera/image/compressed", "sensor_msgs/CompressedImage", pictures())
