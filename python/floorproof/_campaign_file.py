# SPDX-License-Identifier: Apache-2.0
"""campaign.sqlite, opened to be read: what its tables have in common.

The file may come from anybody. The C++ library checks it as for every command, and only then is it
opened here."""
from __future__ import annotations

import json
import sqlite3
from abc import ABC, abstractmethod
from functools import lru_cache
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, TypeVar
from urllib.parse import quote

from . import _core
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


_READING = {sqlite3.SQLITE_SELECT, sqlite3.SQLITE_READ, sqlite3.SQLITE_TRANSACTION}


def _only_reading(action: int, name: Optional[str], *_: Optional[str]) -> int:
    if action in _READING or (action == sqlite3.SQLITE_PRAGMA and name == "table_info"):
        return sqlite3.SQLITE_OK
    return sqlite3.SQLITE_DENY


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
        self.about: Dict[str, str] = _core.checked_about(self._file)
        self._db = self._connected()
        try:
            self._begin()
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

    def _begin(self) -> None:
        """The same limits as in the C++ library, then one transaction for all reads, though a
        campaign may go on."""
        self._db.setlimit(sqlite3.SQLITE_LIMIT_ATTACHED, 0)
        for pragma in ("trusted_schema = OFF", "query_only = ON", "cell_size_check = ON",
                       "mmap_size = 0"):
            self._db.execute(f"PRAGMA {pragma}")
        self._db.set_authorizer(_only_reading)
        self._db.execute("BEGIN")
        if not self._db.execute("SELECT 1 FROM sqlite_schema WHERE name = ?",
                                (self.table,)).fetchone():
            raise InputError(f"{self._file}: is of an earlier version: it has no table {self.table}")

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
