# SPDX-License-Identifier: Apache-2.0
"""A limit on the wall time of a call into a plug-in.

One thread watches. What runs too long gets an exception at its next line of Python; a call that hangs
within somebody's C code cannot be ended so (a planner that is a program of its own can: plan.command).
"""
from __future__ import annotations

import ctypes
import os
import threading
import time
from typing import Any, Callable, Dict

_POLL_S = 0.05


class PluginTimeout(BaseException):
    """Of no Exception class: a plug-in that catches all errors must not catch it."""


_deadlines: Dict[int, float] = {}  # by thread
_watcher: Any = None
_lock = threading.Lock()


def _watch() -> None:
    while True:
        time.sleep(_POLL_S)
        now = time.monotonic()
        with _lock:
            late = [thread for thread, until in _deadlines.items() if now > until]
            for thread in late:
                del _deadlines[thread]
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread),
                                                           ctypes.py_object(PluginTimeout))


def _start() -> None:
    global _watcher
    _watcher = threading.Thread(target=_watch, name="floorproof-watchdog", daemon=True)
    _watcher.start()


def _after_fork() -> None:
    global _watcher, _lock
    _watcher, _lock = None, threading.Lock()
    _deadlines.clear()


os.register_at_fork(after_in_child=_after_fork)


def limited(limit_s: float, call: Callable[..., Any], *args: Any, **named: Any) -> Any:
    """call(...), ended with a TimeoutError when it takes longer than limit_s."""
    thread = threading.get_ident()
    outer = _deadlines.get(thread)
    with _lock:
        if _watcher is None:
            _start()
        _deadlines[thread] = time.monotonic() + limit_s
    try:
        return call(*args, **named)
    except PluginTimeout:
        raise TimeoutError(f"took more than {limit_s:g} s (timeout_s)") from None
    finally:
        with _lock:
            _deadlines.pop(thread, None)
            if outer is not None:
                _deadlines[thread] = outer
