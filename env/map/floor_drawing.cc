// SPDX-License-Identifier: Apache-2.0
#include "env/map/floor_drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/geometry/distance.h"

namespace floorproof {
namespace {

constexpr int kTries = 60;        // places drawn for one cluster before it is said not to fit
constexpr int kStripTries = 200;  // a strip is a whole row or column: few to choose from
constexpr int kMaxAspect = 6;     // length over width of a cluster
constexpr float kClearCells = 2;  // so far from hazards is far enough for a start
constexpr Cell kSides[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

int Below(int n, Stream& stream) {
  return static_cast<int>(stream.Below(static_cast<std::uint64_t>(n)));
}

int Width(const CellBox& b) { return b.x1 - b.x0; }
int Height(const CellBox& b) { return b.y1 - b.y0; }
int Area(const CellBox& b) { return Width(b) * Height(b); }

CellBox Moved(const CellBox& b, Cell by) {
  return {b.x0 + by.ix, b.y0 + by.iy, b.x1 + by.ix, b.y1 + by.iy};
}

}  // namespace

int IntRange::Draw(Stream& stream) const { return low + Below(high - low + 1, stream); }

FloorDrawing::FloorDrawing(int width, int height)
    : chars_(width, height, '#'), wall_(width, height, 1), door_(width, height, 0) {
  for (int iy = 1; iy < height - 1; ++iy)
    for (int ix = 1; ix < width - 1; ++ix) {
      chars_(ix, iy) = '.';
      wall_(ix, iy) = 0;
    }
  free_ = (width - 2) * (height - 2);
}

// The wall that cuts the room across its longer side: one cell thick, or none.
std::optional<CellBox> FloorDrawing::WallAcross(const CellBox& room, int room_cells,
                                                Stream& stream) const {
  const bool upright =
      Width(room) > Height(room) || (Width(room) == Height(room) && Below(2, stream) == 0);
  const int low = upright ? room.x0 : room.y0, high = upright ? room.x1 : room.y1;
  std::vector<CellBox> fit;
  for (int at = low + room_cells; at + 1 + room_cells <= high; ++at) {
    const CellBox wall =
        upright ? CellBox{at, room.y0, at + 1, room.y1} : CellBox{room.x0, at, room.x1, at + 1};
    const bool ends_in_walls = upright ? wall_(at, wall.y0 - 1) && wall_(at, wall.y1)
                                       : wall_(wall.x0 - 1, at) && wall_(wall.x1, at);
    if (ends_in_walls) fit.push_back(wall);
  }
  if (fit.empty()) return std::nullopt;
  return fit[stream.Below(fit.size())];
}

void FloorDrawing::DivideIntoRooms(int room_cells, int door_cells, Stream& stream) {
  std::vector<CellBox> rooms = {{1, 1, chars_.width - 1, chars_.height - 1}};
  while (!rooms.empty()) {
    const CellBox room = rooms.back();
    rooms.pop_back();
    const std::optional<CellBox> wall = WallAcross(room, room_cells, stream);
    if (!wall) continue;
    const bool upright = Width(*wall) == 1;
    CellBox door = *wall;
    int& first = upright ? door.y0 : door.x0;
    int& end = upright ? door.y1 : door.x1;
    const int wide = std::min(door_cells, end - first);
    first += Below(end - first - wide + 1, stream);
    end = first + wide;
    for (int iy = wall->y0; iy < wall->y1; ++iy)
      for (int ix = wall->x0; ix < wall->x1; ++ix) {
        const bool in_door = ix >= door.x0 && ix < door.x1 && iy >= door.y0 && iy < door.y1;
        door_(ix, iy) = in_door;
        if (in_door) continue;
        wall_(ix, iy) = 1;
        chars_(ix, iy) = '#';
        --free_;
      }
    rooms.push_back(upright ? CellBox{room.x0, room.y0, wall->x0, room.y1}
                            : CellBox{room.x0, room.y0, room.x1, wall->y0});
    rooms.push_back(upright ? CellBox{wall->x1, room.y0, room.x1, room.y1}
                            : CellBox{room.x0, wall->y1, room.x1, room.y1});
  }
}

// The cells from wall to wall through c, if a strip may lie there.
std::optional<CellBox> FloorDrawing::StripThrough(Cell c, bool along_x) const {
  const Cell along = along_x ? Cell{1, 0} : Cell{0, 1};
  const auto lies_well = [&](int ix, int iy) {
    if (chars_(ix, iy) != '.' || door_(ix, iy)) return false;
    // Beside it neither a strip nor a door's end.
    for (const int side : {-1, 1}) {
      const Cell beside{ix + side * along.iy, iy + side * along.ix};
      if (door_(beside) || (chars_(beside) != '.' && !wall_(beside))) return false;
    }
    return true;
  };
  const auto reach = [&](int step) {
    Cell at = c;
    while (lies_well(at.ix, at.iy)) at = {at.ix + step * along.ix, at.iy + step * along.iy};
    return at;
  };
  if (!lies_well(c.ix, c.iy)) return std::nullopt;
  const Cell before = reach(-1), after = reach(1);
  if (!wall_(before) || !wall_(after)) return std::nullopt;
  const CellBox strip = along_x ? CellBox{before.ix + 1, c.iy, after.ix, c.iy + 1}
                                : CellBox{c.ix, before.iy + 1, c.ix + 1, after.iy};
  bool floor_beside[2] = {false, false};
  for (int iy = strip.y0; iy < strip.y1; ++iy)
    for (int ix = strip.x0; ix < strip.x1; ++ix) {
      floor_beside[0] |= chars_(ix - along.iy, iy - along.ix) == '.';
      floor_beside[1] |= chars_(ix + along.iy, iy + along.ix) == '.';
    }
  if (!floor_beside[0] || !floor_beside[1]) return std::nullopt;
  return strip;
}

bool FloorDrawing::AddStrip(char kind, Stream& stream) {
  for (int i = 0; i < kStripTries; ++i) {
    const int ix = 1 + Below(chars_.width - 2, stream), iy = 1 + Below(chars_.height - 2, stream);
    const std::optional<CellBox> strip = StripThrough({ix, iy}, Below(2, stream) == 0);
    if (!strip) continue;
    Fill(*strip, kind);
    return true;
  }
  return false;
}

template <class Visit>
void FloorDrawing::AlongRing(const CellBox& b, Visit visit) const {
  for (int ix = b.x0 - 1; ix < b.x1; ++ix) visit(Cell{ix, b.y0 - 1}, ix < b.x0);
  for (int iy = b.y0 - 1; iy < b.y1; ++iy) visit(Cell{b.x1, iy}, iy < b.y0);
  for (int ix = b.x1; ix >= b.x0; --ix) visit(Cell{ix, b.y1}, ix == b.x1);
  for (int iy = b.y1; iy >= b.y0; --iy) visit(Cell{b.x0 - 1, iy}, iy == b.y1);
}

// Counts the driveable pieces of the ring that touch the box by a side (a corner alone leads
// nowhere). If there is exactly one, everything that was joined through the box still is.
bool FloorDrawing::HangsTogetherAround(const CellBox& box) const {
  int pieces = 0, blocked = 0;
  bool counted = false;              // the piece that we are in
  bool first_piece_counted = false;  // the one that the ring begins with
  AlongRing(box, [&](Cell c, bool corner) {
    if (!IsDrivable(chars_(c))) {
      ++blocked;
      counted = false;
      return;
    }
    if (corner || counted) return;
    counted = true;
    ++pieces;
    if (blocked == 0) first_piece_counted = true;
  });
  if (blocked == 0) return true;
  // The ring begins at a corner; its last cell and that corner are neighbours.
  if (first_piece_counted && counted) --pieces;
  return pieces == 1;
}

bool FloorDrawing::Fits(const CellBox& box, char kind, Ring ring) const {
  if (box.x0 < 1 || box.y0 < 1 || box.x1 > chars_.width - 1 || box.y1 > chars_.height - 1)
    return false;
  if (Area(box) >= free_) return false;  // a start must remain
  for (int iy = box.y0; iy < box.y1; ++iy)
    for (int ix = box.x0; ix < box.x1; ++ix)
      if (chars_(ix, iy) != '.' || door_(ix, iy)) return false;
  bool fits = true;
  AlongRing(box, [&](Cell c, bool) {
    if (ring == Ring::kClear) fits &= wall_(c) || (chars_(c) == '.' && !door_(c));
    if (ring == Ring::kNotOfItsKind) fits &= chars_(c) != kind;
  });
  return fits && (IsDrivable(kind) || HangsTogetherAround(box));
}

void FloorDrawing::Fill(const CellBox& box, char kind) {
  for (int iy = box.y0; iy < box.y1; ++iy)
    for (int ix = box.x0; ix < box.x1; ++ix) chars_(ix, iy) = kind;
  free_ -= Area(box);
}

// Somewhere within the outer wall; larger than the floor only where the floor is that narrow.
CellBox FloorDrawing::DrawBox(char kind, int area, Stream& stream) const {
  const int narrowest =
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(area) / kMaxAspect)));
  const int widest = static_cast<int>(std::sqrt(static_cast<double>(area)));
  const int narrow =
      kind == 'G' ? 1 : narrowest + Below(std::max(widest - narrowest, 0) + 1, stream);
  int size_x = narrow, size_y = std::max(area / narrow, 1);
  if (Below(2, stream) == 0) std::swap(size_x, size_y);
  const int x0 = 1 + Below(std::max(chars_.width - 2 - size_x, 0) + 1, stream);
  const int y0 = 1 + Below(std::max(chars_.height - 2 - size_y, 0) + 1, stream);
  return {x0, y0, x0 + size_x, y0 + size_y};
}

