# SPDX-License-Identifier: Apache-2.0
"""Messages of ROS 2, made with the definitions that the package rosbags carries.

Frames after REP 103 and 105: `map` is the world, `base_link` the robot's body, `lidar` the scanner.
Times are simulated seconds from the start of the episode.
"""
from __future__ import annotations

import math
from typing import Any, Iterable, List, Sequence, Tuple

import numpy as np

from ._results import Frame, Pose

Point = Sequence[float]  # x, y, or x, y, z
Colour = Tuple[float, float, float, float]


def _packages() -> Any:
    try:
        import mcap.writer  # noqa: F401
        from rosbags import typesys
    except ImportError as error:
        raise ImportError(f"{error.name} is missing: pip install '.[mcap]' in Floorproof's "
                          "folder") from error
    return typesys


def full_name(name: str) -> str:
    return name.replace("/", "/msg/")


def nanoseconds(t_s: float) -> int:
    return round(t_s * 1e9)


def quaternion(roll: float, pitch: float, yaw: float) -> Tuple[float, float, float, float]:
    """x, y, z, w of a turn about z, then the new y, then the new x."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy)


class Ros:
    """Makes messages and their bytes (CDR). All releases from Humble on have these definitions."""

    def __init__(self) -> None:
        typesys = _packages()
        self._store = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)

    def definition(self, name: str) -> str:
        """A message and all that it is made of, as MCAP wants it. The name: `std_msgs/String`."""
        return str(self._store.generate_msgdef(full_name(name), ros_version=2)[0])

    def packed(self, message: Any) -> bytes:
        return bytes(self._store.serialize_cdr(message, message.__msgtype__))

    # --- what messages are made of

    def make(self, name: str, *values: Any) -> Any:
        """A message from its fields in order."""
        return self._store.types[full_name(name)](*values)

    def stamp(self, t_s: float) -> Any:
        return self.make("builtin_interfaces/Time", *divmod(nanoseconds(t_s), 10**9))

    def header(self, t_s: float, frame: str = "map") -> Any:
        return self.make("std_msgs/Header", self.stamp(t_s), frame)

    def vector(self, x: float, y: float, z: float) -> Any:
        return self.make("geometry_msgs/Vector3", float(x), float(y), float(z))

    def point(self, p: Point) -> Any:
        x, y, z = (*p, 0.0)[:3]
        return self.make("geometry_msgs/Point", float(x), float(y), float(z))

    def turn(self, roll: float, pitch: float, yaw: float) -> Any:
        return self.make("geometry_msgs/Quaternion", *quaternion(roll, pitch, yaw))

    def pose(self, x: float, y: float, yaw: float, z: float = 0, roll: float = 0,
             pitch: float = 0) -> Any:
        return self.make("geometry_msgs/Pose", self.point((x, y, z)), self.turn(roll, pitch, yaw))

    def twist(self, vx: float, vy: float, wz: float) -> Any:
        return self.make("geometry_msgs/Twist", self.vector(vx, vy, 0), self.vector(0, 0, wz))

    # --- messages

    def string(self, text: str) -> Any:
        return self.make("std_msgs/String", text)

    def number(self, value: float) -> Any:
        return self.make("std_msgs/Float64", float(value))

    def pose_stamped(self, t_s: float, pose: Any) -> Any:
        return self.make("geometry_msgs/PoseStamped", self.header(t_s), pose)

    def path(self, t_s: float, poses: Iterable[Any]) -> Any:
        return self.make("nav_msgs/Path", self.header(t_s), list(poses))

    def grid(self, t_s: float, frame: Frame, cells: np.ndarray) -> Any:
        """cells [height, width]: 0 free, 1 occupied, 2 unknown; there 0, 100 and -1."""
        info = self.make("nav_msgs/MapMetaData", self.stamp(t_s), frame.cell_m, frame.width,
                         frame.height, self.pose(*frame.origin))
        data = np.array([0, 100, -1], dtype=np.int8)[cells].ravel()
        return self.make("nav_msgs/OccupancyGrid", self.header(t_s), info, data)

    def transforms(self, t_s: float, parent: str, child: str, pose: Any) -> Any:
        p = pose.position
        moved = self.make("geometry_msgs/Transform", self.vector(p.x, p.y, p.z), pose.orientation)
        return self.make("tf2_msgs/TFMessage", [
            self.make("geometry_msgs/TransformStamped", self.header(t_s, parent), child, moved)])

    def marker(self, t_s: float, group: str, number: int, kind: str, *, colour: Colour,
               at: Pose = (0, 0, 0), z_m: float = 0, size_m: Point = (0, 0, 0),
               points: Sequence[Point] = (), text: str = "", frame: str = "map",
               follows: bool = False) -> Any:
        """kind as in visualization_msgs/Marker: LINE_STRIP, CYLINDER, TEXT_VIEW_FACING. follows:
        the marker goes with its frame."""
        types = self._store.types["visualization_msgs/msg/Marker"]
        no_bytes = np.zeros(0, np.uint8)
        none = self.make("sensor_msgs/CompressedImage", self.header(0, ""), "", no_bytes)
        x, y, yaw = at
        return self.make(
            "visualization_msgs/Marker", self.header(t_s, frame), group, number,
            getattr(types, kind), types.ADD, self.pose(x, y, yaw, z_m), self.vector(*size_m),
            self.make("std_msgs/ColorRGBA", *colour),
            self.make("builtin_interfaces/Duration", 0, 0), follows,
            [self.point(p) for p in points], [], "", none, [], text, "",
            self.make("visualization_msgs/MeshFile", "", no_bytes), False)

    def outline(self, t_s: float, group: str, number: int, corners: Sequence[Point], z_m: float,
                colour: Colour, frame: str = "map", follows: bool = False) -> Any:
        """A closed line, 2 cm wide."""
        points: List[Point] = [(p[0], p[1], z_m) for p in (*corners, corners[0])]
        return self.marker(t_s, group, number, "LINE_STRIP", colour=colour, size_m=(0.02, 0, 0),
                           points=points, frame=frame, follows=follows)

    def markers(self, markers: Iterable[Any]) -> Any:
        return self.make("visualization_msgs/MarkerArray", list(markers))

    def log(self, t_s: float, level: str, text: str) -> Any:
        """level as in rcl_interfaces/Log: INFO, WARN, ERROR."""
        levels = {"INFO": 20, "WARN": 30, "ERROR": 40}
        return self.make("rcl_interfaces/Log", self.stamp(t_s), levels[level], "floorproof", text,
                         "", "", 0)

    def scan(self, scan: Any) -> Any:
        """scan as an observer sees it. Infinite: nothing came back (REP 117)."""
        angle = np.unwrap(scan["angle_rad"])  # even steps, all the way round
        step = (angle[-1] - angle[0]) / (len(angle) - 1) if len(angle) > 1 else 0.0
        return self.make("sensor_msgs/LaserScan", self.header(scan["t_s"], "lidar"),
                         float(angle[0]), float(angle[-1]), float(step), 0.0, 0.0, scan["least_m"],
                         scan["most_m"], scan["range_m"].astype(np.float32),
                         np.zeros(0, np.float32))

    def picture(self, t_s: float, kind: str, data: bytes) -> Any:
        return self.make("sensor_msgs/CompressedImage", self.header(t_s), kind,
                         np.frombuffer(data, np.uint8))
