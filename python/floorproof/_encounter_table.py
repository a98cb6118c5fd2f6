# SPDX-License-Identifier: Apache-2.0
"""A campaign's table `encounter`: the columns of encounters.csv, each size in one of its own."""
from __future__ import annotations

from typing import Any, Dict, Iterable, List

from ._campaign_file import CampaignFile, Row

_KEYS = {"variant": "category", "episode": "int", "number": "int"}


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
            if self.kinds[name] == "category":
                column[:] = [word or None for word in column]
        return out

    def _which(self) -> str:
        return ("AND episode IN (SELECT episode FROM episode WHERE campaign = ?1 AND variant = ?2) "
                "ORDER BY episode, number")

    def _found_kinds(self) -> Dict[str, str]:
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
