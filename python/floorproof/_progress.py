# SPDX-License-Identifier: Apache-2.0
"""Progress, shaped as tqdm is: something made with `total`, `unit` and `desc` that has update(n) and
close()."""
from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

Progress = Union[None, bool, Callable[..., Any]]


def _bar(progress: Progress, **about: Any) -> Any:
    if progress is True:
        try:
            from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]
        except ImportError as error:
            raise ImportError("progress=True needs the package tqdm; or pass something with "
                              "update(n) and close()") from error
        return tqdm(**about)
    return progress(**about)  # type: ignore[operator,misc]


@contextmanager
def shown(progress: Progress, total: float, unit: str,
          desc: str) -> Iterator[Optional[Callable[[float], None]]]:
    """Gives a function that takes how much is done of `total`; None where nothing is to be shown."""
    if progress is None or progress is False:
        yield None
        return
    bar = _bar(progress, total=total, unit=unit, desc=desc)
    done = 0.0

    def show(now: float) -> None:
        nonlocal done
        if now > done:
            bar.update(now - done)
            done = now

    try:
        yield show
    finally:
        bar.close()
