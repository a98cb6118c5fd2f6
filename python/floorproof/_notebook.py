# SPDX-License-Identifier: Apache-2.0
"""What a notebook shows: a small page for each thing, with all that it needs in itself.

Nothing here raises: what cannot be drawn is left out, and what cannot be told is shown as its repr.
Colours are the page's own, so that they can be read in light and dark.
"""
from __future__ import annotations

import base64
import functools
import tempfile
from html import escape
from pathlib import Path
from typing import Any, Callable, Iterable, List, Mapping, Optional, Sequence, Tuple

from . import _core

Row = Tuple[str, Any]

_LINE = "border:0;border-bottom:1px solid rgba(128,128,128,.35);padding:2px 12px 2px 0"
_CELL = f"{_LINE};text-align:left;vertical-align:top;background:none;color:inherit"
_GOOD, _BAD, _SOSO = "#1a9850", "#d73027", "#b8860b"
_COLOURS = {"success": _GOOD, "passed": _GOOD, "failure": _BAD, "failed": _BAD, "error": _BAD}


def _safely(page: Callable[[Any], str]) -> Callable[[Any], str]:
    @functools.wraps(page)
    def shown(thing: Any) -> str:
        try:
            return page(thing)
        except Exception:
            try:
                text = repr(thing)
            except Exception:
                text = type(thing).__name__
            return f"<pre>{escape(text)}</pre>"
    return shown


# --- HTML


def _image(png: Optional[bytes], about: str) -> str:
    if png is None:
        return ""
    data = base64.b64encode(png).decode()
    return (f'<img alt="{escape(about)}" style="max-width:min(100%,440px);background:#fff" '
            f'src="data:image/png;base64,{data}">')


def _word(word: str) -> str:
    return f'<b style="color:{_COLOURS.get(word, _SOSO)}">{escape(word.replace("_", " "))}</b>'


def _table(rows: Iterable[Row]) -> str:
    body = "".join(f'<tr style="background:none"><td style="{_CELL};opacity:.75">'
                   f'{escape(name)}</td><td style="{_CELL}">{escape(str(value))}</td></tr>'
                   for name, value in rows if value not in (None, ""))
    return f'<table style="border-collapse:collapse;border:0;margin:4px 0">{body}</table>'


