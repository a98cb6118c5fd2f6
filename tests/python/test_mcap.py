# SPDX-License-Identifier: Apache-2.0
"""The log of an episode, read by packages that did not write it: mcap-ros2-support and the reader
of rosbags."""
from __future__ import annotations

import csv
import json
import math
import shutil
import struct
import sys
import zlib
from importlib.metadata import version
from pathlib import Path
from typing import Any, Dict, List

import numpy as np
import pytest

import floorproof

pytest.importorskip("mcap", reason="pip install '.[mcap]'")
typesys = pytest.importorskip("rosbags.typesys", reason="pip install '.[mcap]'")
reader = pytest.importorskip("mcap_ros2.reader", reason="pip install mcap-ros2-support")

HZ = 10

# A pane of glass on no map, right across the way.
ROOM: Dict[str, Any] = {
    "scenario": 1, "name": "log", "robot": "beluga", "estimator": "mcl", "mapper": {},
    "time_limit_s": 16, "on_failure": "ignore",
    "site": {"site": 1, "name": "room",
             "grid": {"cell_m": 0.5, "rows": "########\n#......#\n#...?..#\n#......#\n########\n"},
             "hazards": [{"type": "glass", "id": "pane", "line_m": [[2.2, 0.5], [2.2, 1.6]],
                          "height_m": 1.0, "known": False},
                         {"type": "step", "id": "sill", "height_m": 0.004,
                          "polygon_m": [[2.8, 1.2], [3.0, 1.2], [3.0, 1.4], [2.8, 1.4]]}]},
    "start": {"x_m": 1.0, "y_m": 1.0},
}


class Log:
    """All messages by topic."""

    def __init__(self, file: Path) -> None:
        self.times: List[int] = []
        self.topics: Dict[str, List[Any]] = {}
        for message in reader.read_ros2_messages(str(file)):
            self.times.append(message.log_time_ns)
            self.topics.setdefault(message.channel.topic, []).append(message)

    def messages(self, topic: str) -> List[Any]:
        return [m.ros_msg for m in self.topics.get(topic, [])]

    def only(self, topic: str) -> Any:
        one, = self.messages(topic)
        return one


def seconds(stamp: Any) -> float:
    return stamp.sec + 1e-9 * stamp.nanosec


def yaw_of(q: Any) -> float:
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


@pytest.fixture(scope="module")
def scenario() -> floorproof.Scenario:
    return floorproof.load(ROOM).with_plan([[1, 1], [2.4, 1], [2.4, 1.6]])


