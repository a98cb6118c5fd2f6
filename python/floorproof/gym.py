# SPDX-License-Identifier: Apache-2.0
"""The Gymnasium environment `Floorproof-v0`: an episode that a policy drives (docs/gym.md).

    import gymnasium
    env = gymnasium.make("floorproof.gym:Floorproof-v0", scenario="scenario.yaml")

Actions are body twists, observations what the robot senses and believes, the reward is floor
covered; the scenario's detectors judge the drive as they judge every other.
"""
from __future__ import annotations

import json
from math import isfinite
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import gymnasium
import numpy as np

from . import _core
from ._checks import among, number, whole
from ._core import InputError
from ._results import Episode, Event, PathLike, episode_of, event_of
from ._scenario import Scenario, load
from ._spaces import action_names, action_space, observation_space
from ._warn import warn

__all__ = ["ID", "FloorproofEnv"]

ID = "Floorproof-v0"
if ID not in gymnasium.registry:
    # It checks its actions, and the order of calls, itself, and says what is wrong with them.
    gymnasium.register(ID, entry_point="floorproof.gym:FloorproofEnv", disable_env_checker=True,
                       order_enforce=False)

Observation = Dict[str, np.ndarray]
Info = Dict[str, Any]

# Ends that are none of the task's: the time is over, or the physics diverged.
_TRUNCATED = ("timeout", "error")


