# SPDX-License-Identifier: Apache-2.0
"""campaign.sqlite, opened to be read: what its tables have in common."""
from __future__ import annotations

import json
import sqlite3
from abc import ABC, abstractmethod
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Tuple, TypeVar
from urllib.parse import quote

from ._core import InputError
from ._results import PathLike

Row = Tuple[Any, ...]
Of = TypeVar("Of", bound="CampaignFile")


@lru_cache(maxsize=4096)
def object_of(text: str) -> Mapping[str, Any]:
    """What is often the same text. Throws ValueError where it is no JSON object."""
    value = json.loads(text)
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise ValueError("a text is no JSON object")
    return value


class CampaignFile(ABC):
    """A campaign's database and one of its tables. Kinds of columns: category, bool, int, float,
    text, and json, which is told as text. Throws InputError where there is none, or where it is
    damaged."""

    table = ""
    kinds: Dict[str, str]
    """Of each column, in order."""

    def __init__(self, folder: PathLike) -> None:
        self._file = Path(folder) / "campaign.sqlite"
        if not self._file.is_file():
            raise InputError(f"{self._file}: no such file; {folder} holds no campaign")
        self._db = self._connected()
        try:
            self._look()
            self.about: Dict[str, str] = self._about()
            self._types = {str(c[1]): str(c[2])
                           for c in self._db.execute(f"PRAGMA table_info({self.table})")}
            self._variants = self._variants_in_order(folder)
            self._at = {name: i for i, name in enumerate(self._types)}
            self.kinds = self._found_kinds()
        except (sqlite3.Error, UnicodeError) as error:
            self._db.close()
            raise self._damaged(error) from error
        except BaseException:
            self._db.close()
            raise

    def __enter__(self: Of) -> Of:
        return self

    def __exit__(self, *_: object) -> None:
        self._db.close()

    def rows(self) -> Iterator[Row]:
        """By variant, then by number; of the episodes that the campaign keeps."""
        names = ", ".join(f'"{name}"' for name in self._types)
        try:
            for variant in self._variants:
                yield from self._db.execute(
                    f"SELECT {names} FROM {self.table} WHERE campaign = ?1 AND variant = ?2 "
                    f"{self._which()}", (self.about["campaign"], variant))
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

    @abstractmethod
    def columns(self, rows: Iterable[Row]) -> Dict[str, List[Any]]:
        """Values by column; none: the row has none."""

    # --- of each table

    @abstractmethod
    def _which(self) -> str:
        """Which rows of a variant, and in which order (SQL)."""

    @abstractmethod
    def _found_kinds(self) -> Dict[str, str]:
        ...

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
        if ("table", self.table) not in tables:
            raise InputError(f"{self._file}: is of an earlier version: it has no table {self.table}")

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

    def _parsed(self, row: Row, name: str) -> Mapping[str, Any]:
        """A column's JSON object; empty of files whose version has no such column."""
        if name not in self._at:
            return {}
        try:
            return object_of(row[self._at[name]])
        except (TypeError, ValueError) as error:
            raise self._damaged(error) from error

    def _damaged(self, error: Exception) -> InputError:
        return InputError(f"{self._file}: is damaged ({error})")