// Pushes furniture over the floor until it stands against something.
void FloorDrawing::SlideToWall(CellBox& box, Stream& stream) const {
  const Cell way = kSides[stream.Below(4)];
  const auto is_floor = [&](const CellBox& b) {
    for (int iy = b.y0; iy < b.y1; ++iy)
      for (int ix = b.x0; ix < b.x1; ++ix)
        if (!chars_.Inside(ix, iy) || chars_(ix, iy) != '.') return false;
    return true;
  };
  while (is_floor(Moved(box, way))) box = Moved(box, way);
}

// Lays the box along one of the outer walls, its longer side against it.
void FloorDrawing::MoveToBorder(CellBox& box, Stream& stream) const {
  const int length = std::max(Width(box), Height(box)), depth = std::min(Width(box), Height(box));
  const bool along_x = Below(2, stream) == 0, far = Below(2, stream) == 0;
  const int side = along_x ? chars_.width : chars_.height;
  const int across = along_x ? chars_.height : chars_.width;
  const int from = 1 + Below(std::max(side - 2 - length, 0) + 1, stream);
  const int at = far ? across - 1 - depth : 1;
  box = along_x ? CellBox{from, at, from + length, at + depth}
                : CellBox{at, from, at + depth, from + length};
}

bool FloorDrawing::AddCluster(char kind, const IntRange& cells, bool at_border, Stream& stream) {
  for (const Ring ring : {Ring::kClear, Ring::kNotOfItsKind})
    for (int i = 0; i < kTries; ++i) {
      CellBox box = DrawBox(kind, cells.Draw(stream), stream);
      if (at_border) MoveToBorder(box, stream);
      if (!Fits(box, kind, ring)) continue;
      Fill(box, kind);
      return true;
    }
  return false;
}

