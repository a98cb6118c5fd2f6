# SPDX-License-Identifier: Apache-2.0
"""Campaigns and traces as data frames and Parquet: what they hold is what the files say."""
from __future__ import annotations

import csv
import errno
import json
import sqlite3
import sys
from pathlib import Path
from typing import Any, Dict, List

import pytest

import floorproof

pandas = pytest.importorskip("pandas", reason="pip install '.[tables]'")
parquet = pytest.importorskip("pyarrow.parquet", reason="pip install '.[tables]'")

from floorproof import exports  # noqa: E402
from floorproof._episode_table import EpisodeTable  # noqa: E402
from floorproof._files import written_whole  # noqa: E402

FLOORS: Dict[str, Any] = {
    "scenario": 1, "name": "floors", "robot": "beluga", "plan": "rolling_window", "drive": "cells",
    "site": {"site": 1, "generate": {"kind": "room", "cells": [8, 8], "cluster_cells": [1, 2]}},
    "success": {"min_coverage": 0.9}, "time_limit_s": 180,
    "randomise": {"site.generate.cells": {"choice": [[8, 8], [8, 12]]},
                  "site.generate.obstacle_density": {"uniform": [0.05, 0.2]}},
    # Not in alphabetical order.
    "matrix": {"plan.planner": ["rolling_window", "random_walk"]},
}


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> floorproof.Campaign:
    out = tmp_path_factory.mktemp("exports") / "campaign"
    return floorproof.campaign(FLOORS, 6, out=out, jobs=2)


