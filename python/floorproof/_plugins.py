# SPDX-License-Identifier: Apache-2.0
"""Planners and trackers of one's own, named in scenarios as the built-in ones are.

    @floorproof.planner("rows")
    def rows(request, spacing_m: float = 0.4):
        ...
        return path                     # [n, 2] to [n, 5], see Plan.path

    floorproof.load({..., "plan": {"planner": "rows", "spacing_m": 0.3}})

Parameters with defaults are keys of the scenario: checked, documented and recorded as all are.
"""
from __future__ import annotations

import inspect
import math
import re
from types import SimpleNamespace
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple

import numpy as np

from . import _core
from ._core import InputError
from ._results import Frame, Pose, frame_of, hazards_of
from ._watchdog import limited

_KINDS = (bool, int, float, str)
_INT32 = range(-(1 << 31), 1 << 31)

# What was registered here, by kind and name: what workers elsewhere must be given, too.
registered: Dict[Tuple[str, str], Tuple[Any, Mapping[str, Any]]] = {}


def _row(name: str, default: Any, help_: str = "") -> Tuple[str, Any, str]:
    if not isinstance(default, _KINDS):
        raise TypeError(f"parameter {name} = {default!r}: its default must be a bool, int, float or "
                        "str")
    if isinstance(default, float) and not math.isfinite(default):
        raise TypeError(f"parameter {name} = {default}: its default must be finite, as values are")
    if isinstance(default, int) and default not in _INT32:
        raise TypeError(f"parameter {name} = {default}: a whole number must lie within 32 bits; "
                        "make it a float or a str")
    return (name, default, help_)


