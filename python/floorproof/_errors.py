# SPDX-License-Identifier: Apache-2.0
"""Errors as text: one printable line of bounded length, whoever raises them with whatever text."""
from __future__ import annotations

from ._core import InputError, InternalError, error_line


def _line(error: BaseException) -> str:
    text = " ".join(map(str, error.args))
    # Names of files that are not UTF-8 have lone surrogates.
    return error_line(text.encode("utf-8", "backslashreplace").decode())


InputError.__str__ = _line  # type: ignore[method-assign]
InternalError.__str__ = _line  # type: ignore[method-assign]