def _grid(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Cells are HTML."""
    top = "".join(f'<th style="{_CELL};font-weight:bold">{escape(name)}</th>' for name in head)
    body = "".join('<tr style="background:none">'
                   + "".join(f'<td style="{_CELL}">{cell}</td>' for cell in row)
                   + "</tr>" for row in rows)
    return (f'<table style="border-collapse:collapse;border:0;margin:4px 0"><tr '
            f'style="background:none">{top}</tr>{body}</table>')


def _list(lines: Iterable[str], kind: str = "ol") -> str:
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f'<{kind} style="margin:4px 0">{items}</{kind}>' if items else ""


def _page(title: str, *parts: str, png: Optional[bytes] = None, about: str = "") -> str:
    """title: HTML."""
    wide = 440 if png else 800
    return (f'<div style="display:flex;flex-wrap:wrap;gap:16px;align-items:flex-start">'
            f'<div style="max-width:{wide}px"><div>{title}</div>{"".join(parts)}</div>'
            f'{_image(png, about)}</div>')


# --- figures in the command line's words and units


def _percent(share: Optional[float]) -> Optional[str]:
    return None if share is None else f"{100 * share:.1f} %"


def _energy(energy_j: Optional[float]) -> Optional[str]:
    if energy_j is None:
        return None
    return f"{energy_j:.0f} J" if energy_j < 1000 else f"{energy_j / 1000:.1f} kJ"


def _with(value: Optional[float], form: str) -> Optional[str]:
    return None if value is None else form.format(value)


def _pose(pose: Optional[Sequence[float]]) -> Optional[str]:
    if pose is None:
        return None
    x_m, y_m, yaw_rad = pose
    return f"x {x_m:.2f}, y {y_m:.2f} m, {yaw_rad * 57.29577951308232:.0f} degrees"


def _size(site: Any) -> str:
    f = site.frame
    return f"{f.width * f.cell_m:.1f} m x {f.height * f.cell_m:.1f} m, cells of {f.cell_m:g} m"


def _hazards(site: Any) -> str:
    hidden = sum(not h.known for h in site.hazards)
    unseen = f", {hidden} of them not on the map (orange)" if hidden else ""
    return f"{len(site.hazards)}{unseen}"


# --- pages


@_safely
def site_html(site: Any) -> str:
    lines = [f"{h.id}: {h.type}, {1000 * h.height_m:.0f} mm"
             + ("" if h.known else ", not on the map") for h in site.hazards[:12]]
    if len(site.hazards) > 12:
        lines.append(f"{len(site.hazards) - 12} more")
    return _page(f"<b>{escape(site.name)}</b>",
                 _table([("size", _size(site)), ("floor friction", f"{site.floor_friction:g}"),
                         ("start", _pose(site.start)), ("hazards", _hazards(site))]),
                 _list(lines, "ul"), png=site._repr_png_(),
                 about=f"map of {site.name}")


@_safely
def scenario_html(scenario: Any) -> str:
    robot, site = scenario.robot, scenario.site
    rows: List[Row] = [
        ("site", f"{site.name}: {_size(site)}"), ("hazards", _hazards(site)),
        ("robot", f"{robot['name']}, {robot['drive']}, {robot['mass_kg']:g} kg, "
                  f"tool {robot['tool_width_m']:g} m wide"),
        ("planner", scenario.planner), ("tracker", scenario.tracker),
        ("sensors", ", ".join(scenario.sensors)), ("start", _pose(scenario.start)),
        ("seed", scenario.seed)]
    if len(scenario.variants) > 1:
        rows.append(("variants", ", ".join(scenario.variants)))
    return _page(f"<b>{escape(scenario.name)}</b>", _table(rows),
                 _list((f"warning: {line}" for line in scenario.warnings()), "ul"),
                 png=scenario._repr_png_(), about=f"map of {site.name}, the robot's start on it")


@_safely
def plan_html(plan: Any) -> str:
    if plan.status != "success":
        return _page(f"<b>plan</b>: {_word(plan.status)} {escape(plan.message)}")
    info = plan.info
    rows: List[Row] = [("waypoints", info["waypoints"]), ("length", f"{info['length_m']:.1f} m"),
                       ("turns", info["turns"])]
    reach = info.get("sweepable_m2")
    if info.get("coverage") is not None:
        rows.append(("covers", f"{_percent(info['coverage'])}"
                     + (f" of {reach:.1f} m² in reach" if reach else "")))
    rows.append(("overlap", _percent(info.get("overlap"))))
    check = plan.check()
    if check["expected_s"] is not None:
        energy = _energy(check["expected_energy_j"])
        rows.append(("expected", f"{check['expected_s']:.0f} s, {energy}"))
    least = check["least_clearance"]
    if least:
        rows.append(("least clearance", f"{1000 * least['clearance_m']:.0f} mm to a "
                     f"{least['obstacle']}, at x {least['x_m']:.2f}, y {least['y_m']:.2f} m"))
    crossed = [f"drives over '{d['hazard']}' {d['times']} times" for d in check["driven_over"]]
    conflicts = len(check["conflicts"])
    if conflicts:
        crossed.append(f"leads the robot into something at {conflicts} places")
    return _page(f"<b>plan</b> by {escape(info['planner'])}", _table(rows),
                 _list([plan.message] if plan.message else [], "ul"), _list(crossed, "ul"),
                 png=plan._repr_png_(), about="the plan on the map")


@_safely
def episode_html(episode: Any) -> str:
    m = episode.metrics
    result = episode.result
    rows: List[Row] = [
        ("covered", _percent(m.get("coverage"))), ("time", _with(m.get("duration_s"), "{:.0f} s")),
        ("way", _with(m.get("path_length_m"), "{:.1f} m")),
        ("off the path", _with(None if m.get("max_cross_track_m") is None
                               else 1000 * m["max_cross_track_m"], "{:.0f} mm at most")),
        ("energy", _energy(m.get("energy_j"))),
        *((f"drawn: {key}", f"{value:.4g}" if isinstance(value, float) else value)
          for key, value in episode.drawn.items())]
    failures = []
    for event in episode.events[:10]:
        e = event.evidence
        kind = f" ({event.kind})" if event.kind else ""
        failures.append(f"{event.mode.replace('_', ' ')}{kind} at {event.t_s:.1f} s: "
                        f"{e.get('text', '')}; effect {e.get('effect', '')}")
    more = len(episode.events) - len(failures)
    title = (f"{_word(episode.outcome)} <b>{escape(result['scenario'])}</b>: "
             f"{escape(result['robot'])} on {escape(result['site'])}")
    return _page(title, escape(episode.message), _table(rows), _list(failures),
                 escape(f"{more} more failures" if more > 0 else ""),
                 png=episode._repr_png_(), about="what was driven, on the map")


@_safely
def campaign_html(campaign: Any) -> str:
    rows, sure = [], ""
    for name, about in campaign.variants.items():
        note = "<br>one episode, repeated" if about["one_episode_repeated"] else ""
        counts = ", ".join(f"{n} {word}" for word, n in about["outcomes"].items() if n)
        lost = [f"{about[key]} {word}" for key, word in (("n_error", "errors"),
                                                         ("n_not_planned", "without a plan"))
                if about[key]]
        failures = about["failures"]
        seen = [mode for mode, rate in failures.items() if rate["k"] or mode == "not_success"]
        rates = "<br>".join('<span style="white-space:nowrap">'
                            f"{escape(_rate(mode, failures[mode]))}</span>" for mode in seen)
        sure = f"{100 * failures['not_success']['confidence']:g} %"
        coverage = about["metrics"].get("coverage") or {}
        rows.append([escape(name), f"{about['n']}{note}", escape("; ".join([counts, *lost])), rates,
                     escape(_percent(coverage.get("median")) or "")])
    parts = [_grid(("variant", "episodes", "outcomes", f"failures (intervals of {sure})",
                    "coverage, median"), rows)]
    gate = campaign.gate
    if gate:
        for name, about in gate["variants"].items():
            parts.append(f"<div>gate, {escape(name)}: {_word(str(about['verdict']))} "
                         f"{escape(str(about.get('text', '')))}</div>")
    unfinished = campaign.summary.get("unfinished")
    if unfinished:
        parts.append(f"<div>{escape(unfinished)}</div>")
    return _page(f"<b>campaign</b> {escape(str(campaign.folder))}", *parts)


def _rate(mode: str, rate: Mapping[str, Any]) -> str:
    words = mode.replace("_", " ")
    if not rate["n"]:
        return f"{words}: no episode counts"
    if not rate["k"]:
        return f"{words}: none of {rate['n']}; at most {100 * rate['upper']:.3g} %"
    return (f"{words}: {rate['k']} of {rate['n']} = {100 * rate['rate']:.3g} % "
            f"({100 * rate['lower']:.3g} to {100 * rate['upper']:.3g} %)")


# --- pictures


def site_png(site: Any, start: Any) -> Optional[bytes]:
    """The map with its hazards and the start."""
    from ._site_picture import drawn
    return _drawn(lambda: drawn(site, start))


def plan_png(plan: Any) -> Optional[bytes]:
    """heatmap_plan.png; none where there is no plan."""
    if plan.status != "success":
        return None

    def draw() -> Optional[bytes]:
        with tempfile.TemporaryDirectory() as folder:
            plan.save(Path(folder) / "plan")
            return _first(Path(folder) / "plan", ("heatmap_plan.png",))
    return _drawn(draw)


def episode_png(episode: Any) -> Optional[bytes]:
    """The map with the failures; without any, with what was covered. Of an episode that was read,
    or that was run with `out`, the folder's own picture."""
    names = ("heatmap_failures.png",) if episode.events else (
        "heatmap_cells.png", "heatmap_coverage.png", "heatmap_plan.png")

    def draw() -> Optional[bytes]:
        if episode.folder is not None:
            return _first(episode.folder, names)
        with tempfile.TemporaryDirectory() as folder:
            _core.save_maps(episode._core, Path(folder))
            return _first(Path(folder), names)
    return _drawn(draw)


def _drawn(draw: Callable[[], Optional[bytes]]) -> Optional[bytes]:
    """A PNG; none where it cannot be drawn."""
    try:
        return draw()
    except Exception:
        return None


def _first(folder: Path, names: Sequence[str]) -> Optional[bytes]:
    for name in names:
        if (folder / name).is_file():
            return (folder / name).read_bytes()
    return None
