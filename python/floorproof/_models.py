# SPDX-License-Identifier: Apache-2.0
"""Where the bundled models lie: in the package, or in the folder that it was built from."""
from __future__ import annotations

from pathlib import Path

from . import _core

_PACKAGED = Path(__file__).resolve().parent / "models"
if _PACKAGED.is_dir():
    _core.set_models_folder(_PACKAGED)


def models_folder() -> Path:
    """Where the bundled models lie: robots, sites, scenarios, FMEA tables."""
    return _core.models_folder()
