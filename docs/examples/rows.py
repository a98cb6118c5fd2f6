#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A planner for `plan: {command: [./rows.py]}`: rows a tool's width apart, each from wall to wall,
the nearest one next, and in between the shortest way over floor where the robot fits."""
import json
import math
import pathlib
import sys

folder = pathlib.Path(sys.argv[-1])  # the program's last argument
request = json.loads((folder / "request.json").read_text())
reach = request["reach"]
width, height, cell_m = reach["width"], reach["height"], reach["cell_m"]
pixels = (folder / reach["pgm"]).read_bytes()[-width * height:]  # the top row first
free = {(x, y) for y in range(height) for x in range(width)
        if pixels[(height - 1 - y) * width + x] == reach["yes"]}
if not free:
    sys.exit("the robot does not fit where it starts")

turn, x0, y0 = (reach["origin"][key] for key in ("yaw_rad", "x_m", "y_m"))
cos, sin = math.cos(turn), math.sin(turn)


def to_world(cell):
    x, y = ((i + 0.5) * cell_m for i in cell)
    return x0 + cos * x - sin * y, y0 + sin * x + cos * y


def way_to(goals, start):
    """The fewest cells behind start that lead to one of the goals."""
    came_from, ring = {start: None}, [start]
    while ring:
        for cell in ring:
            if cell in goals:
                way = [cell]
                while came_from[way[-1]] is not None:
                    way.append(came_from[way[-1]])
                return way[-2::-1]
        ring = [new for x, y in ring for new in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1))
                if new in free and came_from.setdefault(new, (x, y)) == (x, y)]
    return []


step = max(1, int(request["robot"]["tool_width_m"] / cell_m))
low, high = min(y for _, y in free), max(y for _, y in free)
ends = {}  # of each row: one end -> the other
for y in [*range(low, high, step), high]:
    for x in range(width):
        if (x, y) in free and (x - 1, y) not in free:
            last = x
            while (last + 1, y) in free:
                last += 1
            ends[x, y], ends[last, y] = (last, y), (x, y)

here = min(free, key=lambda cell: math.dist(to_world(cell),
                                            (request["start"]["x_m"], request["start"]["y_m"])))
path = [here]
while ends:
    path += way_to(ends, path[-1])
    if path[-1] not in ends:
        break  # rows that only a diagonal step leads to
    other = ends.pop(path[-1])
    if ends.pop(other, None):
        path.append(other)


def heading(a, b):
    return (b[0] > a[0]) - (b[0] < a[0]), (b[1] > a[1]) - (b[1] < a[1])


corners = [b for a, b, c in zip(path, path[1:], path[2:]) if heading(a, b) != heading(b, c)]
with open(folder / "plan.csv", "w") as plan:
    plan.write("x_m,y_m,yaw_rad\n")
    yaw = turn if request["robot"]["holonomic"] else ""  # held at the map's own
    for cell in [path[0], *corners, path[-1]]:
        plan.write("%.4f,%.4f,%s\n" % (*to_world(cell), yaw))
