# SPDX-License-Identifier: Apache-2.0
"""A site drawn small, without GL and without a plan: walls, unknown floor, hazards, the start."""
from __future__ import annotations

import math
from typing import Optional, Sequence, Tuple

import numpy as np

from ._png import png_bytes
from ._results import Frame, Pose
from ._site import Site

Colour = Tuple[int, int, int]
Points = np.ndarray  # [n, 2]

# As the heat maps have them: free, wall, unknown.
_CELLS = np.array([[238, 240, 243], [52, 60, 72], [214, 217, 221]], np.uint8)
_KNOWN, _UNKNOWN = (31, 119, 180), (230, 115, 0)  # hazards, as planners are told of them
_START = (20, 150, 90)
_LONGEST_PX = 480


def _inside(x: np.ndarray, y: np.ndarray, corners: Points) -> np.ndarray:
    """Which points lie in a polygon: a ray from them crosses its edges an odd number of times."""
    odd = np.zeros(np.broadcast(x, y).shape, bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
        if ay != by:
            odd ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return odd


def _near(x: np.ndarray, y: np.ndarray, a: np.ndarray, b: np.ndarray, most: float) -> np.ndarray:
    """Which points lie within `most` of the segment from a to b."""
    dx, dy = b - a
    length2 = dx * dx + dy * dy
    along = ((x - a[0]) * dx + (y - a[1]) * dy) / length2 if length2 > 0 else np.zeros(1)
    share = np.clip(along, 0, 1)
    near: np.ndarray = np.hypot(x - a[0] - share * dx, y - a[1] - share * dy) <= most
    return near


class _Canvas:
    """Pixels along the map's rows; row 0 is the top. Points are in pixels: column, row."""

    def __init__(self, frame: Frame, occupancy: np.ndarray) -> None:
        self._frame = frame
        longest = max(frame.width, frame.height)
        width, height = (max(1, round(_LONGEST_PX * n / longest))
                         for n in (frame.width, frame.height))
        ix = ((np.arange(width) + 0.5) * frame.width / width).astype(int)
        iy = ((np.arange(height)[::-1] + 0.5) * frame.height / height).astype(int)
        self.rgb = _CELLS[occupancy[np.ix_(iy, ix)]]
        self._px_per_m = np.array([width / frame.width, height / frame.height]) / frame.cell_m

    def points(self, world: Sequence[Sequence[float]]) -> Points:
        x_m, y_m, yaw = self._frame.origin
        c, s = math.cos(yaw), math.sin(yaw)
        d = np.asarray(world, float) - (x_m, y_m)
        right, up = (d @ [c, s], d @ [-s, c])
        return np.stack([right * self._px_per_m[0],
                         len(self.rgb) - up * self._px_per_m[1]], axis=-1)

    def _around(self, points: Points, margin: float) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The piece of the picture that holds them, and the places of its columns and rows."""
        height, width, _ = self.rgb.shape
        low = np.floor(points.min(axis=0) - margin).astype(int).clip(0, (width, height))
        high = np.ceil(points.max(axis=0) + margin).astype(int).clip(0, (width, height))
        return (self.rgb[low[1]:high[1], low[0]:high[0]], np.arange(low[0], high[0])[None, :] + 0.5,
                np.arange(low[1], high[1])[:, None] + 0.5)

    def area(self, corners: Points, colour: Colour) -> None:
        """Tinted, with an outline, which thin things have alone."""
        piece, x, y = self._around(corners, 2)
        inside = _inside(x, y, corners)
        piece[inside] = (2 * piece[inside].astype(int) + np.array(colour)) // 3
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            self.line(a, b, 1, colour)

    def line(self, a: np.ndarray, b: np.ndarray, half_px: float, colour: Colour) -> None:
        piece, x, y = self._around(np.array([a, b]), half_px)
        piece[_near(x, y, a, b, half_px)] = colour


def drawn(site: Site, start: Optional[Pose] = None) -> bytes:
    """PNG, its longer side 480 pixels, along the map's own rows. Hazards on the planner's map are
    blue, others orange; the start is a green disc with its heading."""
    canvas = _Canvas(site.frame, site.occupancy)
    for hazard in site.hazards:
        for polygon in hazard.polygons_m:
            canvas.area(canvas.points(polygon), _KNOWN if hazard.known else _UNKNOWN)
    if start is not None:
        x_m, y_m, yaw = start
        at, ahead = canvas.points([(x_m, y_m), (x_m + math.cos(yaw), y_m + math.sin(yaw))])
        canvas.line(at, at, 7, _START)
        canvas.line(at, at + 16 * (ahead - at) / np.hypot(*(ahead - at)), 1.5, _START)
    return png_bytes(canvas.rgb)