def lines(campaign: floorproof.Campaign) -> List[Dict[str, str]]:
    with (campaign.folder / "episodes.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def same(word: str, value: Any) -> bool:
    """What a field of episodes.csv says, and what a cell of a table holds."""
    if value is None or isinstance(value, float) and value != value or value is pandas.NA:
        return word == ""
    if isinstance(value, str):
        return word == value or json.loads(word) == json.loads(value)
    return float(word) == float(value)


def test_a_campaigns_frame_is_its_episodes_csv(campaign: floorproof.Campaign) -> None:
    frame = campaign.to_pandas()
    rows = lines(campaign)
    assert list(frame.columns) == [*rows[0], "events"]
    assert len(frame) == len(rows) == 12
    wrong = [(i, name) for i, row in enumerate(rows) for name, word in row.items()
             if not same(word, frame[name].iloc[i])]
    assert not wrong
    assert list(frame["variant"].unique()) == list(campaign.variants)  # in the matrix' order


def test_columns_have_the_types_of_what_they_hold(campaign: floorproof.Campaign) -> None:
    frame = campaign.to_pandas()
    kinds = {name: str(kind) for name, kind in frame.dtypes.items()}
    assert kinds["outcome"] == kinds["variant"] == "category"
    assert kinds["episode"] == kinds["stuck"] == "int64"
    assert kinds["coverage"] == kinds["drawn.site.generate.obstacle_density"] == "float64"
    assert frame["drawn.site.generate.cells"].map(json.loads).map(len).eq(2).all()
    assert frame["events"].map(type).eq(list).all()
    late = frame["outcome"] == "timeout"
    assert late.any() and not late.all()
    assert frame["timeout.t_s"].notna().eq(late).all()


def test_parquet_holds_the_same_and_says_what_was_driven(campaign: floorproof.Campaign,
                                                         tmp_path: Path,
                                                         monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exports, "_BATCH", 5)  # twelve rows, in three pieces
    file = campaign.to_parquet(tmp_path / "episodes.parquet")
    assert parquet.ParquetFile(file).num_row_groups == 3
    told, frame = pandas.read_parquet(file), campaign.to_pandas()
    assert list(told.columns) == list(frame.columns)
    for name in frame.columns:
        a, b = told[name].tolist(), frame[name].tolist()
        if name == "events":
            a = [json.loads(text) for text in a]
        assert [v for v in a if v == v] == [v for v in b if v == v], name
    about = parquet.read_schema(file).metadata
    assert about[b"floorproof.campaign"].decode() == campaign.summary["campaign"]
    assert about[b"floorproof.version"].decode() == floorproof.__version__
    assert b"rolling_window" in about[b"floorproof.scenario"]


def test_a_file_is_not_replaced_unasked(campaign: floorproof.Campaign, tmp_path: Path) -> None:
    file = tmp_path / "mine.parquet"
    file.write_text("mine", encoding="utf-8")
    with pytest.raises(floorproof.InputError, match="is there already"):
        campaign.to_parquet(file)
    assert file.read_text(encoding="utf-8") == "mine"
    exports.episodes_parquet(campaign.folder, file, overwrite=True)
    assert parquet.ParquetFile(file).metadata.num_rows == 12
    assert [f.name for f in tmp_path.iterdir()] == ["mine.parquet"]


def test_rates_are_the_summarys(campaign: floorproof.Campaign) -> None:
    frame = exports.rates_frame(campaign.folder).set_index(["variant", "failure"])
    for variant, about in campaign.variants.items():
        for failure, rate in about["failures"].items():
            row = frame.loc[(variant, failure)]
            assert (row["k"], row["n"], row["upper"]) == (rate["k"], rate["n"], rate["upper"])


def test_keys_of_several_kinds_are_told_as_json(campaign: floorproof.Campaign,
                                                tmp_path: Path) -> None:
    copy = tmp_path / "mixed"
    copy.mkdir()
    (copy / "campaign.sqlite").write_bytes((campaign.folder / "campaign.sqlite").read_bytes())
    values = [1, 2.5, "two", None, [1, 2], True, 1 << 70]
    with sqlite3.connect(copy / "campaign.sqlite") as db:
        for episode, value in enumerate(values[:6]):
            db.execute("UPDATE episode SET drawn = ? WHERE episode = ? AND variant LIKE '%window'",
                       (json.dumps({"any": value, "many": values[episode % 2], "big": values[6]}),
                        episode))
    db.close()
    frame = exports.episodes_frame(copy).query("`variant`.str.contains('window')")
    told = [json.loads(v) if isinstance(v, str) else None for v in frame["drawn.any"]]
    assert told == values[:6]
    assert frame["drawn.many"].tolist() == [1, 2.5] * 3
    assert [json.loads(v) for v in frame["drawn.big"]] == [1 << 70] * 6
    exports.episodes_parquet(copy, tmp_path / "mixed.parquet")


def test_what_is_no_campaign_is_refused_in_a_line(campaign: floorproof.Campaign,
                                                  tmp_path: Path) -> None:
    def refused(match: str) -> None:
        with pytest.raises(floorproof.InputError, match=match) as error:
            exports.episodes_frame(tmp_path)
        assert "\n" not in str(error.value)
        with pytest.raises(floorproof.InputError, match=match):
            exports.episodes_parquet(tmp_path, tmp_path / "x.parquet")
        assert not (tmp_path / "x.parquet").exists()

    file = tmp_path / "campaign.sqlite"
    refused("no such file")
    file.write_bytes(b"no database at all, though it is long enough to be one" * 100)
    refused("is damaged")
    file.unlink()
    with sqlite3.connect(file) as db:
        db.execute("CREATE TABLE about (key, value)")
    db.close()
    refused("is not a campaign's database")
    whole = (campaign.folder / "campaign.sqlite").read_bytes()
    file.write_bytes(whole[:len(whole) // 2])
    refused("is damaged")
    file.write_bytes(whole)
    with sqlite3.connect(file) as db:
        db.execute("UPDATE episode SET plan = '[1' WHERE episode = 3")
    db.close()
    refused("is damaged")
    file.unlink()
    file.symlink_to(campaign.folder / "campaign.sqlite")
    refused("is no plain file")
    with pytest.raises(floorproof.InputError, match="summary.json"):
        exports.rates_frame(tmp_path)


@pytest.mark.parametrize("statements, says", [
    # 16 MB that are computed for each row, though the file is small.
    (["ALTER TABLE episode ADD COLUMN c TEXT AS (hex(zeroblob(8000000)))",
      "ALTER TABLE extra ADD COLUMN c TEXT AS (hex(zeroblob(8000000)))"],
     "table episode has not the columns of one"),
    (["ALTER TABLE timing ADD COLUMN c TEXT AS ('a')"], "table timing has not the columns of one"),
    (["DROP TABLE extra", "CREATE VIEW extra AS SELECT * FROM episode"], "it holds a view extra"),
    (["CREATE TRIGGER t AFTER INSERT ON episode BEGIN DELETE FROM episode; END"],
     "it holds a trigger t"),
    (["CREATE TABLE more(a)"], "its tables are not about"),
    (["UPDATE episode SET message = zeroblob(17000000) WHERE episode = 1"],
     "a text of more than 16 MiB"),
    (["UPDATE episode SET coverage = 'many' WHERE episode = 1"], "in column coverage is no number"),
    (["UPDATE episode SET coverage = 9e999 WHERE episode = 1"], "in column coverage is not finite"),
    (["UPDATE episode SET drawn = '{\"a\": NaN}' WHERE episode = 1"], "is no JSON"),
    (["UPDATE episode SET drawn = '{\"a\": ' || replace(hex(zeroblob(9999)), '00', '[') ||"
      " replace(hex(zeroblob(9999)), '00', ']') || '}' WHERE episode = 1"],
     "nested more than 32 levels deep"),
])
def test_a_strangers_campaign_is_checked_as_by_every_command(
        campaign: floorproof.Campaign, tmp_path: Path, statements: List[str], says: str) -> None:
    file = tmp_path / "campaign.sqlite"
    file.write_bytes((campaign.folder / "campaign.sqlite").read_bytes())
    with sqlite3.connect(file) as db:
        for statement in statements:
            db.execute(statement)
    db.close()
    for read in (exports.episodes_frame, exports.encounters_frame):
        with pytest.raises(floorproof.InputError, match=says) as error:
            read(tmp_path)
        assert str(error.value).startswith(str(file)) and "\n" not in str(error.value)


def test_a_connection_to_a_campaign_only_reads(campaign: floorproof.Campaign,
                                               tmp_path: Path) -> None:
    sqlite3.connect(tmp_path / "other.sqlite").execute("CREATE TABLE a(b)").connection.close()
    with EpisodeTable(campaign.folder) as table:
        for statement in (f"ATTACH '{tmp_path / 'other.sqlite'}' AS other", "DELETE FROM episode",
                          "PRAGMA query_only = OFF", "SELECT hex(zeroblob(8000000))"):
            with pytest.raises(sqlite3.DatabaseError, match="not authorized|too many attached"):
                table._db.execute(statement)


def test_reading_leaves_the_campaign_as_it_was(campaign: floorproof.Campaign) -> None:
    def state() -> Dict[str, bytes]:
        return {f.name: f.read_bytes() for f in campaign.folder.iterdir() if f.is_file()}

    before = state()
    campaign.to_pandas()
    assert state() == before


def test_a_trace_is_a_frame(tmp_path: Path) -> None:
    scenario = floorproof.load({**FLOORS, "plan": "frontier_coverage", "matrix": {}})
    episode = scenario.run(out=tmp_path / "run")
    frame = episode.to_pandas()
    there = pandas.read_csv(tmp_path / "run" / "trace.csv")
    assert list(frame.columns) == list(there.columns)
    assert len(frame) == len(there) > 10
    assert str(frame["shape"].dtype) == "category"
    assert (frame["x_m"] - there["x_m"]).abs().max() < 1e-5
    read = floorproof.read(tmp_path / "run").to_pandas()
    assert (read["x_m"] == there["x_m"]).all()


def test_a_missing_package_is_named(campaign: floorproof.Campaign,
                                    monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install '\.\[tables\]'"):
        campaign.to_pandas()


def test_a_full_disk_is_said_with_the_files_name(tmp_path):
    with pytest.raises(floorproof.InternalError, match="log.mcap: cannot be written: No space left"):
        with written_whole(tmp_path / "log.mcap", overwrite=False):
            raise OSError(errno.ENOSPC, "No space left on device")
    assert not list(tmp_path.iterdir())