def _checked_timeout_s(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0 < value < math.inf:
        raise InputError(f"timeout_s = {value}: must be > 0 and finite (s)")
    return float(value)


class _Wrapped:
    """What the C++ side calls: parameters, promises, and the user's own object or function."""

    def __init__(self, who: str, made: Any, is_object: bool, params: Mapping[str, Any],
                 promises: Mapping[str, Any]) -> None:
        self._who = who
        self._made, self._is_object, self._promises = made, is_object, promises
        self._params: Dict[str, Any] = {}
        self._timeout_s = _checked_timeout_s(promises["timeout_s"])
        # The defaults too, as they are what is recorded: a constructor may have set others.
        for name, value in params.items():
            self._give(name, value)

    def params(self) -> List[Tuple[str, Any, str]]:
        rows = [_row(n, v) for n, v in self._params.items()]
        rows.append(("timeout_s", self._timeout_s, "wall time that a call may take (s)"))
        return rows

    def set(self, name: str, value: Any) -> None:
        if name == "timeout_s":
            self._timeout_s = _checked_timeout_s(value)
        else:
            self._give(name, value)

    def promises(self) -> Mapping[str, Any]:
        return self._promises

    def _give(self, name: str, value: Any) -> None:
        self._params[name] = value
        if self._is_object:
            setattr(self._made, name, value)

    def _ask(self, method: str, *args: Any) -> Any:
        """Calls the object's method, or the function with its parameters."""
        if self._is_object:
            return limited(self._who, self._timeout_s, getattr(self._made, method), *args)
        return limited(self._who, self._timeout_s, self._made, *args, **self._params)

    def _tell_start(self, *args: Any) -> None:
        if self._is_object and hasattr(self._made, "start"):
            self._ask("start", *args)


class Request(SimpleNamespace):
    """What a planner gets: the floor as far as it is known, and the robot.

    frame, walls: the map's cells; obstacle_frame, obstacles: finer cells (0.05 m at most) that the
    robot must keep off, hazards included; risk_frame, risk: the risk factor of each cell; hazards;
    robot: a dict as Scenario.robot; start: a pose; goal: a point or None; seed."""


def _request(about: Mapping[str, Any]) -> Request:
    named = dict(about)
    for name in ("frame", "obstacle_frame", "risk_frame"):
        if name in named:
            named[name] = frame_of(named[name])
    named["hazards"] = hazards_of(named["hazards"])
    return Request(**named)


class _Planner(_Wrapped):
    def plan(self, about: Mapping[str, Any]) -> Tuple[Optional[np.ndarray], str]:
        answer = self._ask("plan", _request(about))
        if answer is None:
            return None, "the planner found no plan"
        if isinstance(answer, str):
            return None, answer
        rows = np.ascontiguousarray(answer, dtype=float)
        if rows.ndim != 2:
            raise ValueError(f"a path of shape {rows.shape}: must be [n, 2] to [n, 5]: x_m, y_m, "
                             "yaw_rad, speed_mps, dwell_s")
        return rows, ""


class Task(SimpleNamespace):
    """What a planner of unknown floors is told before the drive: frame (of the map that the robot
    draws), start, clear_half_m, tool_half_m, body_half_m (half sizes), tool_width_m, radius_m,
    step_m, seed."""


class Known:
    """What a planner of unknown floors goes by; of this call alone."""

    def __init__(self, core: Any) -> None:
        self._core = core
        self.pose: Pose = core.pose
        """As the robot believes; shortly before a target is reached, that target."""
        self.bumped: bool = core.bumped
        self.dropped: bool = core.dropped
        self.missed: bool = core.missed
        self.stopped: bool = core.stopped

    @property
    def cells(self) -> np.ndarray:
        """The map that the robot has drawn: 0 free, 1 occupied, 2 unknown."""
        cells: np.ndarray = self._core.cells
        return cells

    @property
    def frame(self) -> Frame:
        return frame_of(self._core.frame)


class _OnlinePlanner(_Wrapped):
    def start(self, about: Mapping[str, Any]) -> None:
        named = dict(about)
        named["frame"] = frame_of(named["frame"])
        self._tell_start(Task(**named))

    def next(self, known: Any) -> Tuple[Optional[Tuple[float, float]], str, bool]:
        answer = self._ask("next", Known(known))
        if answer is None:
            return None, "all is covered that it knows of and can reach", True
        if isinstance(answer, str):
            return None, answer, False
        x_m, y_m = answer
        return (float(x_m), float(y_m)), "", False


class Situation(SimpleNamespace):
    """What a tracker decides by, once a control period: t_s, pose and twist (as the robot believes),
    segment (of the path), target (a point ahead on it), speed_mps (that the way ahead allows)."""


class _Tracker(_Wrapped):
    def start(self, path: np.ndarray, robot: Mapping[str, Any]) -> None:
        self._tell_start(path, robot)

    def update(self, t_s: float, pose: Any, twist: Any, segment: int, target: Any,
               speed_mps: float) -> Tuple[float, float, float]:
        vx_mps, vy_mps, wz_radps = self._ask("update", Situation(
            t_s=t_s, pose=pose, twist=twist, segment=segment, target=target, speed_mps=speed_mps))
        return float(vx_mps), float(vy_mps), float(wz_radps)


def _of_class(kind: str, made: Any, method: str) -> Dict[str, Any]:
    """The parameters of a class: its annotated attributes."""
    if not callable(getattr(made, method, None)):
        raise TypeError(f"{made.__name__}: has no {method}(...), which the kind {kind} needs")
    try:
        inspect.signature(made).bind()
    except ValueError:
        pass  # not written in Python; it may well be made without arguments
    except TypeError as error:
        raise TypeError(f"{made.__name__}: must be made without arguments: {error}") from error
    return {name: getattr(made, name) for base in reversed(made.__mro__)
            for name in base.__dict__.get("__annotations__", {})
            if not name.startswith("_") and hasattr(made, name)}


def _of_function(made: Any) -> Dict[str, Any]:
    """The parameters of what is called as a function is: what follows its first."""
    if not callable(made):
        raise TypeError(f"{made!r}: must be a function or a class")
    try:
        first, *rest = inspect.signature(made).parameters.values()
    except ValueError as error:  # what is written in C says nothing; one without any has no first
        raise TypeError(f"{made!r}: must be a function of one argument (and parameters with "
                        "defaults); wrap it in one") from error
    if first.kind in (first.KEYWORD_ONLY, first.VAR_KEYWORD):
        raise TypeError(f"{made!r}: must take its first argument by position")
    for p in rest:
        if p.kind not in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY):
            raise TypeError(f"parameter {p}: must be one that is given by its name, the key's")
        if p.default is p.empty:
            raise TypeError(f"parameter {p.name}: needs a default, which is the key's")
    return {p.name: p.default for p in rest}


