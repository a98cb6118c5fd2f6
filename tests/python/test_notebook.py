# SPDX-License-Identifier: Apache-2.0
"""What notebooks show: pages that hold all they need, that quote nothing as markup, and that never
raise."""
from __future__ import annotations

import base64
import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any, Dict, List, Set

import numpy as np
import pytest

import floorproof
from floorproof import _site_picture

NASTY = "<script>alert('&\"')</script>"
ROOM: Dict[str, Any] = {
    "scenario": 1, "robot": "beluga", "name": "a room",
    "site": {"site": 1, "name": NASTY,
             "grid": {"cell_m": 0.5, "rows": "########\n#......#\n#......#\n#......#\n########\n"},
             "hazards": [{"type": "glass", "id": "pane", "line_m": [[2.2, 0.5], [2.2, 1.6]],
                          "height_m": 1.0, "known": False}]},
    "start": {"x_m": 1.0, "y_m": 1.0},
}
CELLS: Dict[str, Any] = {
    "scenario": 1, "robot": "beluga", "plan": "rolling_window", "drive": "cells",
    "site": {"site": 1, "generate": {"kind": "room", "cells": [8, 8]}}}


class Page(HTMLParser):
    """What a page is made of; asserts that what it opens it closes."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: Set[str] = set()
        self.text = ""
        self.images: List[bytes] = []
        self._open: List[str] = []
        self.feed(html)
        self.close()
        assert not self._open

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.tags.add(tag)
        for name, value in attrs:
            assert name in ("style", "src", "alt"), name
            assert not re.search(r"https?:|javascript:|url\(", value), value
            if name == "src":
                kind, data = value.split(",")
                assert kind == "data:image/png;base64"
                self.images.append(base64.b64decode(data, validate=True))
        if tag not in ("img", "br"):
            self._open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data + " "


def shown(thing: Any) -> Page:
    page = Page(thing._repr_html_())
    assert page.tags <= {"div", "b", "table", "tr", "td", "th", "ul", "ol", "li", "img", "br",
                         "span"}
    for image in page.images:
        assert image[:8] == b"\x89PNG\r\n\x1a\n"
    return page


@pytest.fixture(scope="module")
def scenario() -> floorproof.Scenario:
    return floorproof.load(ROOM)


@pytest.fixture(scope="module")
def failed(scenario: floorproof.Scenario, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("notebook") / "run"
    scenario.with_plan([[1, 1], [2.4, 1]]).run(out=out)
    return out


def test_a_scenario_and_its_site_show_themselves(scenario: floorproof.Scenario) -> None:
    page = shown(scenario)
    for word in ("beluga", "boustrophedon", "4.0 m x 2.5 m", "1, 1 of them not on the map",
                 "x 1.00, y 1.00 m, 0 degrees", NASTY):
        assert word in page.text
    assert page.images == [scenario._repr_png_()]
    site = shown(scenario.site)
    assert "pane: glass, 1000 mm, not on the map" in site.text
    assert site.images == [scenario.site._repr_png_()]


def test_the_picture_of_a_site_lies_as_the_site_does(scenario: floorproof.Scenario) -> None:
    site = scenario.site
    canvas = _site_picture._Canvas(site.frame, site.occupancy)  # 120 pixels a metre
    assert canvas.rgb.shape == (300, 480, 3)
    wall, floor = canvas.rgb[0, 0].copy(), canvas.rgb[150, 240].copy()
    assert (canvas.rgb[:60] == wall).all() and (canvas.rgb[60:240, 60:420] == floor).all()
    assert canvas.points([(0, 0), (4, 2.5), (1, 2)]).tolist() == [[0, 300], [480, 0], [120, 60]]
    # Concave: an L that lies below the middle.
    red = (200, 0, 0)
    corners = [(1, 0.7), (3, 0.7), (3, 1.2), (1.5, 1.2), (1.5, 1.7), (1, 1.7)]
    canvas.area(canvas.points(corners), red)
    tinted = (canvas.rgb[60:240, 60:420] != floor).any(axis=2)
    assert tinted.sum() / 120**2 == pytest.approx(2 * 0.5 + 0.5 * 0.5, rel=0.1)  # and its outline
    assert (canvas.rgb[300 - 84 - 30, 130] != floor).any()  # in its corner
    assert (canvas.rgb[300 - 180, 300] == floor).all()  # in its bay


def test_a_turned_map_is_drawn_along_its_rows() -> None:
    frame = floorproof.Frame(8, 5, 0.5, (4.0, -2.0, 0.7))
    canvas = _site_picture._Canvas(frame, np.zeros((5, 8), np.uint8))
    for row, column in ((0, 0), (4, 7), (1, 3)):
        at, = canvas.points([frame.centre(row, column)])
        assert at == pytest.approx([60 * column + 30, 300 - 60 * row - 30])


def test_the_start_is_drawn_with_its_heading(scenario: floorproof.Scenario) -> None:
    pictures = {_site_picture.drawn(scenario.site, start)
                for start in (None, (1, 1, 0), (1, 1, 1.5), (2, 1, 0), (90, 90, 0))}
    assert len(pictures) == 4  # off the map there is nothing to draw


def test_a_plan_shows_itself(scenario: floorproof.Scenario) -> None:
    plan = scenario.plan()
    page = shown(plan)
    assert f"{plan.info['length_m']:.1f} m" in page.text
    assert f"{100 * plan.info['coverage']:.1f} %" in page.text
    assert f"{plan.check()['expected_s']:.0f} s" in page.text
    assert page.images == [plan._repr_png_()]


def test_plans_that_are_none_say_why() -> None:
    site = {**ROOM["site"], "hazards": [], "goal": {"x_m": 3, "y_m": 1}}
    site["grid"] = {**site["grid"], "rows": site["grid"]["rows"].replace("#......#", "#..#...#")}
    divided = floorproof.load({**ROOM, "site": site, "plan": "path_transform"}).plan()
    assert divided.status == "floor_divided"
    assert f"floor divided  {divided.message}" in shown(divided).text
    assert divided._repr_png_() is None
    online = floorproof.load(CELLS).plan()
    assert "rolling_window plans while it drives" in shown(online).text


def test_an_episode_shows_its_failures(failed: Path) -> None:
    episode = floorproof.read(failed)
    page = shown(episode)
    first = episode.events[0]
    assert page.text.startswith("failure ")
    assert f"at {first.t_s:.1f} s: {first.evidence['text']}; effect" in page.text
    assert f"{100 * episode.metrics['coverage']:.1f} %" in page.text
    assert page.images == [(failed / "heatmap_failures.png").read_bytes()] == [episode._repr_png_()]


def test_an_episode_in_memory_shows_the_same_as_its_folder(failed: Path) -> None:
    episode = floorproof.load(failed / "scenario.resolved.yaml").run()
    assert episode.folder is None
    assert episode._repr_html_() == floorproof.read(failed)._repr_html_()


def test_an_episode_without_physics_shows_its_cells() -> None:
    page = shown(floorproof.load(CELLS).run())
    assert "success" in page.text and len(page.images) == 1


@pytest.mark.filterwarnings("ignore:warning. nothing differs")
def test_a_campaign_shows_rates_with_intervals(tmp_path: Path) -> None:
    site = {"site": 1, "generate": {"kind": "room", "cells": [8, 8], "seed": 1}}
    campaign = floorproof.campaign({**CELLS, "site": site, "time_limit_s": 60}, 4,
                                   out=tmp_path / "c", jobs=1)
    page = shown(campaign)
    about, = campaign.variants.values()
    rate = about["failures"]["not_success"]
    assert "one episode, repeated" in page.text
    assert (f"not success: {rate['k']} of {rate['n']} = 100 % ({100 * rate['lower']:.3g} to 100 %)"
            in page.text)
    summary = campaign.summary
    summary["variants"][NASTY] = {**about, "failures": {
        "not_success": {**rate, "k": 0, "rate": 0.0, "upper": 0.0452}}}
    page = shown(campaign)
    assert NASTY in page.text and "none of 1; at most 4.52 %" in page.text


def test_nothing_raises_in_a_notebook(failed: Path, scenario: floorproof.Scenario, tmp_path: Path,
                                      monkeypatch: pytest.MonkeyPatch) -> None:
    episode = floorproof.read(failed)
    episode.result.pop("site")
    covered = f"{100 * episode.metrics['coverage']:.1f} %"
    assert episode._repr_html_() == f"<pre>&lt;Episode failure, covered {covered}&gt;</pre>"
    episode.result["metrics"] = None  # now its repr raises, too
    assert episode._repr_html_() == "<pre>Episode</pre>"
    summary = {"variants": {"a": {"n": 0, "failures": {}}}}
    (tmp_path / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    assert floorproof.Campaign(tmp_path)._repr_html_().startswith("<pre>")

    def no_disk(*_: Any) -> None:
        raise floorproof.InternalError("no picture today")

    monkeypatch.setattr(floorproof._core, "save_plan", no_disk)
    page = shown(scenario.plan())
    assert "waypoints" in page.text and not page.images
