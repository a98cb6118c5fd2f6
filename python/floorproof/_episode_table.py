# SPDX-License-Identifier: Apache-2.0
"""A campaign's table `episode`, as episodes.csv tells it: its JSON in columns of its own."""
from __future__ import annotations

import json
from typing import Any, Dict, Iterable, List, Set

from ._campaign_file import CampaignFile, Row

_FLAT = ("plan", "drawn", "timeout")  # JSON objects whose keys become columns, in this order
_WORDS = ("variant", "outcome")  # few, and often the same
_INT64 = range(-(1 << 63), 1 << 63)
_KINDS = {bool: "bool", int: "int", float: "float", str: "text"}


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


class EpisodeTable(CampaignFile):
    """In the order of episodes.csv; `events` come last."""

    table = "episode"

    def columns(self, rows: Iterable[Row]) -> Dict[str, List[Any]]:
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

    def _which(self) -> str:
        return "ORDER BY episode"

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