# Keys that stand beside a plug-in's own, by kind.
_PLAN_KEYS = ("planner", "command", "file", "timeout_s")
_TAKEN = {"planner": _PLAN_KEYS, "online_planner": (*_PLAN_KEYS, "radius_m", "step_m", "speed_mps"),
          "tracker": ("name", "timeout_s")}

# By kind: the wrapper, the method of a class, what errors call it, and who is told.
_REGISTER = {"planner": (_Planner, "plan", "planner", _core.register_planner),
             "online_planner": (_OnlinePlanner, "next", "planner", _core.register_online_planner),
             "tracker": (_Tracker, "update", "controller", _core.register_tracker)}


def register(kind: str, name: str, made: Any, promises: Mapping[str, Any]) -> None:
    """Makes `made`, a class or what is called as a function is, the plug-in `name`. Throws TypeError
    where it cannot be one."""
    wrapper, method, called, tell = _REGISTER[kind]
    if not isinstance(name, str) or not re.fullmatch(r"\w[\w.-]{0,99}", name):
        raise InputError(f"{kind} {name!r}: a name has letters, digits, _, - and ., 100 at most")
    is_object = inspect.isclass(made)
    if not is_object and kind == "online_planner":
        raise TypeError(f"{made!r}: must be a class with {method}(...)")
    params = _of_class(kind, made, method) if is_object else _of_function(made)
    for param, default in params.items():
        _row(param, default)
        if param in _TAKEN[kind]:
            raise TypeError(f"parameter {param}: is another key's name already, beside this plug-in's "
                            "own; give it another one")
    _checked_timeout_s(promises["timeout_s"])

    def make() -> Any:
        return wrapper(f"{called} {name}", made() if is_object else made, is_object, params, promises)

    tell(name, make)
    registered[kind, name] = (made, dict(promises))


def planner(name: str, *, needs_risk: bool = False, needs_goal: bool = False,
            uses_seed: bool = False, timeout_s: float = 60) -> Callable[[Any], Any]:
    """Registers a planner of known floors: a function of a Request (and parameters with defaults; a
    partial or another callable will do), or a class whose plan(request) is called. It returns a path
    ([n, 2] to [n, 5], see Plan.path), or None or a sentence that says why there is none.
    `uses_seed`: its plan depends on request.seed, so that each episode of a campaign is planned
    anew."""
    def decorate(made: Any) -> Any:
        register("planner", name, made, {"needs_risk": needs_risk, "needs_goal": needs_goal,
                                         "uses_seed": uses_seed, "timeout_s": timeout_s})
        return made
    return decorate


def online_planner(name: str, *, uses_seed: bool = False, covers_all: bool = True,
                   timeout_s: float = 60) -> Callable[[Any], Any]:
    """Registers a planner of unknown floors: a class with next(known), which says where to go from
    here: a point (x_m, y_m), None when all is done, or a sentence that says why there is nowhere to
    go. start(task), if it has one, comes first. `known`: pose, cells (0 free, 1 occupied, 2 unknown)
    on frame, bumped, dropped, missed, stopped."""
    def decorate(made: Any) -> Any:
        register("online_planner", name, made,
                 {"uses_seed": uses_seed, "covers_all": covers_all, "timeout_s": timeout_s})
        return made
    return decorate


def tracker(name: str, *, timeout_s: float = 10) -> Callable[[Any], Any]:
    """Registers a path tracker: a function of a Situation (and parameters with defaults), or a class
    with update(situation), that returns the body's twist (vx_mps, vy_mps, wz_radps), asked for
    within the robot's speeds and accelerations. start(path, robot), if the class has one, comes
    first. How far along the path the robot is, stops and dwells are kept for it."""
    def decorate(made: Any) -> Any:
        register("tracker", name, made, {"timeout_s": timeout_s})
        return made
    return decorate
