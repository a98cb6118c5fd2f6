# SPDX-License-Identifier: Apache-2.0
"""The limit on the wall time of a call: it ends the call, and nothing but the call."""
from __future__ import annotations

import ctypes
import random
import select
import subprocess
import sys
import threading
import time

import pytest

from floorproof import _watchdog
from floorproof._watchdog import PluginTimeout, limited


def spin(s: float) -> str:
    until = time.monotonic() + s
    while time.monotonic() < until:
        pass
    return "done"


@pytest.fixture
def often(monkeypatch):
    """The watcher looks so often, and threads change so fast, that its exception comes anywhere."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    monkeypatch.setattr(_watchdog, "_POLL_S", 1e-5)
    time.sleep(0.06)  # the sleep that it may be in
    yield
    sys.setswitchinterval(interval)


def test_what_comes_while_a_call_is_left_is_of_that_call(monkeypatch, often):
    class Slow:
        """A lock that takes long to get where a call has ended."""

        def __init__(self):
            self.lock, self.me, self.entered = threading.Lock(), threading.get_ident(), 0

        def __enter__(self):
            if threading.get_ident() == self.me:
                self.entered += 1
                if self.entered == 2:
                    spin(10)
            self.lock.acquire()

        def __exit__(self, *_):
            self.lock.release()

    limited("it", 1.0, spin, 0)  # the watcher is there
    monkeypatch.setattr(_watchdog, "_lock", Slow())
    with pytest.raises(TimeoutError, match=r"took more than 0.05 s \(timeout_s\)"):
        limited("it", 0.05, spin, 0)
    assert _watchdog._limits == {}
    assert limited("it", 1.0, spin, 0.1) == "done"


def test_calls_about_as_long_as_their_limit(often):
    draws = random.Random(0)
    ended = {"done": 0, TimeoutError: 0}
    until = time.monotonic() + 1
    while time.monotonic() < until:
        try:
            ended[limited("it", 2e-4, spin, draws.uniform(0, 4e-4))] += 1
        except TimeoutError as error:
            ended[type(error)] += 1
    assert min(ended.values()) > 0, "both ends were met"
    assert _watchdog._limits == {}
    assert spin(0.05) == "done", "nothing comes later"


def test_a_call_within_a_call(often):
    def outer(inner_limit_s: float, inner_s: float, rest_s: float) -> str:
        try:
            limited("it", inner_limit_s, spin, inner_s)
        except TimeoutError as error:
            told.append(str(error))
        return spin(rest_s)

    told: list = []
    assert limited("it", 5.0, outer, 0.05, 3.0, 0.05) == "done"
    assert told == ["took more than 0.05 s (timeout_s)"], "the inner one's"
    with pytest.raises(TimeoutError, match="0.1 s"):
        limited("it", 0.1, outer, 60.0, 3.0, 3.0)
    # Both limits end at one time, so the exception may come as the outer call's, which passes by
    # the handler within, or as the inner one's first.
    assert told[1:] in ([], ["took more than 0.1 s (timeout_s)"]), "the outer limit holds within, too"
    with pytest.raises(TimeoutError, match="0.1 s"):
        limited("it", 0.1, outer, 5.0, 0.0, 3.0)


def taken(seconds: float) -> None:
    lock = threading.Lock()
    with lock:
        lock.acquire(timeout=seconds)


@pytest.mark.parametrize("hang", [
    time.sleep, taken, lambda s: threading.Event().wait(s), lambda s: select.select([], [], [], s),
    lambda s: subprocess.run(["sleep", str(s)], check=False),
    lambda s: ctypes.CDLL(None).sleep(int(s)),
], ids=["sleep", "lock", "event", "select", "program", "C"])
def test_what_waits_is_ended_on_the_main_thread(hang):
    begin = time.monotonic()
    with pytest.raises(TimeoutError, match=r"took more than 0.1 s \(timeout_s\)"):
        limited("it", 0.1, hang, 30)
    assert time.monotonic() - begin < 15
    assert _watchdog._limits == {}
    time.sleep(0.1)  # nothing comes later


def test_on_another_thread_it_is_ended_at_its_next_line():
    ended = []

    def call():
        try:
            limited("it", 0.05, lambda: [time.sleep(0.01) for _ in range(3000)])
        except TimeoutError as error:
            ended.append(str(error))
    thread = threading.Thread(target=call)
    thread.start()
    thread.join(15)
    assert ended == ["took more than 0.05 s (timeout_s)"]


def test_what_a_call_raises_is_its_own():
    with pytest.raises(ZeroDivisionError):
        limited("it", 5.0, lambda: 1 / 0)
    assert not issubclass(PluginTimeout, Exception)
