# SPDX-License-Identifier: Apache-2.0
"""Floorproof: drives a floor robot's plan through physics before the robot drives it over a floor.

    import floorproof

    scenario = floorproof.load("scenario.yaml")          # or a dict
    plan = scenario.plan()
    episode = scenario.run(plan)
    print(episode.outcome, episode.metrics["coverage"])

Errors are exceptions with the command line's text: `InputError` for what a user can mend,
`InternalError` where the tool or the physics broke. Lengths are metres, angles radians, times
seconds; poses are (x_m, y_m, yaw_rad) in the world frame, x right, y up. Maps are arrays
[height, width] whose row 0 is the lowest.
"""
import importlib
from typing import TYPE_CHECKING, Any

from ._core import InputError, InternalError, __version__
from . import _errors
from ._campaign import Campaign, campaign, merge, report
from ._plugins import online_planner, planner, tracker
from ._results import Episode, Event, Frame, Hazard, Plan, read
from ._models import models_folder
from ._scenario import Scenario, load
from ._site import Site, load_site

if TYPE_CHECKING:
    from . import cluster, exports, gym
    from ._mcap import to_mcap

__all__ = [
    "Campaign", "Episode", "Event", "Frame", "Hazard", "InputError", "InternalError", "Plan",
    "Scenario", "Site", "__version__", "campaign", "load", "load_site", "merge", "models_folder",
    "online_planner", "planner", "read", "report", "to_mcap", "tracker",
]


def __getattr__(name: str) -> Any:
    # What needs a package of its own is imported when it is asked for.
    if name == "to_mcap":
        from .exports import to_mcap
        return to_mcap
    if name in ("cluster", "exports", "gym"):
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module 'floorproof' has no attribute {name!r}")
