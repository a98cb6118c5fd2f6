// SPDX-License-Identifier: Apache-2.0
#include "env/map/cell_shapes.h"

#include <algorithm>
#include <cstdint>

namespace floorproof {
namespace {

// Takes the cells joined to `seed` out of `left` and marks them in `area`.
void TakeJoined(Grid<std::uint8_t>& left, Cell seed, Grid<std::uint8_t>& area,
                std::vector<Cell>& taken) {
  taken = {seed};
  left(seed) = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Cell c = taken[i];
    area(c) = 1;
    for (const Cell n :
         {Cell{c.ix + 1, c.iy}, Cell{c.ix - 1, c.iy}, Cell{c.ix, c.iy + 1}, Cell{c.ix, c.iy - 1}})
      if (left.Inside(n) && left(n)) {
        left(n) = 0;
        taken.push_back(n);
      }
  }
}

bool AllSet(const Grid<std::uint8_t>& set, const CellBox& b) {
  if (b.x1 > set.width || b.y0 < 0) return false;
  for (int y = b.y0; y < b.y1; ++y)
    for (int x = b.x0; x < b.x1; ++x)
      if (!set(x, y)) return false;
  return true;
}

// The larger of two rectangles of set cells with this upper left corner: grown right then down, or
// down then right.
CellBox Grow(const Grid<std::uint8_t>& set, Cell corner) {
  const CellBox one{corner.ix, corner.iy, corner.ix + 1, corner.iy + 1};
  CellBox wide = one, high = one;
  const auto right = [&set](CellBox& b) {
    while (AllSet(set, {b.x1, b.y0, b.x1 + 1, b.y1})) ++b.x1;
  };
  const auto down = [&set](CellBox& b) {
    while (AllSet(set, {b.x0, b.y0 - 1, b.x1, b.y0})) --b.y0;
  };
  right(wide), down(wide);
  down(high), right(high);
  const auto area = [](const CellBox& b) { return (b.x1 - b.x0) * (b.y1 - b.y0); };
  return area(wide) >= area(high) ? wide : high;
}

// For each cell, the number of cells of this kind in line with it, along x or y.
Grid<int> RunLengths(const Grid<char>& chars, char kind, bool along_x) {
  Grid<int> lengths(chars.width, chars.height);
  const int lines = along_x ? chars.height : chars.width;
  const int length = along_x ? chars.width : chars.height;
  const auto at = [along_x](int line, int i) { return along_x ? Cell{i, line} : Cell{line, i}; };
  for (int line = 0; line < lines; ++line)
    for (int begin = 0, end; begin < length; begin = end + 1) {
      for (end = begin; end < length && chars(at(line, end)) == kind;) ++end;
      for (int i = begin; i < end; ++i) lengths(at(line, i)) = end - begin;
    }
  return lengths;
}

CellRun::End EndAt(const Grid<char>& chars, Cell beyond, char kind) {
  if (!chars.Inside(beyond) || chars(beyond) == '#') return CellRun::End::kWall;
  return chars(beyond) == kind ? CellRun::End::kJoin : CellRun::End::kOpen;
}

}  // namespace

std::vector<CellArea> JoinedAreas(const Grid<char>& chars, char kind) {
  Grid<std::uint8_t> left(chars.width, chars.height), area(chars.width, chars.height);
  for (std::size_t i = 0; i < left.cells.size(); ++i) left.cells[i] = chars.cells[i] == kind;
  std::vector<CellArea> areas;
  std::vector<Cell> taken;
  for (int iy = chars.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < chars.width; ++ix) {
      if (!left(ix, iy)) continue;
      TakeJoined(left, {ix, iy}, area, taken);
      std::ranges::sort(taken, [](const Cell& a, const Cell& b) {
        return a.iy > b.iy || (a.iy == b.iy && a.ix < b.ix);
      });
      CellArea joined{{ix, iy}, {}};
      for (const Cell& c : taken) {
        if (!area(c)) continue;
        const CellBox box = Grow(area, c);
        for (int y = box.y0; y < box.y1; ++y)
          for (int x = box.x0; x < box.x1; ++x) area(x, y) = 0;
        joined.boxes.push_back(box);
      }
      areas.push_back(std::move(joined));
    }
  return areas;
}

std::vector<CellRun> Runs(const Grid<char>& chars, char kind) {
  constexpr std::uint8_t kNone = 0, kAlongX = 1, kAlongY = 2;
  Grid<std::uint8_t> direction(chars.width, chars.height, kNone);
  const Grid<int> in_x = RunLengths(chars, kind, true), in_y = RunLengths(chars, kind, false);
  for (std::size_t i = 0; i < chars.cells.size(); ++i)
    if (chars.cells[i] == kind)
      direction.cells[i] = in_x.cells[i] > in_y.cells[i] ? kAlongX : kAlongY;
  std::vector<CellRun> runs;
  for (int iy = chars.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < chars.width; ++ix) {
      const std::uint8_t d = direction(ix, iy);
      if (d == kNone) continue;
      CellRun run{d == kAlongX, {ix, iy, ix + 1, iy + 1}, {}, {}, {ix, iy}};
      CellBox& b = run.box;
      direction(ix, iy) = kNone;
      if (run.along_x) {
        for (; b.x1 < chars.width && direction(b.x1, iy) == d; ++b.x1) direction(b.x1, iy) = kNone;
        run.before = EndAt(chars, {b.x0 - 1, iy}, kind);
        run.after = EndAt(chars, {b.x1, iy}, kind);
      } else {
        for (; b.y0 > 0 && direction(ix, b.y0 - 1) == d; --b.y0) direction(ix, b.y0 - 1) = kNone;
        run.before = EndAt(chars, {ix, b.y0 - 1}, kind);
        run.after = EndAt(chars, {ix, b.y1}, kind);
      }
      runs.push_back(run);
    }
  return runs;
}

}  // namespace floorproof