class FloorproofEnv(gymnasium.Env[Observation, np.ndarray]):
    """One robot on one scenario's floor.

    scenario: its file, a dict, or a Scenario. One without a lidar gets `sensors.lidar` with its
    defaults, and a warning that says so.
    reference: `plan`: the scenario's plan is made; leaving it is veer_off, its end ends the episode,
    and its next points are observed. None: the robot goes where the policy likes, and nothing is
    off it; the episode ends when success.min_coverage is reached (all, where that is 0).
    variant: of the scenario's matrix. The spaces are those of its episode (the scenario's key
    `episode`), and hold for all: where another does not fit in, its numbers are cut, with a
    warning; one with another number of beams, or of the action's numbers, is refused.
    max_time_s: simulated time (s); None: the scenario's time_limit_s.
    action_repeat: control periods (1 / control_hz) that an action holds for.
    coverage_reward: reward for the whole floor; a step earns the share that it covered.
    failure_penalty: taken off the reward of a step for each failure in it; 0 or more.
    local_map_cells, local_map_cell_m: rows and columns of the local map, and their width.
    plan_points, plan_step_m: points of the plan that are observed, beside the one that a tracker
    would head for, and the way between two.
    render_mode: None or rgb_array, width x height pixels (even), by camera auto, chase, top or side;
    quality: draft (no shadows) or full.

    Raises InputError, at the latest when it is reset.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 50}

    def __init__(self, scenario: Union[Scenario, PathLike, Mapping[str, Any]], *,
                 reference: Optional[str] = "plan", variant: Optional[str] = None,
                 max_time_s: Optional[float] = None, action_repeat: int = 1,
                 coverage_reward: float = 100.0, failure_penalty: float = 0.0,
                 local_map_cells: int = 40, local_map_cell_m: float = 0.1, plan_points: int = 6,
                 plan_step_m: float = 0.25, render_mode: Optional[str] = None, width: int = 480,
                 height: int = 270, camera: str = "auto", quality: str = "draft") -> None:
        self._core: Optional[_core.Stepped] = None
        self._views: List[Tuple[str, np.ndarray]] = []  # of what lies in it, which lives as long
        self._state: np.ndarray = np.zeros(5)  # another: time, coverage, true pose
        self._events: List[Event] = []
        self._closed = False
        self._ended = ""  # why nothing can be stepped; empty: it can
        among("reference", reference, ("plan", None))
        among("render_mode", render_mode, (None, *self.metadata["render_modes"]))
        among("camera", camera, ("auto", "chase", "top", "side"))
        among("quality", quality, ("draft", "full"))
        self._follows = reference == "plan"
        self._variant = variant
        self._repeat = whole("action_repeat", action_repeat, 1, 100000)
        self._reward = number("coverage_reward", coverage_reward)
        self._penalty = number("failure_penalty", failure_penalty, least=0)
        self._outlook = (whole("local_map_cells", local_map_cells, 1),
                         number("local_map_cell_m", local_map_cell_m),
                         whole("plan_points", plan_points, 1, 1000),
                         number("plan_step_m", plan_step_m, least=0.01))
        self.render_mode = render_mode
        self._picture = (whole("width", width, 64), whole("height", height, 64), camera,
                         quality == "draft")
        for name, pixels in (("width", width), ("height", height)):
            if pixels % 2:
                raise InputError(f"{name} = {pixels}: must be even")

        self.scenario = _with_what_it_needs(scenario, variant, max_time_s)
        self.metadata = {**self.metadata,
                         "render_fps": max(1, round(self.scenario.control_hz / self._repeat))}
        self.episode: Optional[Episode] = None
        """The last episode, once it has ended: trace, events, metrics, maps."""
        self._cuts = False  # whether it was said that the spaces do not hold all
        self._plan: Tuple[str, Any] = ("", None)  # what it follows from, and the plan
        self._spaces: Optional[_core.SpaceBounds] = None  # of the first episode
        self._begin(self.scenario._file.episode, variant)
        assert self._core is not None
        self._spaces = self._core.bounds
        self._names: Tuple[str, ...] = action_names(self._spaces)
        self.action_space = action_space(self._spaces)
        self.observation_space = observation_space(
            self._spaces, self._outlook[0], self._outlook[2] if self._follows else None)
        self._ended = "reset() comes first"

    # --- Gymnasium's calls

    def reset(self, *, seed: Optional[int] = None,
              options: Optional[Mapping[str, Any]] = None) -> Tuple[Observation, Info]:
        """Begins an episode. seed: the episode of this number (modulo 1e8 + 1), with its draws as
        a campaign has them: the same number, the same bytes. Without one, the next of a sequence
        that the last seed began. options: `episode` and `variant` name what is driven."""
        self._open()
        super().reset(seed=seed)
        if not isinstance(options, (Mapping, type(None))):
            raise InputError(f"options = {options!r}: must be a dict with episode or variant")
        asked = dict(options or {})
        episode, variant = asked.pop("episode", None), asked.pop("variant", self._variant)
        if asked:
            raise InputError(f"options.{next(iter(asked))}: unknown (known: episode, variant)")
        if episode is not None:
            episode = whole("options.episode", episode, 0, _core.MOST_EPISODES)
        elif seed is not None:
            episode = seed % (_core.MOST_EPISODES + 1)
        else:
            episode = int(self.np_random.integers(_core.MOST_EPISODES + 1))
        self._begin(episode, variant)
        info = self._info()
        info["episode_id"] = episode
        info["variant"] = variant or ""
        return self._observe(), info

    def step(self, action: Any) -> Tuple[Observation, float, bool, bool, Info]:
        """Asks for a twist for `action_repeat` control periods."""
        core = self._running()
        vx_mps, vy_mps, wz_radps = self._twist(action)
        before, failures = self._share, self._num_events
        outcome = core.step(vx_mps, vy_mps, wz_radps, self._repeat)
        observation = self._observe()
        info = self._info()
        reward = (self._reward * (self._share - before)
                  - self._penalty * (self._num_events - failures))
        if outcome is None:
            return observation, reward, False, False, info
        self._end(info)
        truncated = outcome in _TRUNCATED
        return observation, reward, not truncated, truncated, info

    def render(self) -> Optional[np.ndarray]:
        """The drive as it stands, [height, width, 3]; without a render_mode None."""
        self._open()
        if self.render_mode is None:
            gymnasium.logger.warn("render() without a render_mode draws nothing; give make() "
                                  'render_mode="rgb_array"')
            return None
        if self._core is None:
            raise InputError("render(): reset() comes first")
        picture: np.ndarray = self._core.render(*self._picture)
        return picture

    def close(self) -> None:
        """Frees physics and pictures; another call than close() is refused from then on."""
        self._closed = True
        self._free()
        self._plan = ("", None)

    # --- of this environment alone

    @property
    def lidar_angles(self) -> np.ndarray:
        """Of the beams (rad), from straight ahead, counterclockwise."""
        return self._angles

    # --- inside

    def _free(self) -> None:
        self._core, self._views, self._state = None, [], np.zeros(5)

    def _begin(self, episode: int, variant: Optional[str]) -> None:
        self._free()  # what is over, before what comes
        self.episode = None
        self._ended = "reset() failed: it comes first again"
        made = self.scenario._file.read(episode, variant)
        plan = None
        if self._follows:
            inputs = made.plan_inputs
            if self._plan[0] != inputs:
                self._plan = (inputs, made.make_plan())
            plan = self._plan[1]
        core = _core.Stepped(made, plan, *self._outlook, self.render_mode is not None,
                             self._spaces)
        if core.lacks and not self._cuts:
            self._cuts = True
            warn(f"{self.scenario.name}, episode {episode}: the observation space is too small for "
                 f"{core.lacks}, which is cut to its ends; it is that of the episode and variant "
                 "with which the environment was made")
        self._angles = np.asarray(core.lidar_angles)
        names = ["lidar", "local_map", "pose", "twist", "coverage"]
        if self._follows:
            names.append("plan_ahead")
        self._views = [(name, getattr(core, name)) for name in names]
        self._state = np.asarray(core.state)
        self._core = core
        self._share = float(self._state[1])
        self._num_events, self._events = 0, []
        self._ended = ""

    def _open(self) -> None:
        if self._closed:
            raise InputError("the environment is closed: make another")

    def _running(self) -> _core.Stepped:
        self._open()
        if self._ended or self._core is None:
            raise InputError(f"step(): {self._ended}")
        return self._core

    def _twist(self, action: Any) -> Tuple[float, float, float]:
        names = self._names
        try:
            values = (action if isinstance(action, np.ndarray) and action.dtype.kind == "f"
                      else np.asarray(action, dtype=np.float64))
        except (TypeError, ValueError) as error:
            raise InputError(f"action = {action!r}: must be {len(names)} numbers: "
                             f"{', '.join(names)}") from error
        if values.shape != (len(names),):
            raise InputError(f"action: an array of shape {values.shape}: must be [{len(names)}]: "
                             f"{', '.join(names)}")
        numbers: List[float] = values.tolist()
        for name, value in zip(names, numbers):
            if not isfinite(value):
                raise InputError(f"action.{name} = {value}: must be finite")
        if len(numbers) == 2:
            return numbers[0], 0.0, numbers[1]
        return numbers[0], numbers[1], numbers[2]

    def _observe(self) -> Observation:
        # Copies: the next step changes what is looked at here.
        return {name: view.copy() for name, view in self._views}

    def _info(self) -> Info:
        core = self._core
        assert core is not None
        if core.num_events != self._num_events:
            self._events = [event_of(e) for e in json.loads(core.events)]
            self._num_events = core.num_events
        state = self._state.copy()
        self._share = float(state[1])
        return {"t_s": float(state[0]), "coverage": self._share, "truth": state[2:],
                "events": self._events}

    def _end(self, info: Info) -> None:
        core = self._core
        assert core is not None
        self._ended = "the episode has ended: reset() begins another"
        self.episode = episode_of(core.finished)
        info["outcome"] = self.episode.outcome
        info["message"] = self.episode.message
        info["failure"] = dict(self._events[-1].evidence) if self._events else {}
        info["metrics"] = self.episode.metrics


def _with_what_it_needs(source: Union[Scenario, PathLike, Mapping[str, Any]],
                        variant: Optional[str], max_time_s: Optional[float]) -> Scenario:
    scenario = source if isinstance(source, Scenario) else load(source)
    driven = scenario if variant is None else scenario.episode(scenario._file.episode, variant)
    changes: Dict[str, Any] = {}
    if max_time_s is not None:
        changes["time_limit_s"] = number("max_time_s", max_time_s)
    if "lidar" not in driven.sensors:
        changes["sensors.lidar"] = {}
        warn(f"{scenario.name} has no lidar, which is observed: sensors.lidar is added with its "
             "defaults")
    return scenario.with_(changes) if changes else scenario
