#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the tree is as docs/architecture.md draws it.

    arrows.py TREE

The drawings are the Mermaid blocks of that page that run from the top down. A node's label is a
folder, or one file; an arrow says "may include". A room may include whatever its arrows lead to,
directly or through other rooms.
The check fails, one line for each finding, when

  an #include or a link line of CMake runs against the arrows,
  an arrow is drawn that no #include uses, or the arrows run in a circle,
  a folder with sources is not drawn,
  a library is used outside the rooms that the page's table allows it,
  a header reaches more files, through whatever #include, than the page's table of limits says.

Tests, benchmarks and fuzz targets may include every room; no room may include them.
"""
import pathlib
import re
import sys

PAGE = "docs/architecture.md"
FREE = ("tests", "bench", "fuzz")  # these may include everything
# Headers from outside, by the word that stands for them in the page's table.
LIBRARIES = {
    "MuJoCo": "mujoco/", "OpenCV": "opencv2/", "FFmpeg": "libav", "yaml-cpp": "yaml-cpp/",
    "Boost": "boost/", "nlohmann-json": "nlohmann/", "SQLite": "sqlite3.h", "CLI11": "CLI/",
    "libmd": "sha256.h", "Clipper": "polyclipping/", "Fontconfig": "fontconfig/",
    "nanobind": "nanobind/", "libpng": "png.h", "zlib": "zlib.h", "Assimp": "assimp/",
}


def drawn(page):
    """The rooms of the page's drawings, and where each one's arrows lead."""
    arrows = {}
    for block in re.findall(r"```mermaid\nflowchart TD\n(.*?)```", page, re.S):
        label = dict(re.findall(r'(\w+)\["([^"<]+)', block))
        for room in label.values():
            arrows.setdefault(room.strip(), set())
        for line in block.splitlines():
            line = re.sub(r'\["[^"]*"\]', "", line)
            if "-->" not in line:
                continue
            ends = [[end.strip() for end in part.split("&")] for part in line.split("-->")]
            for sources, targets in zip(ends, ends[1:]):
                for source in sources:
                    for target in targets:
                        arrows[label[source].strip()].add(label[target].strip())
    return arrows


def reach(arrows):
    """For each room, all rooms that its arrows lead to; and the rooms that stand in a circle."""
    reached = {}
    for room in arrows:
        seen, todo = set(), list(arrows[room])
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                todo.extend(arrows[at])
        reached[room] = seen
    return reached, sorted(room for room in arrows if room in reached[room])


def room_of(path, rooms):
    """The room that a file belongs to: the longest that its path begins with."""
    parts = path.split("/")
    for n in range(len(parts), 0, -1):
        if "/".join(parts[:n]) in rooms:
            return "/".join(parts[:n])
    return None


def allowed_libraries(page, rooms):
    """By the first column of the page's table, the libraries that its last column names."""
    allowed = {room: set() for room in rooms}
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) == 4 and cells[0] in rooms:
            allowed[cells[0]] = {name for name in LIBRARIES if name in cells[3]}
    return allowed


def reach_limits(page):
    """The headers of the page's table of limits, and how many files each may reach."""
    rows = re.findall(r"^\| `([\w/]+\.h)` \| (\d+) \|", page, re.M)
    return {header: int(most) for header, most in rows}


def reached_by(header, included_by):
    """The files outside tests, benchmarks and fuzz targets that see the header."""
    seen, todo = set(), [header]
    while todo:
        for name in included_by.get(todo.pop(), ()):
            if name not in seen:
                seen.add(name)
                todo.append(name)
    return seen


def sources(tree):
    for path in sorted(tree.rglob("*")):
        name = path.relative_to(tree).as_posix()
        if path.suffix in (".cc", ".h") and not name.startswith(("build", "out/", ".")):
            yield name, path.read_text(encoding="utf-8")


def link_lines(tree):
    """Of each library of ours: its folder, and what it links."""
    libraries = {}
    for path in sorted(tree.rglob("CMakeLists.txt")):
        folder = path.parent.relative_to(tree).as_posix()
        if folder.startswith(("build",) + FREE):
            continue
        for name, body in re.findall(r"fp_library\((\w+)(.*?)\)", path.read_text(), re.S):
            first = re.search(r"SOURCES\s+([\w./]+)/", body)
            part = folder + "/" + first.group(1) if first else folder
            links = re.findall(r"\b(fp_\w+)", re.sub(r"PRECOMPILED \w+", "", body))
            libraries[name] = (part, links)
    return libraries


def findings(tree):
    page = (tree / PAGE).read_text(encoding="utf-8")
    arrows = drawn(page)
    if not arrows:
        return [f"{PAGE}: draws nothing"]
    reached, circles = reach(arrows)
    found = [f"{PAGE}: the arrows of {room} lead back to it" for room in circles]
    allowed = allowed_libraries(page, arrows)
    used, included_by = set(), {}
    for name, text in sources(tree):
        if name.startswith(FREE):
            continue
        for header in re.findall(r'^#include "([^"]+)"', text, re.M):
            included_by.setdefault(header, []).append(name)
        room = room_of(name, arrows)
        if room is None:
            found.append(f"{name}: its folder is not drawn in {PAGE}")
            continue
        for number, line in enumerate(text.splitlines(), 1):
            ours = re.match(r'#include "([^"]+)"', line)
            if ours and "/" in ours.group(1):
                target = room_of(ours.group(1), arrows)
                if target is None:
                    found.append(f"{name}:{number}: includes {ours.group(1)}, which is not drawn")
                elif target != room:
                    used.add((room, target))
                    if target not in reached[room]:
                        found.append(f"{name}:{number}: {room} may not include {target}")
            theirs = re.match(r"\s*#include <([^>]+)>", line)
            for library, header in LIBRARIES.items():
                if theirs and theirs.group(1).startswith(header) and library not in allowed[room]:
                    found.append(f"{name}:{number}: {room} may not use {library}")
    for header, most in reach_limits(page).items():
        count = len(reached_by(header, included_by))
        if count == 0:
            found.append(f"{PAGE}: nobody includes {header}")
        elif count > most:
            found.append(f"{header}: reaches {count} files, at most {most}")
    for room, targets in sorted(arrows.items()):
        includes = [target + "/" for source, target in used if source == room]
        found += [f"{PAGE}: no #include uses the arrow from {room} to {target}"
                  for target in sorted(targets)
                  if not any(include.startswith(target + "/") for include in includes)]
    libraries = link_lines(tree)
    for name, (folder, links) in libraries.items():
        room = room_of(folder, arrows)
        for link in links:
            target = room_of(libraries[link][0], arrows) if link in libraries else None
            if target and room != target and target not in reached.get(room, ()):
                found.append(f"{folder}/CMakeLists.txt: {name} may not link {link}")
    return found


if __name__ == "__main__":
    result = findings(pathlib.Path(sys.argv[1]))
    print("\n".join(result) if result else "the tree is as it is drawn")
    sys.exit(1 if result else 0)
