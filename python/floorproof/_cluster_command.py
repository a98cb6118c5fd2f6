# SPDX-License-Identifier: Apache-2.0
"""`python -m floorproof.cluster`: `floorproof campaign` on a Ray cluster, without films."""
from __future__ import annotations

import argparse
import json
import sys
import time
import warnings
from pathlib import Path
from typing import Any, Dict, Optional, Sequence, Tuple

from . import _core
from ._campaign import Campaign, campaign
from ._scenario import Scenario

# As the command line's (base/exit_status.h).
_BAD_INPUT, _BROKEN, _INTERRUPTED = 2, 3, 130
_SAY_S = 10.0


class _Line:
    """How far it is, on stderr: once a second on a terminal, else every ten."""

    def __init__(self, total: float, unit: str, desc: str) -> None:
        self._total, self._unit, self._done = int(total), unit, 0
        self._began = self._said = time.monotonic()
        self._every = 1.0 if sys.stderr.isatty() else _SAY_S

    def update(self, n: float) -> None:
        self._done += int(n)
        now = time.monotonic()
        if now - self._said < self._every:
            return
        self._said = now
        rate = self._done / (now - self._began)
        print(f"  {self._done} of {self._total} {self._unit}s, {rate:.1f} a second",
              file=sys.stderr, flush=True)

    def close(self) -> None:
        pass


def _episodes(text: str) -> Tuple[int, int]:
    begin, colon, end = text.partition(":")
    if not colon or not begin.isdecimal() or not end.isdecimal():
        raise argparse.ArgumentTypeError(
            f"{text}: must be A:B, the first id and the one behind the last")
    return int(begin), int(end)


def _pair(text: str) -> Tuple[str, str]:
    key, equals, value = text.partition("=")
    if not equals or not key:
        raise argparse.ArgumentTypeError(f"{text}: must be KEY=VALUE")
    return key, value


def _json_object(text: str) -> Dict[str, Any]:
    try:
        value = json.loads(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text}: is no JSON: {error}") from error
    if not isinstance(value, dict):
        raise argparse.ArgumentTypeError(f"{text}: must be a JSON object")
    return value


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m floorproof.cluster",
        description="Drive many episodes on a Ray cluster: the folder is the one that `floorproof "
                    "campaign --no-films` writes, the same bytes.")
    add = parser.add_argument
    add("scenario", metavar="SCENARIO", type=Path,
        help="Scenario file (YAML), on this machine alone")
    add("-n", type=int, required=True, help="Episodes a variant")
    add("--out", type=Path, required=True, help="Output folder, on this machine alone")
    add("--address", help="The cluster's, as ray.init takes it; auto: the one that this machine is "
                          "part of (default: RAY_ADDRESS, else a cluster on this machine alone)")
    add("--runtime-env", type=_json_object, metavar="JSON", help="Ray's runtime environment")
    add("--cpus", type=float, default=1, metavar="C", help="CPUs that a task takes (default: 1)")
    add("--batch", type=float, default=0.75, metavar="S",
        help="Seconds of work a task (default: 0.75)")
    add("--seed", type=int, help="Overrides the scenario's seed")
    add("--set", type=_pair, action="append", default=[], metavar="KEY=VALUE",
        help="Sets a key of the scenario; may be repeated")
    add("--episodes", type=_episodes, metavar="A:B",
        help="Ids from A to before B only: a shard for `floorproof merge`, which judges the gate")
    add("--resume", action="store_true", help="Go on with the campaign that the folder holds")
    add("--retry-errors", action="store_true",
        help="With --resume: drive again what ended in an error")
    add("--fail-fast", action="store_true", help="End at the first episode that fails (status 1)")
    add("--time-limit", type=float, metavar="S", help="Seconds of wall time")
    add("--json", action="store_true", help="Print summary.json on stdout instead of the rates")
    add("--trust", action="store_true",
        help="Let the scenario run the program that it names and read files outside its folder")
    add("--quiet", action="store_true", help="Print nothing but errors (and --json)")
    return parser


def _run(options: argparse.Namespace) -> int:
    overrides = list(options.set)
    if options.seed is not None:
        overrides.append(("seed", str(options.seed)))
    scenario = Scenario((options.scenario, options.trust, None, overrides, []))
    made = campaign(
        scenario, options.n, out=options.out, engine="ray", episodes=options.episodes,
        resume=options.resume, retry_errors=options.retry_errors, fail_fast=options.fail_fast,
        time_limit_s=options.time_limit, progress=None if options.quiet else _Line,
        address=options.address, runtime_env=options.runtime_env, num_cpus=options.cpus,
        batch_s=options.batch)
    if options.json:
        print(json.dumps(made.summary))
    elif not options.quiet:
        print("\n".join(made._lines))
        if options.episodes is not None:
            print("a shard: `floorproof merge` judges the gate of all")
    assert made._status is not None  # it was driven
    return made._status


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns its exit status."""
    options = _parser().parse_args(arguments)

    def say(message: Any, *_: Any) -> None:
        if not options.quiet:
            print(message, file=sys.stderr)

    try:
        with warnings.catch_warnings():
            warnings.showwarning = say  # type: ignore[assignment]
            warnings.simplefilter("always", UserWarning)
            return _run(options)
    except _core.InputError as error:
        print(f"floorproof: {error}", file=sys.stderr)
        return _BAD_INPUT
    except _core.InternalError as error:
        print(f"floorproof: {error}", file=sys.stderr)
        return _BROKEN
    except KeyboardInterrupt:
        print(f"floorproof: interrupted: {options.out} holds every episode saved so far; --resume "
              "goes on", file=sys.stderr)
        return _INTERRUPTED
