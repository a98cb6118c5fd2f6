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
from typing import Any, Callable, Dict, Optional

_POLL_S = 0.05


class PluginTimeout(BaseException):
    """Of no Exception class: a plug-in that catches all errors must not catch it."""


class _Limit:
    """Until when a call may go on; no longer than the one that it is made within."""

    def __init__(self, limit_s: float, outer: Optional["_Limit"]) -> None:
        self.until, self.limit_s = time.monotonic() + limit_s, limit_s
        if outer is not None and outer.until < self.until:
            self.until, self.limit_s = outer.until, outer.limit_s
        self.outer = outer
        self.sent = False  # its PluginTimeout is on its way, or has come


_limits: Dict[int, _Limit] = {}  # the innermost one of each thread
_watcher: Optional[threading.Thread] = None
_lock = threading.Lock()


def _send(thread: int, what: Optional[type]) -> None:
    """None takes back what is on its way."""
    raised = None if what is None else ctypes.py_object(what)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)


def _watch() -> None:
    while True:
        time.sleep(_POLL_S)
        now = time.monotonic()
        with _lock:
            for thread, limit in _limits.items():
                if now > limit.until and not limit.sent:
                    limit.sent = True
                    _send(thread, PluginTimeout)


def _after_fork() -> None:
    global _watcher, _lock
    _watcher, _lock = None, threading.Lock()
    _limits.clear()


os.register_at_fork(after_in_child=_after_fork)


def _enter(thread: int, limit: _Limit) -> None:
    global _watcher
    with _lock:
        if _watcher is None:
            _watcher = threading.Thread(target=_watch, name="floorproof-watchdog", daemon=True)
            _watcher.start()
        _limits[thread] = limit


def _leave(thread: int, limit: _Limit) -> None:
    """May be cut short by PluginTimeout, and called again."""
    with _lock:
        if _limits.get(thread) is limit and limit.sent:
            _send(thread, None)
        if limit.outer is None:
            _limits.pop(thread, None)
        else:
            _limits[thread] = limit.outer


def limited(limit_s: float, call: Callable[..., Any], *args: Any, **named: Any) -> Any:
    """call(...), ended with a TimeoutError when it takes longer than limit_s. Within a limited call
    the outer limit holds, too."""
    thread = threading.get_ident()
    limit = _Limit(limit_s, _limits.get(thread))
    try:
        try:
            _enter(thread, limit)
            return call(*args, **named)
        finally:
            _leave(thread, limit)
    except PluginTimeout:
        # It comes once, between any two steps: maybe of the line above, which it cut short.
        _leave(thread, limit)
        if limit.outer is not None and limit.outer.sent:
            raise  # the outer one's, which came when this call had ended
        raise TimeoutError(f"took more than {limit.limit_s:g} s (timeout_s)") from None
