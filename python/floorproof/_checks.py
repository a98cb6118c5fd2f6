# SPDX-License-Identifier: Apache-2.0
"""What is said of arguments that will not do: one line that names argument, value and rule."""
from __future__ import annotations

import operator
import os
from math import isfinite
from pathlib import Path
from typing import Any, Optional, Tuple

from ._core import InputError


def path_of(name: str, value: Any) -> Path:
    """What names a file or a folder. "" would be the working directory without a word."""
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"{name} = {value!r}: must be a path")
    text = os.fspath(value)
    if not isinstance(text, str) or not text or "\0" in text:
        raise InputError(f"{name} = {text!r}: is no path")
    return Path(value)


def among(name: str, value: Any, known: Tuple[Any, ...]) -> None:
    if value not in known:
        raise InputError(f"{name} = {value}: unknown (known: {', '.join(map(str, known))})")


def whole(name: str, value: Any, least: Optional[int] = None, most: int = (1 << 63) - 1) -> int:
    """`least` None: which numbers will do is said by who takes it."""
    try:
        made = operator.index(value)
    except TypeError:
        made = None
    if made is None or isinstance(value, bool) or abs(made) > most:
        raise InputError(f"{name} = {value!r}: must be a whole number, at most {most}")
    if least is not None and made < least:
        raise InputError(f"{name} = {made}: must be at least {least}")
    return made


def number(name: str, value: Any, least: Optional[float] = None) -> float:
    try:
        made = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {value!r}: must be a number") from None
    if not isfinite(made) or (least is not None and made < least):
        raise InputError(f"{name} = {made}: must be finite"
                         + ("" if least is None else f" and at least {least}"))
    return made


def picture_size(width: Any, height: Any) -> Tuple[int, int]:
    return whole("width", width, 1, 1 << 20), whole("height", height, 1, 1 << 20)
