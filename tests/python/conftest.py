# SPDX-License-Identifier: Apache-2.0
"""What the tests of the package share."""
from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any, Dict

import pytest

import floorproof


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes long; run with --slow")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--slow", action="store_true", help="run the slow tests too")


def pytest_collection_modifyitems(config: pytest.Config, items: list) -> None:
    if config.getoption("--slow"):
        return
    for item in items:
        if "slow" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="slow: --slow runs it"))


ROOM: Dict[str, Any] = {
    "scenario": 1,
    "name": "a room",
    "site": {
        "site": 1,
        "name": "room",
        "grid": {"cell_m": 0.5, "rows": "########\n#......#\n#......#\n#......#\n########\n"},
    },
    "start": {"x_m": 1.0, "y_m": 1.0},
    "robot": "beluga",
}


@pytest.fixture
def room() -> Dict[str, Any]:
    """A scenario on a small, empty floor, 3 m x 1.5 m, as a dict of one's own."""
    return copy.deepcopy(ROOM)


@pytest.fixture(scope="session")
def drawing(tmp_path_factory: pytest.TempPathFactory) -> floorproof.Scenario:
    """A scenario file: a short way whose start and floor are drawn, one that fails now and then."""
    folder = tmp_path_factory.mktemp("drawing")
    site = {**ROOM["site"], "hazards": [{"type": "step", "id": "ledge", "height_m": 0.012,
                                         "known": False,
                                         "polygon_m": [[1.6, 0.5], [1.9, 0.5], [1.9, 2], [1.6, 2]]}]}
    (folder / "site.yaml").write_text(json.dumps(site), encoding="utf-8")
    (folder / "plan.csv").write_text("x_m,y_m\n1,1\n2.4,1\n", encoding="utf-8")
    file = folder / "short.yaml"
    file.write_text(json.dumps({
        **ROOM, "site": "site.yaml", "plan": {"file": "plan.csv"}, "name": "a short way",
        "randomise": {"start.y_m": {"uniform": [0.95, 1.05]},
                      "site.floor.friction": {"uniform": [0.15, 0.8]}}}), encoding="utf-8")
    return floorproof.load(file)


@pytest.fixture(scope="session")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a short drive in which nothing fails."""
    folder = tmp_path_factory.mktemp("recorded") / "run"
    floorproof.load(ROOM).run([[1.0, 1.0], [1.1, 1.0]], out=folder)
    return folder


@pytest.fixture(scope="session")
def command_line() -> Path:
    """The program that the wheel's objects were built with."""
    program = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "floorproof"
    if not program.exists():
        pytest.skip(f"{program} is not built")
    return program
