#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A planner that others wrote, for `plan: {command: [./mower.py, lines]}`: the coverage planner for
robot mowers of `pip install coverage-path-planner`. Its garden is the floor where the robot's centre
may be, its patterns are lines, squares and rings."""
import json
import math
import pathlib
import sys

import coverage_path_planner as mower

pattern, folder = sys.argv[1], pathlib.Path(sys.argv[-1])
request = json.loads((folder / "request.json").read_text())
reach = request["reach"]
width, height, cell_m = reach["width"], reach["height"], reach["cell_m"]
pixels = (folder / reach["pgm"]).read_bytes()[-width * height:]  # the top row first
yes = {(x, y) for y in range(height) for x in range(width)
       if pixels[(height - 1 - y) * width + x] == reach["yes"]}
turn, x0, y0 = (reach["origin"][key] for key in ("yaw_rad", "x_m", "y_m"))
cos, sin = math.cos(turn), math.sin(turn)
x, y = request["start"]["x_m"] - x0, request["start"]["y_m"] - y0
start = cos * x + sin * y, cos * y - sin * x

# It mows up to its garden's border: a cell is left, so that the border lies where the robot may be.
inner = {(x, y) for x, y in yes if all((x + i, y + j) in yes for i in (-1, 0, 1) for j in (-1, 0, 1))}
if not inner:
    sys.exit("there is no room for a garden")
free = {min(inner, key=lambda c: math.dist(start, ((c[0] + 0.5) * cell_m, (c[1] + 0.5) * cell_m)))}
ring = free
while ring:  # what hangs together with the start
    ring = {cell for x, y in ring for cell in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1))
            if cell in inner and cell not in free}
    free = free | ring


def borders():
    """The region's borders as lists of corners in cells, the region to the left of each."""
    ahead = {}
    for x, y in free:
        for beside, a, b in (((x, y - 1), (x, y), (x + 1, y)), ((x + 1, y), (x + 1, y), (x + 1, y + 1)),
                             ((x, y + 1), (x + 1, y + 1), (x, y + 1)), ((x - 1, y), (x, y + 1), (x, y))):
            if beside not in free:
                ahead.setdefault(a, []).append(b)
    while ahead:
        border, at = [], next(iter(ahead))
        while at in ahead:
            to = ahead[at].pop()
            if not ahead[at]:
                del ahead[at]
            border.append(at)
            at = to
        yield [b for a, b, c in zip(border[-1:] + border, border, border[1:] + border[:1])
               if (b[0] - a[0]) * (c[1] - b[1]) != (b[1] - a[1]) * (c[0] - b[0])]


def area(border):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(border, border[1:] + border[:1])) / 2


def polygon(border):
    return mower.Polygon([mower.Point(x * cell_m, y * cell_m) for x, y in border])


outer, *holes = sorted(borders(), key=area, reverse=True)
garden = mower.Environment(polygon(outer))
for hole in holes:
    if area(hole) < 0:
        garden.addObstacle(polygon(hole))

settings = mower.PathSettings()
settings.pattern = pattern
settings.offset = 0.9 * request["robot"]["tool_width_m"]  # neighbouring lines overlap, as ours do
settings.angle = 0.0
settings.distanceToBorder = 0
settings.borderLaps = settings.exclusionsBorderLaps = 1

task = mower.PathService().computeFullTask(garden, settings, mower.Point(*start))
with open(folder / "plan.csv", "w") as plan:
    plan.write("x_m,y_m\n")
    for p in task.path.getPoints():
        plan.write(f"{x0 + cos * p.x - sin * p.y:.4f},{y0 + sin * p.x + cos * p.y:.4f}\n")
