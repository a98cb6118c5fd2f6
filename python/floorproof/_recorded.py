# SPDX-License-Identifier: Apache-2.0
"""Files that Floorproof has written, read back and checked as they are read."""
from __future__ import annotations

import csv
import json
import re
from pathlib import Path
from typing import Any, Dict, Iterable, List, Mapping, Optional

import numpy as np

from . import _core
from ._core import InputError

_KINDS = {dict: "an object", list: "a list", str: "a text", int: "a whole number"}


def checked(where: str, value: Any, kinds: Mapping[str, type]) -> Dict[str, Any]:
    """`value`, an object with at least these keys; `where` begins what is said where it is none."""
    if not isinstance(value, dict):
        raise InputError(f"{where}: must be an object")
    for key, kind in kinds.items():
        if key not in value:
            raise InputError(f"{where}: {key}: is missing")
        if not isinstance(value[key], kind):
            raise InputError(f"{where}: {key} = {str(value[key])[:40]}: must be {_KINDS[kind]}")
    return value


def json_object(file: Path, writer: str, kinds: Mapping[str, type]) -> Dict[str, Any]:
    """What `writer` writes: a JSON object with at least these keys."""
    rule = f"is not what `{writer}` writes"
    try:
        value = json.loads(file.read_bytes().decode())
    except OSError as error:
        raise InputError(f"{file}: {rule}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise InputError(f"{file}:{line}: {rule}: {error.reason}") from error
    except json.JSONDecodeError as error:
        raise InputError(f"{file}:{error.lineno}: {rule}: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file}: {rule}: {error}") from error
    return checked(f"{file}: {rule}", value, kinds)


def _numbers(file: Path, name: str, words: List[str]) -> np.ndarray:
    try:
        return np.array(words, dtype=float)
    except ValueError as error:
        for line, word in enumerate(words, 2):
            try:
                float(word)
            except ValueError:
                raise InputError(f"{file}:{line}: {name} = {word[:40]}: must be a number") from error
        raise InputError(f"{file}: {name}: must be numbers: {error}") from error


def _columns(file: Path, least: str) -> Dict[str, List[str]]:
    """A table, column by column; `least` is one of them."""
    rows: List[List[str]] = []
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            lines = csv.reader(stream)
            names = next(lines, [])
            if least not in names or len(set(names)) < len(names):
                raise InputError(f"{file}:1: must name the columns, each once, {least} among them")
            for row in lines:
                if len(row) != len(names):
                    raise InputError(f"{file}:{lines.line_num}: holds {len(row)} values: must be "
                                     f"{len(names)}, as line 1 names them")
                rows.append(row)
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: is no text in UTF-8: {error.reason}") from error
    except (OSError, csv.Error) as error:
        raise InputError(f"{file}: cannot be read: {error}") from error
    return {name: [row[i] for row in rows] for i, name in enumerate(names)}


def trace_columns(file: Path) -> Dict[str, Any]:
    """trace.csv, column by column: arrays of one length, `shape` a list of words."""
    return {name: words if name == "shape" else _numbers(file, name, words)
            for name, words in _columns(file, "t_s").items()}


def plan_columns(file: Path) -> Dict[str, Any]:
    """plan.csv, column by column: arrays of one length; nan where a row leaves a number open."""
    return {name: words if name == "shape" else
            _numbers(file, name, [word or "nan" for word in words])
            for name, words in _columns(file, "x_m").items()}


def encounters_of(rows: Iterable[Mapping[str, Any]]) -> List[Dict[str, Any]]:
    """Of rows as a campaign's table `encounter` has them: their sizes are JSON."""
    return [{**row, "size": json.loads(row["size"])} for row in rows]


def recorded_encounters(folder: Path) -> Optional[List[Dict[str, Any]]]:
    """The rows of an episode's encounters.csv, as `encounters_of` makes them. None: the drive was
    one that meets hazards, and they were not recorded."""
    file = folder / "encounters.csv"
    if not file.exists():
        return [] if _meets_nothing(folder) else None
    words = _columns(file, "outcome")
    rows: List[Dict[str, Any]] = [{} for _ in words["outcome"]]
    for name, is_text in _core.encounter_columns():
        if name == "size":
            _take_sizes(file, words, rows)
        elif name in words:  # files of earlier versions lack the last ones
            values = ([_without_mark(word) for word in words[name]] if is_text else
                      _numbers(file, name, words[name]).tolist())
            for row, value in zip(rows, values):
                row[name] = value
    return rows


def _take_sizes(file: Path, words: Mapping[str, List[str]], rows: List[Dict[str, Any]]) -> None:
    for row in rows:
        row["size"] = {}
    for name in words:
        if name.startswith("size."):
            values = _numbers(file, name, [word or "nan" for word in words[name]]).tolist()
            for row, word, value in zip(rows, words[name], values):
                if word:  # else the hazard has no such key
                    row["size"][name[len("size."):]] = value


def _without_mark(word: str) -> str:
    """Without what keeps spreadsheets from running the text."""
    return word[1:] if word[:1] == "'" and word[1:2] in tuple("=+-@") else word


def _meets_nothing(folder: Path) -> bool:
    """Of `drive: cells`, and where nothing was driven."""
    if not (folder / "trace.csv").exists():
        return True
    try:
        settings = (folder / "scenario.resolved.yaml").read_text(encoding="utf-8")
    except (OSError, UnicodeError):
        return False
    return re.search(r'^drive: "?cells"?$', settings, re.MULTILINE) is not None
