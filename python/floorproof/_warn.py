# SPDX-License-Identifier: Apache-2.0
"""Warnings that point at the line of the caller's own that they come from."""
from __future__ import annotations

import sys
import warnings
from types import FrameType
from typing import Optional


def warn(line: str) -> None:
    """A UserWarning at the innermost line that is not this package's."""
    level = 1
    frame: Optional[FrameType] = sys._getframe()
    while frame is not None and frame.f_globals.get("__package__") == __package__:
        frame = frame.f_back
        level += 1
    warnings.warn(line, UserWarning, stacklevel=level)