@pytest.fixture(scope="module")
def folder(scenario: floorproof.Scenario, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("mcap") / "run"
    scenario.run(out=out)
    floorproof.to_mcap(out, hz=HZ, frames=False)
    return out


@pytest.fixture(scope="module")
def log(folder: Path) -> Log:
    return Log(folder / "episode.mcap")


@pytest.fixture(scope="module")
def trace(folder: Path) -> Dict[str, np.ndarray]:
    columns = dict(floorproof.read(folder).trace)
    del columns["shape"]
    return columns


def test_times_ascend_and_every_message_can_be_read(log: Log, trace: Dict[str, np.ndarray]) -> None:
    assert log.times == sorted(log.times)
    assert log.times[0] == 0
    assert log.times[-1] == round(trace["t_s"][-1] * 1e9)
    assert set(log.topics) == {
        "/map", "/hazards", "/robot", "/plan", "/pose", "/tf", "/tf_static", "/odometry",
        "/estimate", "/command", "/coverage", "/cross_track_m", "/power_w", "/driven", "/scan",
        "/known_map", "/events", "/events/markers", "/rosout"}


def test_the_map_is_the_sites(log: Log, scenario: floorproof.Scenario) -> None:
    told, site = log.only("/map"), scenario.site
    assert (told.info.width, told.info.height) == (site.frame.width, site.frame.height)
    assert told.info.resolution == pytest.approx(site.frame.cell_m)
    cells = np.array(told.data).reshape(told.info.height, told.info.width)
    for here, there in ((0, 0), (1, 100), (2, -1)):
        assert np.array_equal(site.occupancy == here, cells == there)
        assert (site.occupancy == here).any()
    assert told.header.frame_id == "map"
    assert yaw_of(told.info.origin.orientation) == pytest.approx(site.frame.origin[2])


def test_a_turned_map_keeps_its_origin(tmp_path: Path) -> None:
    inner = [0] + [254] * 4 + [0]
    (tmp_path / "map.pgm").write_bytes(b"P5 6 5 255\n" + bytes([0] * 6 + 3 * inner + [0] * 6))
    (tmp_path / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.5\norigin: [4.0, -2.0, 0.7]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n", encoding="utf-8")
    frame = floorproof.load_site({"site": 1, "map": "map.yaml"}, folder=tmp_path).frame
    start = dict(zip(("x_m", "y_m"), frame.centre(1, 1)))
    floorproof.load({"scenario": 1, "robot": "beluga", "site": {"site": 1, "map": "map.yaml"},
                     "start": start}, folder=tmp_path).with_plan(
        [frame.centre(1, 1), frame.centre(1, 2)]).run(out=tmp_path / "run")
    log = Log(floorproof.to_mcap(tmp_path / "run", frames=False))
    origin = log.only("/map").info.origin
    assert (origin.position.x, origin.position.y) == (4.0, -2.0)
    assert yaw_of(origin.orientation) == pytest.approx(0.7)
    first = log.messages("/pose")[0].pose.position
    assert (first.x, first.y) == pytest.approx(frame.centre(1, 1), abs=1e-4)


def test_the_plan_is_plan_csv(log: Log, folder: Path) -> None:
    with (folder / "plan.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    poses = log.only("/plan").poses
    assert [(p.pose.position.x, p.pose.position.y) for p in poses] == [
        (float(r["x_m"]), float(r["y_m"])) for r in rows]
    # Nobody said the yaw: along the way, the last as before it.
    assert [yaw_of(p.pose.orientation) for p in poses] == pytest.approx(
        [0, math.pi / 2, math.pi / 2])


def test_poses_are_the_traces(log: Log, trace: Dict[str, np.ndarray]) -> None:
    poses = log.messages("/pose")
    rows = [int(np.flatnonzero(np.isclose(trace["t_s"], seconds(p.header.stamp), atol=1e-6))[0])
            for p in poses]
    assert rows[0] == 0 and rows[-1] == len(trace["t_s"]) - 1
    assert np.diff(trace["t_s"][rows[:-1]]) == pytest.approx(1 / HZ, abs=1e-3)
    odometry = log.messages("/odometry")
    for i, pose, tf, odom, estimate, command in zip(
            rows, poses, log.messages("/tf"), odometry, log.messages("/estimate"),
            log.messages("/command")):
        truth = {name: column[i] for name, column in trace.items()}
        for p, q in ((pose.pose.position, pose.pose.orientation),
                     (tf.transforms[0].transform.translation, tf.transforms[0].transform.rotation),
                     (odom.pose.pose.position, odom.pose.pose.orientation)):
            assert (p.x, p.y, p.z) == (truth["x_m"], truth["y_m"], truth["z_m"])
            assert yaw_of(q) == pytest.approx(truth["yaw_rad"])
            assert q.x**2 + q.y**2 + q.z**2 + q.w**2 == pytest.approx(1)
        assert (tf.transforms[0].header.frame_id, tf.transforms[0].child_frame_id) == (
            "map", "base_link")
        assert odom.twist.twist.linear.x == truth["vx_mps"]
        assert odom.twist.twist.angular.z == truth["wz_radps"]
        believed = estimate.pose.pose
        assert (believed.position.x, believed.position.y) == (truth["est_x_m"], truth["est_y_m"])
        spread = estimate.pose.covariance[0] + estimate.pose.covariance[7]
        assert spread == pytest.approx(truth["est_position_std_m"] ** 2)
        assert command.twist.linear.x == truth["cmd_vx_mps"]
    assert len(poses) == len(odometry) == len(log.messages("/estimate")) == len(log.messages("/tf"))
    for name in ("coverage", "cross_track_m", "power_w"):
        assert [m.data for m in log.messages(f"/{name}")] == [trace[name][i] for i in rows]


def test_a_tilt_is_rolled_and_pitched_as_the_trace_says() -> None:
    from floorproof._ros import quaternion
    roll, pitch, yaw = 0.3, -0.2, 2.5
    x, y, z, w = quaternion(roll, pitch, yaw)
    turned = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                       [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                       [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    c, s = math.cos, math.sin
    about_z = np.array([[c(yaw), -s(yaw), 0], [s(yaw), c(yaw), 0], [0, 0, 1]])
    about_y = np.array([[c(pitch), 0, s(pitch)], [0, 1, 0], [-s(pitch), 0, c(pitch)]])
    about_x = np.array([[1, 0, 0], [0, c(roll), -s(roll)], [0, s(roll), c(roll)]])
    assert np.allclose(turned, about_z @ about_y @ about_x)


def test_the_driven_path_grows_to_the_end(log: Log, trace: Dict[str, np.ndarray]) -> None:
    paths = log.messages("/driven")
    sizes = [len(p.poses) for p in paths]
    assert len(paths) <= 52 and sizes == sorted(sizes)
    for path in paths:
        assert seconds(path.poses[-1].header.stamp) <= seconds(path.header.stamp)
    last = paths[-1].poses[-1].pose.position
    assert (last.x, last.y) == (trace["x_m"][-1], trace["y_m"][-1])


def test_scans_are_the_observers(log: Log, scenario: floorproof.Scenario) -> None:
    seen: List[Dict[str, Any]] = []

    def look(now: Any) -> None:
        if now.scan is not None and now.scan["fresh"]:
            seen.append(now.scan)

    scenario.run(observer=look)
    told = log.messages("/scan")
    assert len(told) == len(seen) > 100
    for scan, truth in zip(told, seen):
        assert seconds(scan.header.stamp) == pytest.approx(truth["t_s"], abs=1e-8)
        ranges = truth["range_m"].astype(np.float32)
        assert np.array_equal(np.array(scan.ranges, np.float32), ranges)
        beams = scan.angle_min + scan.angle_increment * np.arange(len(scan.ranges))
        assert np.allclose(np.exp(1j * beams), np.exp(1j * truth["angle_rad"]), atol=1e-5)
        assert scan.angle_min < scan.angle_max and scan.angle_increment > 0
    mount = log.only("/tf_static").transforms[0]
    assert (mount.header.frame_id, mount.child_frame_id) == ("base_link", "lidar")
    x_m, y_m, yaw, height_m = seen[0]["mount"]
    p = mount.transform.translation
    assert (p.x, p.y, p.z) == (x_m, y_m, height_m)
    assert yaw_of(mount.transform.rotation) == pytest.approx(yaw)


def test_scans_end_on_the_walls(log: Log) -> None:
    """Told by the log alone: beams, the scanner's place, the robot's, the map."""
    def planar(pose: Any) -> np.ndarray:
        yaw = yaw_of(pose.rotation)
        c, s = math.cos(yaw), math.sin(yaw)
        return np.array([[c, -s, pose.translation.x], [s, c, pose.translation.y], [0, 0, 1]])

    told = log.only("/map")
    cells = np.array(told.data).reshape(told.info.height, told.info.width)
    mount = planar(log.only("/tf_static").transforms[0].transform)
    robot = {m.log_time_ns: planar(m.ros_msg.transforms[0].transform) for m in log.topics["/tf"]}
    ends, headings = [], []
    for message in log.topics["/scan"]:
        scan, at = message.ros_msg, robot.get(message.log_time_ns)
        if at is None:
            continue
        seen = np.flatnonzero(np.isfinite(scan.ranges))
        r, beams = np.array(scan.ranges)[seen], scan.angle_min + scan.angle_increment * seen
        points = np.stack([r * np.cos(beams), r * np.sin(beams), np.ones_like(r)])
        ends.append((at @ mount @ points)[:2])
        headings.append(math.atan2(at[1, 0], at[0, 0]))
    x, y = np.concatenate(ends, axis=1)
    walls = np.stack([cells[((y + dy) / 0.5).astype(int).clip(0, 4),
                            ((x + dx) / 0.5).astype(int).clip(0, 7)] != 0
                      for dx in (-0.06, 0.06) for dy in (-0.06, 0.06)]).any(axis=0)
    pane = (abs(x - 2.2) < 0.06) & (y < 1.66)
    assert len(ends) > 100 and np.ptp(headings) > 0.5
    assert np.mean(walls | pane) > 0.98


def test_what_the_robot_drew_is_at_the_end(log: Log, scenario: floorproof.Scenario) -> None:
    episode = scenario.run()
    told = log.only("/known_map")
    cells = np.array(told.data).reshape(told.info.height, told.info.width)
    assert np.array_equal(cells == 100, episode.maps["known"] == 1)
    assert np.array_equal(cells == -1, episode.maps["known"] == 2)
    assert log.topics["/known_map"][0].log_time_ns == log.times[-1]


def test_events_are_the_results(log: Log, folder: Path) -> None:
    result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
    assert len(result["events"]) >= 2
    assert [json.loads(m.data) for m in log.messages("/events")] == result["events"]
    for event, message in zip(result["events"], log.topics["/events/markers"]):
        assert message.log_time_ns == round(event["t_s"] * 1e9)
        disc, words = message.ros_msg.markers
        assert (disc.pose.position.x, disc.pose.position.y) == (event["x_m"], event["y_m"])
        assert event["mode"] in words.text
    ids = [m.id for array in log.messages("/events/markers") for m in array.markers]
    assert len(ids) == len(set(ids))  # one does not replace another
    lines = log.messages("/rosout")
    assert [m.level for m in lines] == [40] * (len(result["events"]) + 1)
    assert result["events"][0]["text"] in lines[0].msg
    assert lines[-1].msg.startswith("failure")


def test_hazards_are_outlined(log: Log, scenario: floorproof.Scenario) -> None:
    marks = log.only("/hazards").markers
    outlines = [m for m in marks if m.type == 4]
    assert len(outlines) == sum(len(h.polygons_m) for h in scenario.site.hazards)
    pane = scenario.site.hazards[0]
    assert [[p.x, p.y] for p in outlines[0].points] == [*pane.polygons_m[0], pane.polygons_m[0][0]]
    assert [m.text for m in marks if m.type == 9] == [
        "pane (glass, 1000 mm), not on the map", "sill (step, 4 mm)"]
    body = log.only("/robot").markers
    assert all(m.header.frame_id == "base_link" and m.frame_locked for m in body)


def test_the_other_reader_reads_it_too(log: Log, folder: Path) -> None:
    """rosbags goes by what rosbag2 wants of a file: profile, types, encodings, QoS."""
    if tuple(map(int, version("rosbags").split(".")[:2])) < (0, 11):
        pytest.skip("rosbags before 0.11 reads folders alone")
    from rosbags.highlevel import AnyReader
    with AnyReader([folder / "episode.mcap"]) as bag:
        assert {c.topic: c.msgcount for c in bag.connections} == {
            topic: len(messages) for topic, messages in log.topics.items()}
        for connection, _, data in bag.messages():
            assert bag.deserialize(data, connection.msgtype).__msgtype__ == connection.msgtype
        late = {c.topic for c in bag.connections if c.ext.offered_qos_profiles}
        profile = next(c.ext.offered_qos_profiles[0] for c in bag.connections if c.topic == "/map")
    assert profile.durability.name == "TRANSIENT_LOCAL"
    assert late == {"/map", "/hazards", "/robot", "/plan", "/driven", "/tf_static", "/known_map"}
    from mcap.reader import make_reader
    with (folder / "episode.mcap").open("rb") as stream:
        whole = make_reader(stream, validate_crcs=True)
        assert whole.get_header().profile == "ros2"
        summary = whole.get_summary()
        assert {s.encoding for s in summary.schemas.values()} == {"ros2msg"}
        assert {c.message_encoding for c in summary.channels.values()} == {"cdr"}
        kept = {a.name: a.data for a in whole.iter_attachments()}
    assert kept["result.json"] == (folder / "result.json").read_bytes()


def test_definitions_are_those_of_all_releases_since_humble() -> None:
    """Fields, on which the bytes depend; later releases have more constants."""
    def fields(store: Any, name: str) -> List[str]:
        lines = store.generate_msgdef(name, ros_version=2)[0].splitlines()
        return [line for line in lines if "=" not in line.replace("=====", "")]

    stores = [typesys.get_typestore(s) for s in typesys.Stores
              if s.value in ("ros2_humble", "ros2_iron", "ros2_jazzy", "ros2_kilted")]
    assert len(stores) >= 2
    for name in ("nav_msgs/msg/OccupancyGrid", "nav_msgs/msg/Path", "nav_msgs/msg/Odometry",
                 "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/CompressedImage",
                 "visualization_msgs/msg/MarkerArray", "rcl_interfaces/msg/Log",
                 "tf2_msgs/msg/TFMessage", "geometry_msgs/msg/PoseWithCovarianceStamped"):
        assert all(fields(store, name) == fields(stores[0], name) for store in stores), name


def pixels(png: bytes) -> np.ndarray:
    """A PNG as an array, by a reader of its own: colour type 2, rows that differ from the one
    above."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, size = 8, b"", (0, 0)
    while at < len(png):
        n, = struct.unpack(">I", png[at:at + 4])
        name, body = png[at + 4:at + 8], png[at + 8:at + 8 + n]
        assert struct.unpack(">I", png[at + 8 + n:at + 12 + n])[0] == zlib.crc32(name + body)
        if name == b"IHDR":
            size = struct.unpack(">II", body[:8])
            assert body[8:] == bytes([8, 2, 0, 0, 0])
        if name == b"IDAT":
            data += body
        at += 12 + n
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(size[1], 1 + 3 * size[0])
    assert (rows[:, 0] == 2).all()
    return np.cumsum(rows[:, 1:], axis=0, dtype=np.uint8).reshape(size[1], size[0], 3)


def test_pictures_are_those_of_the_film(scenario: floorproof.Scenario, tmp_path: Path) -> None:
    short = scenario.with_(time_limit_s=3)
    episode = short.run()
    try:
        episode.frame(0, 160, 90)
    except floorproof.InternalError as error:
        pytest.skip(f"no GL: {error}")
    short.run(out=tmp_path / "run")
    log = Log(floorproof.to_mcap(tmp_path / "run", frame_hz=1, width=160, height=90))
    told = log.messages("/camera/image/compressed")
    assert [seconds(m.header.stamp) for m in told] == pytest.approx([0, 1, 2, 3], abs=0.02)
    assert {m.format for m in told} == {"png"}
    times = episode.trace["t_s"]
    t_s = times[np.argmin(np.abs(times - seconds(told[2].header.stamp)))]
    assert np.array_equal(pixels(bytes(told[2].data)), episode.frame(t_s, 160, 90))


def test_a_drive_over_cells_has_neither_scans_nor_pictures(tmp_path: Path) -> None:
    floorproof.load({"scenario": 1, "robot": "beluga", "plan": "rolling_window", "drive": "cells",
                     "site": {"site": 1, "generate": {"kind": "room", "cells": [8, 8]}}}).run(
        out=tmp_path / "run")
    log = Log(floorproof.to_mcap(tmp_path / "run"))
    assert not {"/scan", "/tf_static", "/plan", "/camera/image/compressed"} & set(log.topics)
    assert len(log.messages("/pose")) == len(floorproof.read(tmp_path / "run").trace["t_s"])


def test_the_same_folder_gives_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    again = floorproof.to_mcap(folder, tmp_path / "again.mcap", hz=HZ, frames=False)
    assert again.read_bytes() == (folder / "episode.mcap").read_bytes()
    assert [f.name for f in tmp_path.iterdir()] == ["again.mcap"]


def test_what_comes_out_otherwise_is_refused(folder: Path, tmp_path: Path) -> None:
    changed = tmp_path / "run"
    shutil.copytree(folder, changed)
    (changed / "episode.mcap").unlink()
    text = (changed / "scenario.resolved.yaml").read_text(encoding="utf-8")
    (changed / "scenario.resolved.yaml").write_text(
        text.replace("time_limit_s: 16", "time_limit_s: 12"), encoding="utf-8")
    with pytest.raises(floorproof.InputError, match=r"comes out otherwise.*result.json") as error:
        floorproof.to_mcap(changed, frames=False)
    assert "\n" not in str(error.value)
    (changed / "scenario.resolved.yaml").write_text(text, encoding="utf-8")
    rows = (changed / "trace.csv").read_text(encoding="utf-8").splitlines()
    (changed / "trace.csv").write_text("\n".join(rows[:-5]) + "\n", encoding="utf-8")
    with pytest.raises(floorproof.InputError, match=r"comes out otherwise.*trace.csv"):
        floorproof.to_mcap(changed, frames=False)
    assert not [f for f in changed.iterdir() if f.suffix in (".mcap", ".part")]


def test_no_program_is_run_that_came_in_a_folder(tmp_path: Path) -> None:
    program = tmp_path / "plan.sh"
    program.write_text("#!/bin/sh\necho asked >> asked\n[ -e can ] || exit 1\n"
                       "printf 'x_m,y_m\\n1,1\\n1.4,1\\n' > \"$1\"/plan.csv\n", encoding="utf-8")
    program.chmod(0o755)
    asked = tmp_path / "asked"
    scenario = floorproof.load({**ROOM, "plan": {"command": ["./plan.sh"]}}, folder=tmp_path)
    with pytest.warns(UserWarning, match="runs a program"):
        assert scenario.run(out=tmp_path / "without").outcome == "not_planned"
        (tmp_path / "can").touch()
        scenario.run(out=tmp_path / "with")
    assert asked.exists()
    asked.unlink()
    with pytest.raises(floorproof.InputError, match=r"resolved.yaml:\d+: plan.command .*no plan"):
        floorproof.to_mcap(tmp_path / "without", frames=False)
    assert not (tmp_path / "without" / "episode.mcap").exists()
    log = Log(floorproof.to_mcap(tmp_path / "with", frames=False))
    assert len(log.only("/plan").poses) > 1
    assert not asked.exists()


def test_bad_calls_are_refused_before_anything_is_driven(folder: Path, tmp_path: Path,
                                                         monkeypatch: pytest.MonkeyPatch) -> None:
    before = (folder / "episode.mcap").read_bytes()
    monkeypatch.setattr(floorproof.Scenario, "run", lambda *_, **__: pytest.fail("was driven"))
    with pytest.raises(floorproof.InputError, match="is there already; overwrite=True"):
        floorproof.to_mcap(folder)
    assert (folder / "episode.mcap").read_bytes() == before
    for name in ("hz", "frame_hz"):
        for value in (0, -1, math.nan, math.inf):
            with pytest.raises(floorproof.InputError, match=f"^{name} = .*must be > 0"):
                floorproof.to_mcap(folder, tmp_path / "x.mcap", **{name: value})
    with pytest.raises(floorproof.InputError, match="result.json"):
        floorproof.to_mcap(tmp_path)
    with pytest.raises(floorproof.InputError, match="cannot be written"):
        floorproof.to_mcap(folder, tmp_path / "nowhere" / "x.mcap")
    (tmp_path / "link.mcap").symlink_to(folder / "episode.mcap")
    with pytest.raises(floorproof.InputError, match="is no plain file"):
        floorproof.to_mcap(folder, tmp_path / "link.mcap", overwrite=True)
    monkeypatch.setitem(sys.modules, "rosbags", None)
    with pytest.raises(ImportError, match=r"pip install '\.\[mcap\]'"):
        floorproof.to_mcap(folder, tmp_path / "x.mcap")
