# SPDX-License-Identifier: Apache-2.0
"""A campaign's table `encounter`: the columns of encounters.csv, each size in one of its own."""
from __future__ import annotations

from typing import Any, Dict, Iterable, List, Set

from ._campaign_file import CampaignFile, Row
from ._core import InputError

_KEYS = {"variant": "category", "episode": "int", "number": "int"}
_NEEDED = ("campaign", *_KEYS, "hazard", "type", "passage", "size", "outcome")
_TYPES: Dict[str, Set[type]] = {"category": {str}, "int": {int}, "float": {float, int}}


class EncounterTable(CampaignFile):
    """By variant, episode and number: what an episode met, in order. A word that says nothing, such
    as the hazard of what is none, is none here."""

    table = "encounter"

    def columns(self, rows: Iterable[Row]) -> Dict[str, List[Any]]:
        out: Dict[str, List[Any]] = {name: [] for name in self.kinds}
        plain = [(self._at[name], out[name]) for name in self.kinds if name in self._at]
        sizes = [(name[len("size."):], out[name]) for name in self.kinds
                 if name.startswith("size.")]
        for row in rows:
            for at, column in plain:
                column.append(row[at])
            size = self._parsed(row, "size")
            for key, column in sizes:
                column.append(size.get(key))
        for name, column in out.items():
            self._check(name, column)
            if self.kinds[name] == "category":
                column[:] = [word or None for word in column]
        return out

    def _which(self) -> str:
        return ("AND episode IN (SELECT episode FROM episode WHERE campaign = ?1 AND variant = ?2) "
                "ORDER BY episode, number")

    def _found_kinds(self) -> Dict[str, str]:
        missing = [name for name in _NEEDED if name not in self._types]
        if missing:
            raise InputError(f"{self._file}: is not a campaign's database (table encounter has no "
                             f"column {missing[0]})")
        sizes: Dict[str, str] = {}  # in the order first met
        for row in self.rows():
            for key in self._parsed(row, "size"):
                sizes[f"size.{key}"] = "float"
        kinds: Dict[str, str] = {}
        for name, declared in self._types.items():
            if name == "size":
                kinds.update(sizes)
            elif name != "campaign":
                kinds[name] = _KEYS.get(name, "float" if declared == "REAL" else "category")
        return kinds

    def _check(self, name: str, column: List[Any]) -> None:
        may = _TYPES[self.kinds[name]]
        if name.startswith("size."):
            may = may | {type(None)}
        wrong = set(map(type, column)) - may
        if wrong:
            raise self._damaged(TypeError(f"{name} of an encounter is a {wrong.pop().__name__}"))
