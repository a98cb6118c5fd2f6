# SPDX-License-Identifier: Apache-2.0
"""Files that Floorproof has written, read back and checked as they are read."""
from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any, Dict, List, Mapping

import numpy as np

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


def trace_columns(file: Path) -> Dict[str, Any]:
    """trace.csv, column by column: arrays of one length, `shape` a list of words."""
    rows: List[List[str]] = []
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            lines = csv.reader(stream)
            names = next(lines, [])
            if "t_s" not in names or len(set(names)) < len(names):
                raise InputError(f"{file}:1: must name the columns, each once, t_s among them")
            for row in lines:
                if len(row) != len(names):
                    raise InputError(f"{file}:{lines.line_num}: holds {len(row)} values: must be "
                                     f"{len(names)}, as line 1 names them")
                rows.append(row)
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: is no text in UTF-8: {error.reason}") from error
    except (OSError, csv.Error) as error:
        raise InputError(f"{file}: cannot be read: {error}") from error
    columns = {name: [row[i] for row in rows] for i, name in enumerate(names)}
    return {name: words if name == "shape" else _numbers(file, name, words)
            for name, words in columns.items()}
