# SPDX-License-Identifier: Apache-2.0
"""The hazards that a robot met: of an episode, of a folder, of a campaign."""
from __future__ import annotations

import csv
import math
import shutil
import sqlite3
from pathlib import Path
from typing import Any, Callable, Dict, List

import numpy as np
import pytest

import floorproof

CABLE = {"type": "cable_cover", "id": "=cable \\ é", "height_m": 0.012,
         "width_m": 0.08, "top_width_m": 0.03, "line_m": [[2.2, 0.5], [2.2, 2.0]]}
WAY = [[1.0, 1.25], [3.0, 1.25]]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, drawing: floorproof.Scenario) -> Path:
    """Of a drive over a ledge on which the robot failed."""
    out = tmp_path_factory.mktemp("encounters") / "run"
    drawing.episode(1).run(out=out)
    return out


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory,
             drawing: floorproof.Scenario) -> floorproof.Campaign:
    two = drawing.with_({"matrix": {"robot.clearance_m": [0.03, 0.02]}})
    return floorproof.campaign(two, 4, out=tmp_path_factory.mktemp("met") / "campaign", jobs=2)


def test_an_encounter_says_what_was_met_and_how(room: Dict[str, Any]) -> None:
    room["site"]["hazards"] = [CABLE]
    episode = floorproof.load(room).run(WAY)
    first, last = episode.encounters[0], episode.encounters[-1]
    assert (first["hazard"], first["type"], first["passage"]) == (CABLE["id"], "cable_cover", "over")
    assert first["outcome"] == "cleared"
    assert {key: first["size"][key] for key in ("height_m", "width_m", "top_width_m")} == {
        "height_m": 0.012, "width_m": 0.08, "top_width_m": 0.03}
    # Square on, straight ahead, at the place and the speed that the trace has then.
    assert abs(first["heading_rad"]) < 0.05 and abs(first["lead_rad"]) < 0.05
    trace = episode.trace
    at = np.searchsorted(trace["t_s"], first["t_s"] - 1e-9)
    assert first["x_m"] == pytest.approx(trace["x_m"][at], abs=0.01)
    assert first["speed_mps"] == pytest.approx(
        math.hypot(trace["vx_mps"][at], trace["vy_mps"][at]), abs=0.01)
    # It enters with its nose, and has left when its tail has: the cover and its own length.
    length_m = first["way_m"] - 0.08
    assert 2.16 - length_m < first["x_m"] < 2.16
    assert (last["type"], last["hazard"], last["size"]) == ("free_floor", "", {})
    ways_m = sum(met["way_m"] for met in episode.encounters)
    # The path is longer by how far the robot rocks on its tyres over the cover.
    assert ways_m == pytest.approx(episode.metrics["path_length_m"], rel=0.1)


def test_a_failure_belongs_to_what_its_event_names(room: Dict[str, Any]) -> None:
    room["site"]["hazards"] = [{"type": "glass", "id": "pane", "known": False, "height_m": 1,
                                "thickness_m": 0.01, "line_m": [[2.0, 0.5], [2.0, 2.0]]}]
    episode = floorproof.load(room).run(WAY)
    event = episode.events[0]
    failed = [met for met in episode.encounters if met["outcome"] == event.mode]
    assert [met["hazard"] for met in failed] == [event.hazard] == ["pane"]
    assert failed[0]["t_s"] <= event.t_s and failed[0]["energy_j"] > 0


def test_a_floor_of_cells_has_none(room: Dict[str, Any], tmp_path: Path) -> None:
    cells = floorproof.load({**room, "drive": "cells", "plan": "rolling_window"})
    assert cells.run(out=tmp_path / "cells").encounters == []
    assert floorproof.read(tmp_path / "cells").encounters == []


