# SPDX-License-Identifier: Apache-2.0
"""A limit on the wall time of a call into a plug-in.

One thread watches. What runs too long gets an exception: on the main thread by a signal, which ends
what sleeps or waits, too; on another at its next line of Python. What goes on all the same (it hangs
within somebody's C code, or catches everything) can be ended with its process alone. A campaign's
workers are: each tells of its calls, and until when it may live on (base/watched_call.h).
"""
from __future__ import annotations

import ctypes
import os
import signal
import threading
import time
from typing import Any, Callable, Dict, Optional

from . import _core

_POLL_S = 0.05
_MARGIN_S = 2.0  # beyond its limit a call may take so long to end, else its process is ended
_SIGNAL = signal.SIGRTMAX  # that nobody else sends


class PluginTimeout(BaseException):
    """Of no Exception class: a plug-in that catches all errors must not catch it."""


class _Limit:
    """Until when a call may go on; no longer than the one that it is made within."""

    def __init__(self, who: str, limit_s: float, outer: Optional["_Limit"]) -> None:
        self.who = who
        self.until, self.limit_s = time.monotonic() + limit_s, limit_s
        if outer is not None and outer.until < self.until:
            self.until, self.limit_s = outer.until, outer.limit_s
        self.outer = outer
        self.due = False  # the signal is for it
        self.sent = False  # its PluginTimeout is on its way, or has come

    def says(self) -> str:
        return f"took more than {self.limit_s:g} s (timeout_s)"

    def outermost(self) -> "_Limit":
        return self if self.outer is None else self.outer.outermost()

    def why(self) -> str:
        """What becomes of a TimeoutError that says so."""
        return f"{self.who} raised TimeoutError: {self.says()}"


_limits: Dict[int, _Limit] = {}  # the innermost one of each thread
_watcher: Optional[threading.Thread] = None
_lock = threading.Lock()
_signals = False  # whether _SIGNAL was asked for

overdue: Optional[Callable[[str], None]] = None
"""Where nobody else watches this process: told why it is to end, and ends it."""


def _is_main(thread: int) -> bool:
    return thread == threading.main_thread().ident


def _on_signal(*_: Any) -> None:
    limit = _limits.get(threading.get_ident())
    if limit is not None and limit.due and not limit.sent:
        limit.sent = True
        raise PluginTimeout


def _send(thread: int, what: Optional[type]) -> None:
    """None takes back what is on its way."""
    raised = None if what is None else ctypes.py_object(what)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)


def _end(thread: int, limit: _Limit) -> None:
    if _is_main(thread) and signal.getsignal(_SIGNAL) is _on_signal:
        # Again and again: it may come just before the thread begins to wait.
        limit.due = True
        signal.pthread_kill(thread, _SIGNAL)
    else:
        limit.sent = True
        _send(thread, PluginTimeout)


def _watch() -> None:
    while True:
        time.sleep(_POLL_S)
        now = time.monotonic()
        with _lock:
            for thread, limit in _limits.items():
                if now > limit.until and not limit.sent:
                    _end(thread, limit)
                first = limit.outermost()
                if overdue is not None and now > first.until + _MARGIN_S:
                    overdue(first.why())


def _after_fork() -> None:
    global _watcher, _lock
    _watcher, _lock = None, threading.Lock()
    _limits.clear()


os.register_at_fork(after_in_child=_after_fork)


def _enter(thread: int, limit: _Limit) -> None:
    global _watcher, _signals
    with _lock:
        if _watcher is None:
            _watcher = threading.Thread(target=_watch, name="floorproof-watchdog", daemon=True)
            _watcher.start()
        _limits[thread] = limit
    if _is_main(thread):
        if not _signals and signal.getsignal(_SIGNAL) is signal.SIG_DFL:
            signal.signal(_SIGNAL, _on_signal)
        _signals = True
        if limit.outer is None:
            _core.begin_call(limit.until + _MARGIN_S, limit.why())


def _leave(thread: int, limit: _Limit) -> None:
    """May be cut short by PluginTimeout, and called again."""
    with _lock:
        if _limits.get(thread) is limit and limit.sent:
            _send(thread, None)
        if limit.outer is None:
            _limits.pop(thread, None)
            if _is_main(thread):
                _core.end_call()
        else:
            _limits[thread] = limit.outer


def limited(who: str, limit_s: float, call: Callable[..., Any], *args: Any, **named: Any) -> Any:
    """call(...) of the plug-in `who`, ended with a TimeoutError when it takes longer than limit_s.
    Within a limited call the outer limit holds, too."""
    thread = threading.get_ident()
    limit = _Limit(who, limit_s, _limits.get(thread))
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
        raise TimeoutError(limit.says()) from None
