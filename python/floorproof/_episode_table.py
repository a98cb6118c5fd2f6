# SPDX-License-Identifier: Apache-2.0
"""campaign.sqlite, read as episodes.csv tells it: the table `episode`, its JSON in columns of its
own."""
from __future__ import annotations

import json
import sqlite3
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Set, Tuple
from urllib.parse import quote

from ._core import InputError
from ._results import PathLike

_FLAT = ("plan", "drawn", "timeout")  # JSON objects whose keys become columns, in this order
_WORDS = ("variant", "outcome")  # few, and often the same
_INT64 = range(-(1 << 63), 1 << 63)
_KINDS = {bool: "bool", int: "int", float: "float", str: "text"}

Row = Tuple[Any, ...]


@lru_cache(maxsize=4096)
def _object(text: str) -> Mapping[str, Any]:
    """Plans are often the same text."""
    value = json.loads(text)
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise ValueError("a text is no JSON object")
    return value


def _type(value: Any) -> type:
    """What JSON has no type of its own for in a column is an `object`."""
    found = type(value)
    if found is int and value not in _INT64:
        return object
    return found


def _kind(types: Set[type]) -> str:
    """json: of several types, or lists and such."""
    types = types - {type(None)}
    if types == {int, float}:
        return "float"
    if not types:
        return "float"
    return _KINDS.get(next(iter(types)), "json") if len(types) == 1 else "json"


class EpisodeTable:
    """A campaign's database, opened to be read. Kinds of columns: category, bool, int, float, text,
    and json, which is told as text. Throws InputError where there is none, or where it is
    damaged."""

    def __init__(self, folder: PathLike) -> None:
        self._file = Path(folder) / "campaign.sqlite"
        if not self._file.is_file():
            raise InputError(f"{self._file}: no such file; {folder} holds no campaign")
        self._db = self._connected()
        try:
            self._look()
            self.about: Dict[str, str] = self._about()
            self._types = {str(c[1]): str(c[2])
                           for c in self._db.execute("PRAGMA table_info(episode)")}
            self._variants = self._variants_in_order(folder)
            self._at = {name: i for i, name in enumerate(self._types)}
            self.kinds: Dict[str, str] = self._found_kinds()
            """Of each column, in the order of episodes.csv; `events` come last."""
        except (sqlite3.Error, UnicodeError) as error:
            self._db.close()
            raise self._damaged(error) from error
        except BaseException:
            self._db.close()
            raise

    def __enter__(self) -> "EpisodeTable":
        return self

    def __exit__(self, *_: object) -> None:
        self._db.close()

    def rows(self) -> Iterator[Row]:
        """By variant, then by number."""
        names = ", ".join(f'"{name}"' for name in self._types)
        try:
            for variant in self._variants:
                yield from self._db.execute(
                    f"SELECT {names} FROM episode WHERE campaign = ? AND variant = ? "
                    "ORDER BY episode", (self.about["campaign"], variant))
        except (sqlite3.Error, UnicodeError) as error:
            raise self._damaged(error) from error

    def batches(self, size: int) -> Iterator[List[Row]]:
        batch: List[Row] = []
        for row in self.rows():
            batch.append(row)
            if len(batch) == size:
                yield batch
                batch = []
        if batch:
            yield batch

    def columns(self, rows: Iterable[Row]) -> Dict[str, List[Any]]:
        """Values by column; none: the episode has none."""
        out: Dict[str, List[Any]] = {name: [] for name in self.kinds}
        plain = [(self._at[name], out[name]) for name in self.kinds if name in self._at]
        flat = {group: [(name[len(group) + 1:], out[name]) for name in self.kinds
                        if name.startswith(group + ".")] for group in _FLAT}
        for row in rows:
            for at, column in plain:
                column.append(row[at])
            for group, keys in flat.items():
                parsed = self._parsed(row, group)
                for key, column in keys:
                    column.append(parsed.get(key))
        for group, keys in flat.items():
            for key, column in keys:
                if self.kinds[f"{group}.{key}"] == "json":
                    column[:] = [None if v is None else json.dumps(v) for v in column]
        return out

    # --- inside

    def _connected(self) -> sqlite3.Connection:
        # Without a log beside it the file is read as it lies, from a read-only disk, too.
        log = self._file.with_name(self._file.name + "-wal")
        how = "mode=ro" if log.exists() and log.stat().st_size else "mode=ro&immutable=1"
        return sqlite3.connect(f"file:{quote(str(self._file.absolute()))}?{how}", uri=True,
                               isolation_level=None)

    def _look(self) -> None:
        """One look for all that is read, though a campaign may go on; and nothing of the file's own
        is run."""
        self._db.execute("PRAGMA trusted_schema = OFF")
        self._db.execute("BEGIN")
        tables = set(self._db.execute("SELECT type, name FROM sqlite_master"))
        if not {("table", "about"), ("table", "episode")} <= tables:
            raise InputError(f"{self._file}: is not a campaign's database")

    def _about(self) -> Dict[str, str]:
        about = {str(key): str(value)
                 for key, value in self._db.execute("SELECT key, value FROM about")}
        missing = [key for key in ("campaign", "scenario", "versions") if key not in about]
        if missing or about.get("format") != "1":
            raise InputError(f"{self._file}: is not a campaign's database (table about)")
        return about

    def _variants_in_order(self, folder: PathLike) -> List[str]:
        """As the scenario has them, which the summary keeps."""
        there = [str(name) for name, in self._db.execute(
            "SELECT DISTINCT variant FROM episode WHERE campaign = ? ORDER BY variant",
            (self.about["campaign"],))]
        try:
            text = (Path(folder) / "summary.json").read_text(encoding="utf-8")
            order = list(json.loads(text)["variants"])
        except (OSError, ValueError, KeyError, TypeError):
            order = []
        return sorted(there, key=lambda name: order.index(name) if name in order else len(order))

    def _found_kinds(self) -> Dict[str, str]:
        found: Dict[str, Dict[str, Set[type]]] = {group: {} for group in _FLAT}
        for row in self.rows():
            for group, keys in found.items():
                for key, value in self._parsed(row, group).items():
                    if key in keys:
                        keys[key].add(_type(value))
                    else:
                        keys[key] = {_type(value)}
        kinds: Dict[str, str] = {}
        for name, declared in self._types.items():
            if name not in ("campaign", "events", *_FLAT):
                kinds[name] = ("category" if name in _WORDS else
                               {"INTEGER": "int", "REAL": "float"}.get(declared, "text"))
        for group, keys in found.items():
            kinds.update((f"{group}.{key}", _kind(types)) for key, types in keys.items())
        return {**kinds, "events": "text"}

    def _parsed(self, row: Row, group: str) -> Mapping[str, Any]:
        if group not in self._at:  # files of earlier versions have no `timeout`
            return {}
        try:
            return _object(row[self._at[group]])
        except (TypeError, ValueError) as error:
            raise self._damaged(error) from error

    def _damaged(self, error: Exception) -> InputError:
        return InputError(f"{self._file}: is damaged ({error})")