bool FloorDrawing::Furnish(int total, const IntRange& cells, Stream& stream) {
  int left = total;
  for (const Ring ring : {Ring::kClear, Ring::kAny})
    for (int failed = 0; left > 0 && failed < kTries;) {
      CellBox box = DrawBox('#', std::min(cells.Draw(stream), left), stream);
      if (Below(2, stream) == 0) SlideToWall(box, stream);
      if (!Fits(box, '#', ring)) {
        ++failed;
        continue;
      }
      failed = 0;
      left -= Area(box);
      Fill(box, '#');
    }
  if (left > 0) left -= FurnishCellByCell(left, stream);
  return left == 0 || FurnishLeaves(left, stream) == left;
}

int FloorDrawing::FurnishCellByCell(int most, Stream& stream) {
  std::vector<Cell> cells;
  for (int iy = 1; iy < chars_.height - 1; ++iy)
    for (int ix = 1; ix < chars_.width - 1; ++ix)
      if (chars_(ix, iy) == '.') cells.push_back({ix, iy});
  for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[stream.Below(i)]);
  constexpr int kRounds = 3;  // a cell may come free of its neighbours only after others are taken
  int placed = 0;
  for (int round = 0; round < kRounds; ++round)
    for (const Cell& c : cells) {
      if (placed == most) return placed;
      const CellBox box = {c.ix, c.iy, c.ix + 1, c.iy + 1};
      if (!Fits(box, '#', Ring::kAny)) continue;
      Fill(box, '#');
      ++placed;
    }
  return placed;
}

