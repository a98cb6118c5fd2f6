# SPDX-License-Identifier: Apache-2.0
"""Files that are written whole or not at all."""
from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

from . import _core
from ._core import InputError, InternalError


@contextmanager
def written_whole(file: Path, overwrite: bool) -> Iterator[Path]:
    """Gives the name to write under; it becomes `file` at the end, or is removed where that is not
    reached. Refuses a `file` that is there, unless `overwrite`, and one that is no plain file."""
    if file.is_symlink() or (file.exists() and not file.is_file()):
        raise InputError(f"{file}: is no plain file")
    if file.exists() and not overwrite:
        raise InputError(f"{file}: is there already; overwrite=True replaces it")
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        try:
            part.open("xb").close()  # says now, not after the work, what is wrong with the folder
        except OSError as error:
            raise InputError(f"{file}: cannot be written: {error.strerror}") from error
        yield part
        os.replace(part, file)
    except OSError as error:
        if not _core.is_of_the_disk(error.errno or 0):
            raise
        raise InternalError(f"{file}: cannot be written: {error.strerror}") from error
    finally:
        part.unlink(missing_ok=True)
