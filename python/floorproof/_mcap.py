# SPDX-License-Identifier: Apache-2.0
"""An episode as a log that Foxglove, rviz and `ros2 bag` open.

The records of its folder say what was driven. What they do not hold, scans and pictures, comes from
the same scenario driven again, which must come out the same. docs/exports.md lists the topics.
"""
from __future__ import annotations

import heapq
import math
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from . import _core
from . import _topics as topics
from ._core import InputError
from ._files import written_whole
from ._results import Episode, PathLike, read
from ._ros import Ros, full_name, nanoseconds
from ._scenario import Scenario, load

# How ROS says in a log that late listeners get the last message, too (as integers, which every
# release reads).
_LATCHED = """- history: 1
  depth: 1
  reliability: 1
  durability: 1
  deadline: {sec: 9223372036, nsec: 854775807}
  lifespan: {sec: 9223372036, nsec: 854775807}
  liveliness: 1
  liveliness_lease_duration: {sec: 9223372036, nsec: 854775807}
  avoid_ros_namespace_conventions: false
"""


def to_mcap(folder: PathLike, file: Optional[PathLike] = None, *, hz: float = 10,
            frames: bool = True, frame_hz: float = 1, width: int = 640, height: int = 360,
            camera: str = "auto", overwrite: bool = False) -> Path:
    """Writes an episode's folder, as `floorproof run` or `Scenario.run(out=...)` leaves it, as an
    MCAP log of ROS 2 messages: map, plan, driven path, pose, scans, events, pictures. Returns its
    path.

    file: default episode.mcap in the folder. hz: of poses and scans, as far as there are so many.
    frames: pictures as the film has them, `frame_hz` a second, width x height pixels, by `camera`
    (auto, chase, top, side); none of an episode without physics. Times are simulated seconds from
    0.

    No program is run (docs/external-planner.md). Throws InputError where the folder holds no
    episode, where there is no plan but a program's, where its scenario, driven again, comes out
    otherwise (another version drove it, or a file was changed), and where `file` is there already,
    unless `overwrite`.
    """
    for name, value in (("hz", hz), ("frame_hz", frame_hz)):
        if not (value > 0 and math.isfinite(value)):
            raise InputError(f"{name} = {value}: must be > 0")
    ros = Ros()
    folder = Path(folder)
    file = folder / "episode.mcap" if file is None else Path(file)
    episode = read(folder)
    scenario = load(folder / "scenario.resolved.yaml")
    scenario._read.refuse_program()
    with written_whole(file, overwrite) as part:
        again, scans = _driven_again(scenario, episode, folder)
        told = [*topics.floor(ros, scenario), *topics.planned(ros, folder),
                *topics.driven(ros, episode, hz), *topics.sensed(ros, again, scans, hz),
                *topics.failed(ros, episode)]
        if frames:
            told += topics.filmed(ros, again, frame_hz, (width, height), camera)
        _write(ros, part, told, folder, episode)
    return file


def _write(ros: Ros, file: Path, told: Sequence[topics.Topic], folder: Path,
           episode: Episode) -> None:
    from mcap.writer import Writer
    with file.open("wb") as stream:
        writer: Any = Writer(stream)
        writer.start(profile="ros2", library=f"floorproof {_core.__version__}")
        schemas: Dict[str, int] = {}
        streams: List[Iterator[Tuple[int, int, Any]]] = []
        channels: List[int] = []
        for topic in told:
            if topic.kind not in schemas:
                schemas[topic.kind] = writer.register_schema(
                    full_name(topic.kind), "ros2msg", ros.definition(topic.kind).encode())
            channels.append(writer.register_channel(
                topic.name, "cdr", schemas[topic.kind],
                {"offered_qos_profiles": _LATCHED} if topic.latched else {}))
            streams.append(_timed(len(streams), topic.messages))
        for count, (t_ns, which, message) in enumerate(heapq.merge(*streams, key=lambda m: m[:2])):
            writer.add_message(channels[which], t_ns, ros.packed(message), t_ns, count)
        writer.add_metadata("floorproof", {
            "version": _core.__version__, "scenario": str(episode.result["scenario"]),
            "outcome": episode.outcome, "seed": str(episode.result["seed"])})
        for name, kind in (("result.json", "application/json"),
                           ("scenario.resolved.yaml", "application/yaml")):
            writer.add_attachment(0, 0, name, kind, (folder / name).read_bytes())
        writer.finish()


def _timed(which: int, messages: Iterable[topics.Message]) -> Iterator[Tuple[int, int, Any]]:
    for t_s, message in messages:
        yield nanoseconds(t_s), which, message


# --- driven again


def _driven_again(scenario: Scenario, told: Episode,
                  folder: Path) -> Tuple[Episode, List[Dict[str, Any]]]:
    scans: List[Dict[str, Any]] = []

    def look(now: Any) -> None:
        scan = now.scan
        if scan is not None and scan["fresh"]:
            scans.append(scan)

    again = scenario.run(observer=look)
    other = _differs(told, again)
    if other:
        raise InputError(f"{folder}: its scenario, driven again, comes out otherwise than its "
                         f"records say ({other}): another version drove it, or a file was changed")
    return again, scans


def _differs(told: Episode, again: Episode) -> str:
    """In what; empty: in nothing. Versions may differ where nothing else does, and what was drawn
    stands in the resolved scenario as written."""
    for key in sorted({*told.result, *again.result} - {"versions", "drawn"}):
        if told.result.get(key) != again.result.get(key):
            return f"result.json, {key}"
    for name, column in again.trace.items():
        there = told.trace.get(name)
        if there is None or len(there) != len(column):
            return f"trace.csv, {len(column)} rows of {name}"
        # Times stand there to a millisecond, places to a hundredth of a millimetre.
        digits = 1e-3 if name == "t_s" else 1e-5
        if not (there == column if name == "shape"
                else np.allclose(there, column, rtol=1e-6, atol=digits, equal_nan=True)):
            return f"trace.csv, {name}"
    return ""
