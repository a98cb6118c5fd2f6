# SPDX-License-Identifier: Apache-2.0
"""Results for other tools: data frames, Parquet, MCAP (docs/exports.md).

What a function needs beside numpy is imported when it is called: pip install '.[tables]' for
pandas and Parquet, '.[mcap]' for logs.
"""
from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict

from . import _core
from ._campaign_file import CampaignFile
from ._core import InputError
from ._encounter_table import EncounterTable
from ._episode_table import EpisodeTable
from ._files import written_whole
from ._mcap import to_mcap
from ._recorded import json_object
from ._results import Episode, PathLike

if TYPE_CHECKING:
    from pandas import DataFrame

__all__ = ["encounters_frame", "encounters_parquet", "episodes_frame", "episodes_parquet",
           "rates_frame", "to_mcap", "trace_frame"]

_BATCH = 4096  # rows that are in memory at once while Parquet is written


def _needed(package: str) -> Any:
    try:
        return __import__(package)
    except ImportError as error:
        raise ImportError(f"{package} is missing: pip install '.[tables]' in Floorproof's "
                          "folder") from error


def trace_frame(episode: Episode) -> "DataFrame":
    """The trace, a row each, columns and units as docs/results.md lists them; `shape` is a
    category. Without rows where nothing was driven."""
    pandas = _needed("pandas")
    frame: DataFrame = pandas.DataFrame({
        name: pandas.Categorical(list(column)) if name == "shape" else column
        for name, column in episode.trace.items()})
    return frame


def episodes_frame(folder: PathLike) -> "DataFrame":
    """A campaign's episodes, a row each: the rows, order and columns of episodes.csv, and `events`.

    What was drawn stands in `drawn.KEY`, the plan's figures in `plan.KEY`, where the time ran out
    in `timeout.KEY`. `events` holds lists of dicts as in result.json. Numbers are float64; counts
    are int64, or Int64 where some episodes have none; lists and such are JSON.
    Throws InputError where the folder holds no campaign, or a damaged one.
    """
    with EpisodeTable(folder) as table:
        return _frame(table)


def encounters_frame(folder: PathLike) -> "DataFrame":
    """The hazards that a campaign's episodes met, a row a meeting: table `encounter` of
    campaign.sqlite, columns and units as docs/results.md lists them for encounters.csv, with
    `variant`, `episode` and `number`. A row of episodes_frame has the same variant and episode.

    A size stands in `size.KEY`, float64, NaN where the hazard has no such key. Words are
    categories; missing where nothing is said: the `hazard` of walls and free floor, what became of
    a robot (`after`) and whether it was `sensed` where nobody saw. Throws InputError where the
    folder holds no campaign, a damaged one, or one of a version that recorded no encounters.
    """
    with EncounterTable(folder) as table:
        return _frame(table)


def _frame(table: CampaignFile) -> "DataFrame":
    pandas = _needed("pandas")
    types = {"bool": "boolean", "int": "Int64", "float": "float64", "text": "str",
             "json": "str"}
    columns: Dict[str, Any] = {}
    kinds = table.kinds
    rows = table.columns(table.rows())
    for name, values in rows.items():
        kind = kinds[name]
        if kind == "category":
            columns[name] = pandas.Categorical(values)
        elif name == "events":
            columns[name] = pandas.Series([[] if v == "[]" else json.loads(v) for v in values],
                                          dtype=object)
        elif kind in ("bool", "int") and None not in values:
            columns[name] = pandas.Series(values, dtype={"bool": "bool", "int": "int64"}[kind])
        else:
            columns[name] = pandas.Series(values, dtype=types[kind])
    frame: DataFrame = pandas.DataFrame(columns)
    return frame


def episodes_parquet(folder: PathLike, file: PathLike, *, overwrite: bool = False) -> Path:
    """The same as a Parquet file; `events` are JSON. Written some thousand episodes at a time. The
    schema's metadata names what was driven: floorproof.version (of whoever exports),
    floorproof.campaign (the campaign's id), floorproof.scenario (its settings, resolved),
    floorproof.versions (of what drove it, JSON)."""
    with EpisodeTable(folder) as table:
        return _parquet(table, Path(file), overwrite)


def encounters_parquet(folder: PathLike, file: PathLike, *, overwrite: bool = False) -> Path:
    """encounters_frame as a Parquet file, with the same metadata as that of episodes."""
    with EncounterTable(folder) as table:
        return _parquet(table, Path(file), overwrite)


def _parquet(table: CampaignFile, file: Path, overwrite: bool) -> Path:
    pyarrow = _needed("pyarrow")
    from pyarrow import parquet  # type: ignore[import-untyped,unused-ignore]
    types = {"bool": pyarrow.bool_(), "int": pyarrow.int64(), "float": pyarrow.float64(),
             "text": pyarrow.string(), "json": pyarrow.string(),
             "category": pyarrow.dictionary(pyarrow.int32(), pyarrow.string())}
    about = {"floorproof.version": _core.__version__,
             **{f"floorproof.{key}": table.about[key]
                for key in ("campaign", "scenario", "versions")}}
    schema = pyarrow.schema([(name, types[kind]) for name, kind in table.kinds.items()],
                            metadata=about)
    with written_whole(file, overwrite) as part, parquet.ParquetWriter(part, schema) as writer:
        for batch in table.batches(_BATCH):
            writer.write_table(pyarrow.table(table.columns(batch), schema=schema))
    return file


def rates_frame(folder: PathLike) -> "DataFrame":
    """What summary.json says of failures: a row a variant and failure (`any_failure`, then each
    mode), with k of n episodes, the rate and its interval [lower, upper] at `confidence`."""
    pandas = _needed("pandas")
    file = Path(folder) / "summary.json"
    variants = json_object(file, "floorproof campaign", {"variants": dict})["variants"]
    try:
        rows = [{"variant": variant, "failure": failure,
                 **{key: rate[key] for key in ("k", "n", "rate", "lower", "upper", "confidence")}}
                for variant, about in variants.items()
                for failure, rate in about["failures"].items()]
    except (KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{file}: is not what `floorproof campaign` writes: {error}") from error
    frame: DataFrame = pandas.DataFrame(rows).astype({"rate": "float64"})
    return frame
