# SPDX-License-Identifier: Apache-2.0
"""Sites: floors with their hazards, from files or dicts."""
from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any, List, Mapping, Optional, Tuple, Union

import numpy as np

from . import _core
from ._checks import path_of
from ._results import Frame, Hazard, PathLike, Pose, frame_of, hazards_of
from ._yaml import yaml_text


class Site:
    """A floor with its hazards."""

    def __init__(self, about: Mapping[str, Any]) -> None:
        self.name: str = about["name"]
        self.frame: Frame = frame_of(about["frame"])
        self.occupancy: np.ndarray = about["occupancy"]
        """0 free, 1 occupied, 2 unknown."""
        self.hazards: List[Hazard] = hazards_of(about["hazards"])
        self.floor_friction: float = about["floor_friction"]
        self.start: Optional[Pose] = about["start"]
        self.goal: Optional[Tuple[float, float]] = about["goal"]

    @cached_property
    def _png(self) -> Optional[bytes]:
        from ._notebook import site_png
        return site_png(self, self.start)

    def _repr_png_(self) -> Optional[bytes]:
        return self._png

    def _repr_html_(self) -> str:
        from ._notebook import site_html
        return site_html(self)

    def __repr__(self) -> str:
        f = self.frame
        return (f"<Site {self.name}: {f.width * f.cell_m:.1f} m x {f.height * f.cell_m:.1f} m, "
                f"{len(self.hazards)} hazards>")


def load_site(source: Union[PathLike, Mapping[str, Any]], folder: Optional[PathLike] = None) -> Site:
    """Reads and checks a site: its file, or what would stand there as a dict, whose paths are
    relative to `folder` (default: the working directory)."""
    if isinstance(source, Mapping):
        return Site(_core.read_site(Path(folder or "") / "site", yaml_text(source)))
    return Site(_core.read_site(path_of("site", source), None))