def test_a_folder_holds_the_same(room: Dict[str, Any], tmp_path: Path) -> None:
    # Ids that a spreadsheet would run, and sizes that one of them has alone.
    room["site"]["hazards"] = [CABLE, {"type": "wet", "id": "@wet", "friction": 0.5,
                                       "polygon_m": [[1.5, 1], [1.8, 1], [1.8, 1.5], [1.5, 1.5]]}]
    driven = floorproof.load(room).run(WAY, out=tmp_path / "run").encounters
    read = floorproof.read(tmp_path / "run").encounters
    assert read == driven
    assert {"@wet", CABLE["id"]} <= {met["hazard"] for met in read}
    with (tmp_path / "run" / "encounters.csv").open(newline="", encoding="utf-8") as file:
        names = next(csv.reader(file))
    assert [n for n in names if not n.startswith("size.")] == [n for n in read[0] if n != "size"]
    assert {n[5:] for n in names if n.startswith("size.")} == {k for met in read for k in met["size"]}


@pytest.mark.parametrize("damaged, says", [
    (lambda text: "", "encounters.csv:1: must name the columns, each once, outcome among them"),
    (lambda text: text.replace("outcome", "out", 1), "encounters.csv:1: must name the columns"),
    (lambda text: text + "1,2\n", r"encounters.csv:\d+: holds 2 values"),
    (lambda text: text.replace("\nledge,step,over,", "\nledge,step,over,high", 1),
     r"encounters.csv:2: size.height_m = high0.012: must be a number"),
    (lambda text: text + "\udcff", "encounters.csv: is no text in UTF-8"),
])
def test_a_damaged_table_says_where(folder: Path, tmp_path: Path,
                                    damaged: Callable[[str], str], says: str) -> None:
    copy = shutil.copytree(folder, tmp_path / "run")
    file = copy / "encounters.csv"
    file.write_bytes(damaged(file.read_text(encoding="utf-8")).encode(errors="surrogateescape"))
    with pytest.raises(floorproof.InputError, match=says) as wrong:
        floorproof.read(copy)
    assert str(wrong.value).startswith(str(copy)) and "\n" not in str(wrong.value)


def test_that_none_were_recorded_is_said(folder: Path, tmp_path: Path) -> None:
    copy = shutil.copytree(folder, tmp_path / "run")
    (copy / "encounters.csv").unlink()
    episode = floorproof.read(copy)
    assert episode.events == floorproof.read(folder).events
    with pytest.raises(floorproof.InputError, match="holds no encounters.csv; earlier versions"):
        print(episode.encounters)


def rows_of(frame: Any) -> List[Dict[str, Any]]:
    """A frame's rows as an episode has them."""
    rows = []
    for row in frame.to_dict("records"):
        size = {key[5:]: value for key, value in row.items()
                if key.startswith("size.") and value == value}
        rows.append({**{key: "" if value != value or value is None else value
                        for key, value in row.items() if not key.startswith("size.")},
                     "size": size})
    return rows


def test_a_campaigns_frame_holds_what_each_episode_met(campaign: floorproof.Campaign,
                                                       drawing: floorproof.Scenario) -> None:
    pytest.importorskip("pandas")
    frame = campaign.to_pandas("encounter")
    assert list(frame["variant"].unique()) == list(campaign.variants)  # not in alphabetical order
    assert frame["outcome"].nunique() > 1, "some fail"
    places = [list(campaign.variants).index(variant) for variant in frame["variant"]]
    keys = list(zip(places, frame["episode"], frame["number"]))
    assert keys == sorted(keys) and len(set(keys)) == len(keys)
    low = frame[frame["variant"] == list(campaign.variants)[1]]
    for k in range(4):
        met = drawing.with_({"robot.clearance_m": 0.02}).episode(k).run().encounters
        there = rows_of(low[low["episode"] == k].drop(columns=["variant", "episode", "number"]))
        assert there == met
    assert frame.columns[:3].tolist() == ["variant", "episode", "number"]
    kinds = {name: str(kind) for name, kind in frame.dtypes.items()}
    assert {kinds[n] for n in ("variant", "hazard", "type", "passage", "outcome", "sensed")} == {
        "category"}
    assert kinds["episode"] == kinds["number"] == "int64"
    assert {kinds[n] for n in ("size.height_m", "speed_mps", "energy_j")} == {"float64"}
    assert (frame["hazard"].isna() == frame["type"].isin(["wall_beside", "free_floor"])).all()
    assert frame["size.height_m"].notna().equals(frame["type"] == "step")


