# SPDX-License-Identifier: Apache-2.0
"""What is given as Python values, as the YAML that the core reads."""
from __future__ import annotations

import json
import os
import re
from typing import Any, List, Mapping, Optional, Tuple

import numpy as np

from ._core import InputError

_NO_WORDS = ("null", "true", "false")  # of YAML 1.2


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise InputError(f"{type(value).__name__} {value!r}: is nothing that YAML has")


def _whole(text: str) -> str:
    """The text, if all that it holds are characters: half a pair, say of a file's name, is none."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        around = text[max(0, error.start - 30):error.end + 10]
        raise InputError(f"{ascii(around)}: a lone surrogate is no character of YAML") from error
    return text


def yaml_text(value: Any) -> str:
    """As YAML: JSON is a part of it, but for surrogate pairs, so that characters stand as they are.
    A word alone stands as one would type it: `none` is none."""
    if isinstance(value, str) and re.fullmatch(r"[a-z_]+", value) and value not in _NO_WORDS:
        return value
    try:
        return _whole(json.dumps(value, default=_plain, ensure_ascii=False))
    except InputError:
        raise
    except (TypeError, ValueError, RecursionError) as error:  # odd keys, a dict within itself
        raise InputError(f"{type(value).__name__}: is nothing that YAML has: {error}") from error


def overrides_of(changes: Optional[Mapping[str, Any]],
                 top: Mapping[str, Any]) -> List[Tuple[str, str]]:
    """Keys and their values, as --set takes them."""
    keys = {**(changes or {}), **top}
    for key in keys:
        if not isinstance(key, str):
            raise InputError(f"{key!r}: is no key; keys are words such as robot.clearance_m")
    return [(_whole(key), yaml_text(value)) for key, value in keys.items()]