// Where the detour around a cell is longer than its ring, looking along the ring cannot tell
// whether the cell may go. A spanning tree of the floor can: its leaves may go. It is grown breadth
// first, so that the cell reached last has no cell behind it.
int FloorDrawing::FurnishLeaves(int most, Stream& stream) {
  Cell root{0, 0};
  for (int after = Below(free_, stream), iy = 0; iy < chars_.height; ++iy)
    for (int ix = 0; ix < chars_.width; ++ix)
      if (chars_(ix, iy) == '.' && after-- == 0) root = {ix, iy};
  constexpr int kNone = -1;
  std::vector<Cell> wave = {root};
  std::vector<int> parent = {kNone};
  std::vector<std::uint8_t> has_child = {0};
  Grid<std::uint8_t> seen(chars_.width, chars_.height);
  seen(root) = 1;
  for (std::size_t i = 0; i < wave.size(); ++i)
    for (const Cell& side : kSides) {
      const Cell next{wave[i].ix + side.ix, wave[i].iy + side.iy};
      if (!IsDrivable(chars_(next)) || seen(next)) continue;
      seen(next) = 1;
      wave.push_back(next);
      parent.push_back(static_cast<int>(i));
      has_child.push_back(0);
    }
  int placed = 0;
  for (std::size_t i = wave.size() - 1; i > 0 && placed < most; --i) {
    const Cell c = wave[i];
    if (chars_(c) == '.' && !door_(c) && !has_child[i]) {
      Fill({c.ix, c.iy, c.ix + 1, c.iy + 1}, '#');
      ++placed;
    } else {
      has_child[static_cast<std::size_t>(parent[i])] = 1;
    }
  }
  return placed;
}

FloorDrawing::Ends FloorDrawing::ChooseEnds(Stream& stream) const {
  Grid<std::uint8_t> hazard(chars_.width, chars_.height);
  for (std::size_t i = 0; i < hazard.cells.size(); ++i)
    hazard.cells[i] = chars_.cells[i] != '.' && chars_.cells[i] != '#';
  Grid<float> room = DistanceToCentres(hazard);
  float best = 0;
  for (std::size_t i = 0; i < room.cells.size(); ++i) {
    const bool free = chars_.cells[i] == '.';
    room.cells[i] = !free ? -1 : door_.cells[i] ? 0 : std::min(room.cells[i], kClearCells);
    best = std::max(best, room.cells[i]);
  }
  std::vector<Cell> starts;
  for (int iy = 0; iy < room.height; ++iy)
    for (int ix = 0; ix < room.width; ++ix)
      if (room(ix, iy) == best) starts.push_back({ix, iy});
  Ends ends;
  ends.start = starts[stream.Below(starts.size())];

  Grid<int> steps(chars_.width, chars_.height, -1);
  std::vector<Cell> wave = {ends.start};
  steps(ends.start) = 0;
  Cell farthest = ends.start;
  ends.goal = ends.start;
  for (std::size_t i = 0; i < wave.size(); ++i) {
    const Cell c = wave[i];
    if (chars_(c) == '.' && steps(c) > steps(farthest)) farthest = c;
    if (room(c) == best && steps(c) > steps(ends.goal)) ends.goal = c;
    for (const Cell& side : kSides) {
      const Cell next{c.ix + side.ix, c.iy + side.iy};
      if (!IsDrivable(chars_(next)) || steps(next) >= 0) continue;
      steps(next) = steps(c) + 1;
      wave.push_back(next);
    }
  }
  // Far comes before clear of hazards where the two do not go together.
  if (2 * steps(ends.goal) < steps(farthest)) ends.goal = farthest;
  return ends;
}

std::string FloorDrawing::Rows() const {
  std::string rows;
  for (int iy = chars_.height - 1; iy >= 0; --iy) {
    for (int ix = 0; ix < chars_.width; ++ix) rows += chars_(ix, iy);
    rows += '\n';
  }
  return rows;
}

}  // namespace floorproof