def test_each_failed_episode_has_a_meeting_that_failed(campaign: floorproof.Campaign) -> None:
    pytest.importorskip("pandas")
    episodes = campaign.to_pandas().set_index(["variant", "episode"])
    met = campaign.to_pandas("encounter").groupby(["variant", "episode"], observed=True)["outcome"]
    failed = met.agg(lambda outcomes: not set(outcomes) <= {"cleared", "censored"})
    assert failed.sum() >= 2
    assert failed.to_dict() == (episodes["outcome"] == "failure").to_dict()


def test_parquet_holds_the_same_rows(campaign: floorproof.Campaign, tmp_path: Path,
                                     monkeypatch: pytest.MonkeyPatch) -> None:
    pandas = pytest.importorskip("pandas")
    parquet = pytest.importorskip("pyarrow.parquet")
    from floorproof import exports
    monkeypatch.setattr(exports, "_BATCH", 5)
    file = campaign.to_parquet(tmp_path / "encounters.parquet", "encounter")
    assert parquet.ParquetFile(file).num_row_groups > 2
    pandas.testing.assert_frame_equal(pandas.read_parquet(file), campaign.to_pandas("encounter"),
                                      check_dtype=False, check_categorical=False)
    about = parquet.read_schema(file).metadata
    assert about[b"floorproof.campaign"].decode() == campaign.summary["campaign"]
    with pytest.raises(floorproof.InputError, match="is there already"):
        campaign.to_parquet(file, "encounter")
    with pytest.raises(floorproof.InputError, match="table = encounters: unknown .known: episode"):
        campaign.to_pandas("encounters")


@pytest.fixture
def changed(campaign: floorproof.Campaign, tmp_path: Path) -> Callable[..., Path]:
    def change(*statements: str) -> Path:
        (tmp_path / "campaign.sqlite").write_bytes(
            (campaign.folder / "campaign.sqlite").read_bytes())
        with sqlite3.connect(tmp_path / "campaign.sqlite") as db:
            for statement in statements:
                db.execute(statement)
        db.close()
        return tmp_path
    return change


def test_only_episodes_that_are_kept_count(changed: Callable[..., Path]) -> None:
    pytest.importorskip("pandas")
    from floorproof import exports
    frame = exports.encounters_frame(changed("DELETE FROM episode WHERE episode = 2"))
    assert set(frame["episode"]) == {0, 1, 3}


def test_what_earlier_versions_recorded_can_be_read(changed: Callable[..., Path]) -> None:
    pytest.importorskip("pandas")
    from floorproof import exports
    old = changed("DROP TABLE encounter")
    assert len(exports.episodes_frame(old)) == 8
    with pytest.raises(floorproof.InputError, match="earlier version: it has no table encounter"):
        exports.encounters_frame(old)


@pytest.mark.parametrize("statement, says", [
    ("UPDATE encounter SET size = '[1' WHERE episode = 3", "is damaged"),
    ("UPDATE encounter SET size = '{\"height_m\": \"high\"}' WHERE episode = 3",
     "table encounter is none of an encounter"),
    ("UPDATE encounter SET speed_mps = 'fast' WHERE episode = 3", "column speed_mps is no number"),
    ("UPDATE encounter SET hazard = x'00' WHERE episode = 3", "column hazard is no text"),
    ("ALTER TABLE encounter DROP COLUMN sensed", "table encounter has not the columns of one"),
])
def test_a_damaged_campaign_is_refused_in_a_line(changed: Callable[..., Path], statement: str,
                                                 says: str) -> None:
    pytest.importorskip("pandas")
    from floorproof import exports
    with pytest.raises(floorproof.InputError, match=says) as wrong:
        exports.encounters_frame(changed(statement))
    assert "campaign.sqlite: is " in str(wrong.value) and "\n" not in str(wrong.value)
