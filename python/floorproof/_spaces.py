# SPDX-License-Identifier: Apache-2.0
"""The spaces of the Gymnasium environment: which numbers actions and observations are."""
from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np
from gymnasium import spaces

from . import _core


def action_names(bounds: _core.SpaceBounds) -> Tuple[str, ...]:
    """Of an action's numbers, in order."""
    return ("vx_mps", "vy_mps", "wz_radps") if bounds.holonomic else ("vx_mps", "wz_radps")


def action_space(bounds: _core.SpaceBounds) -> spaces.Box:
    """Twists (m/s, rad/s) within the robot's speeds."""
    most = np.array([bounds.max_speed_mps] * (len(action_names(bounds)) - 1)
                    + [bounds.max_yaw_rate_radps], dtype=np.float32)
    return spaces.Box(-most, most, dtype=np.float32)


def observation_space(bounds: _core.SpaceBounds, cells: int,
                      plan_points: Optional[int]) -> spaces.Dict:
    """Of docs/gym.md's table. cells: rows and columns of the local map. plan_points: that are told
    beside the one to head for; None: no plan is followed."""
    fast = np.array(bounds.fastest, dtype=np.float32)
    of: Dict[str, spaces.Space[Any]] = {
        "lidar": spaces.Box(0, bounds.lidar_m, (bounds.beams,), np.float32),
        "local_map": spaces.Box(0, 255, (3, cells, cells), np.uint8),
        "pose": spaces.Box(np.array([*bounds.low, -1, -1], np.float32),
                           np.array([*bounds.high, 1, 1], np.float32), dtype=np.float32),
        "twist": spaces.Box(-fast, fast, dtype=np.float32),
        "coverage": spaces.Box(0, 1, (1,), np.float32),
    }
    if plan_points is not None:
        of["plan_ahead"] = spaces.Box(-bounds.plan_m, bounds.plan_m, (2 + 2 * plan_points,),
                                      np.float32)
    return spaces.Dict(of)
