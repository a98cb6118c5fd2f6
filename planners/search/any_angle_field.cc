// SPDX-License-Identifier: Apache-2.0
// Roots (the source, and corners where shortest paths turn) are settled in the order of their
// distances. Each looks at what only it opens: a cone, row by row, cut by the runs of full squares
// between two rows. The places seen take its distance and straight lines from there, where that is
// less. Corners of obstacles that are seen become roots. After Harabor, Grastien, Oez & Aksakalli,
// "Optimal Any-Angle Pathfinding In Practice", JAIR 56, 2016, whose search nodes are roots with
// intervals of rows. It seeks one target; here all places are reached, so there is no lower bound
// ahead, and what prunes is the distances of the places:
//   - Along a ray from a root, others can only gain on it: their distance grows by no more than the
//     ray does. So a part of a cone where the root is worse is given up for good.
//   - What is known are distances at places, and a root may be better between two where it is not.
//     From these, others come along the row. Where the root is behind by g at both places, its
//     slope between them being s, it is behind in between if g >= (1 - s^2) / 2 (the margin).
// A cone waits in the queue once it is kAhead farther than what is settled, so that few places are
// reached twice. This is exact but for float: what is less by under 5e-7 of itself counts as equal.
// Assumed: fewer than 2^31 places, sides below 30,000. Not done: costs that differ from place to
// place, obstacles finer than full squares.
#include "planners/search/any_angle_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace floorproof {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr PlaceBlock kUnreached = {{kFar, kFar, kFar, kFar}, {-1, -1, -1, -1}};
constexpr double kAhead = 64;  // cells; fewer: more cones wait, more: places are reached again
// Slopes that differ at all do so by more, on floors of up to 30,000 rows.
constexpr double kSame = 1e-9;

double Hypotenuse(double dx, double dy) { return std::sqrt(dx * dx + dy * dy); }

// The least distance from a root to a row, within a cone.
double LeastWay(double left, double right, int rows) {
  const double slope = std::clamp(0.0, left, right);
  return std::isinf(slope) ? rows : rows * std::sqrt(1 + slope * slope);
}

// By how much a root must be behind at two neighbouring places of a row, to be so in between. The
// slope changes between them, the more the nearer the root is.
double Margin(int rows, int dx) {
  const double high = static_cast<double>(rows) * rows, wide = static_cast<double>(dx) * dx;
  return 0.5 * (1 + 0.4 / rows) * high / (high + wide);
}

}  // namespace

AnyAngleField::AnyAngleField(const AnyAngleFloor& floor)
    : floor_(floor),
      pitch_((floor.width() + PlaceBlock::kPlaces - 1) / PlaceBlock::kPlaces),
      blocks_(Z(pitch_) * Z(floor.height()), kUnreached) {}

double AnyAngleField::DistanceTo(Cell c) const {
  if (!floor_.IsFree(c)) return kInfinity;
  const int root = RootOf(PlaceOf(c));
  return root == kNone ? kInfinity : Through(root, c);
}

std::vector<Cell> AnyAngleField::PathTo(Cell c) const {
  std::vector<Cell> path;
  if (std::isinf(DistanceTo(c))) return path;
  const auto goes_on = [&](Cell to) {  // straight beyond the last leg
    if (path.size() < 2) return false;
    const Cell b = path.back(), a = path[path.size() - 2];
    const Cell u{b.ix - a.ix, b.iy - a.iy}, v{to.ix - b.ix, to.iy - b.iy};
    return u.ix * v.iy == u.iy * v.ix && u.ix * v.ix + u.iy * v.iy > 0;
  };
  path.push_back(c);
  for (int root = RootOf(PlaceOf(c)); root != kNone; root = roots_[Z(root)].parent) {
    const Cell at = roots_[Z(root)].at;
    if (at == path.back()) continue;
    if (goes_on(at)) path.pop_back();
    path.push_back(at);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::size_t AnyAngleField::bytes() const {
  return blocks_.capacity() * sizeof(PlaceBlock) + roots_.capacity() * sizeof(Root) +
         queue_.capacity() * sizeof(Entry) + unused_.capacity() * sizeof(int) +
         (waiting_.capacity() + stack_.capacity()) * sizeof(Cone);
}

double AnyAngleField::Through(int root, Cell c) const {
  const Root& from = roots_[Z(root)];
  return from.distance + Hypotenuse(c.ix - from.at.ix, c.iy - from.at.iy);
}

void AnyAngleField::From(Cell source) {
  std::fill(blocks_.begin(), blocks_.end(), kUnreached);
  roots_.clear(), queue_.clear(), waiting_.clear(), unused_.clear();
  work_ = 0;
  if (!floor_.IsFree(source)) return;
  Reach(PlaceOf(source), 0, 0);
  roots_.push_back({source, kNone, 0});
  limit_ = kAhead;
  OpenSource(0);
  TakeThinSteps(0);
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), IsLater);
    const Entry entry = queue_.back();
    queue_.pop_back();
    limit_ = entry.distance + kAhead;
    Settle(entry);
  }
}

void AnyAngleField::Settle(const Entry& entry) {
  if (entry.kind == Kind::kCone) {
    const Cone cone = waiting_[Z(entry.place)];
    unused_.push_back(entry.place);
    Scan(cone);
    return;
  }
  if (RootOf(entry.place) != entry.parent) return;  // reached for less since
  const int root = static_cast<int>(roots_.size());
  roots_.push_back({CellOf(entry.place), entry.parent, entry.distance});
  if (entry.kind == Kind::kCorner) return OpenCorner(root, entry);
  if (entry.kind == Kind::kSource) OpenSource(root);
  TakeThinSteps(root);
}

bool AnyAngleField::IsLater(const Entry& a, const Entry& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  const auto rest = [](const Entry& e) {
    return std::tie(e.place, e.kind, e.parent, e.sx, e.sy, e.upright);
  };
  return rest(a) > rest(b);
}

void AnyAngleField::Push(const Entry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end(), IsLater);
}

void AnyAngleField::PushCone(const Cone& cone, double distance) {
  if (unused_.empty()) {
    unused_.push_back(static_cast<int>(waiting_.size()));
    waiting_.emplace_back();
  }
  const int number = unused_.back();
  unused_.pop_back();
  waiting_[Z(number)] = cone;
  Push({distance, number, kNone, Kind::kCone});
}

// Only where no other root reaches the corner for less.
void AnyAngleField::PushCorner(int root, Cell c, int sx, int sy, bool upright) {
  const int place = PlaceOf(c);
  if (RootOf(place) != root) return;
  Push({Through(root, c), place, root, Kind::kCorner, static_cast<std::int8_t>(sx),
        static_cast<std::int8_t>(sy), upright});
}

void AnyAngleField::PushIfThin(int root, Cell c) {
  const int place = PlaceOf(c);
  if (floor_.IsThin(c) && RootOf(place) == root) Push({Through(root, c), place, root, Kind::kThin});
}

void AnyAngleField::OpenSource(int root) {
  for (const Cell step : kSideSteps) FollowRay(root, step);
  for (const int up : {1, -1}) Scan({root, 0, up, -kInfinity, kInfinity});
}

// The part of a quadrant to which only a path that turns here leads: from the line of the leg
// before to the obstacle's side.
void AnyAngleField::OpenCorner(int root, const Entry& entry) {
  const Cell at = roots_[Z(root)].at, before = roots_[Z(entry.parent)].at;
  const int dx = at.ix - before.ix, dy = std::abs(at.iy - before.iy);
  const double line = dy == 0 ? entry.sx * kInfinity : static_cast<double>(dx) / dy;
  const double side = entry.upright ? 0.0 : entry.sx * kInfinity;
  FollowRay(root, entry.upright ? Cell{0, entry.sy} : Cell{entry.sx, 0});
  Scan({root, 0, entry.sy, std::min(line, side), std::max(line, side)});
}

// Behind a thin step all directions are open.
void AnyAngleField::TakeThinSteps(int root) {
  const Root from = roots_[Z(root)];
  floor_.ForThinSteps(from.at, [&](Cell to, double length) {
    const int place = PlaceOf(to);
    const double distance = from.distance + length;
    if (!IsLess(static_cast<float>(distance), ReachOf(place))) return;
    Reach(place, distance, root);
    ++work_;
    Push({distance, place, root, Kind::kSource});
  });
}

// Along the sides of squares: scans see only what lies between rays. Where others are as near, it
// goes on, since they may not see the corners behind.
void AnyAngleField::FollowRay(int root, Cell step) {
  const Root from = roots_[Z(root)];
  Cell c = from.at;
  for (double distance = from.distance + 1; floor_.IsOpen(c, step); distance += 1) {
    c = c + step;
    const int place = PlaceOf(c);
    const auto now = static_cast<float>(distance);
    if (IsLess(ReachOf(place), now)) return;
    if (IsLess(now, ReachOf(place))) Reach(place, distance, root);
    ++work_;
    PushIfThin(root, c);
    for (const int side : {1, -1}) {
      const int across_x = side * step.iy, across_y = side * step.ix;
      const int sx = step.ix + across_x, sy = step.iy + across_y;  // ahead on this side
      if (floor_.IsFull(c, sx, sy) && !floor_.IsFull(c, across_x - step.ix, across_y - step.iy))
        PushCorner(root, c, sx, sy, step.iy == 0);
    }
  }
}

void AnyAngleField::Scan(const Cone& cone) {
  stack_.push_back(cone);
  while (!stack_.empty()) {
    const Cone next = stack_.back();
    stack_.pop_back();
    const double distance =
        roots_[Z(next.root)].distance + LeastWay(next.left, next.right, next.rows + 1);
    if (distance <= limit_)
      ScanBand(next);
    else
      PushCone(next, distance);
  }
}

// From the cone's row on to the next, through each run of full squares between them that it meets.
// Where such a run begins within the cone, on the far side of an obstacle, there is a corner.
void AnyAngleField::ScanBand(const Cone& cone) {
  const Cell at = roots_[Z(cone.root)].at;
  const int iy = at.iy + cone.up * cone.rows;
  const int band = cone.up > 0 ? iy : iy - 1;
  if (band < 0 || band + 1 >= floor_.height()) return;
  const double left = cone.rows == 0 ? 0 : cone.left * cone.rows;
  const double right = cone.rows == 0 ? 0 : cone.right * cone.rows;
  const auto runs = floor_.Runs(band);
  auto run = std::lower_bound(runs.begin(), runs.end(), at.ix + left - kSame,
                              [](const AnyAngleFloor::Run& r, double x) { return r.last < x; });
  for (; run != runs.end() && run->first - at.ix <= right + kSame; ++run) {
    const int a = run->first - at.ix, b = run->last - at.ix;
    if (a > 0 && a >= left - kSame) PushCorner(cone.root, {run->first, iy}, 1, cone.up, true);
    if (b < 0 && b <= right + kSame) PushCorner(cone.root, {run->last, iy}, -1, cone.up, true);
    Enter(cone, *run);
  }
}

void AnyAngleField::Enter(const Cone& cone, const AnyAngleFloor::Run& run) {
  const Cell at = roots_[Z(cone.root)].at;
  const int rows = cone.rows + 1, iy = at.iy + cone.up * rows;
  const int a = run.first - at.ix, b = run.last - at.ix;
  // An end of the run on the root's own side bounds the view where the ray leaves the run, one
  // beyond the root's column where it enters.
  const auto slope = [&](int x, bool where_it_leaves) {
    return x == 0 ? 0.0 : static_cast<double>(x) / (where_it_leaves ? rows : cone.rows);
  };
  Cone next = cone;
  next.rows = rows;
  if (const double end = slope(a, a < 0); end > next.left) next.left = end, next.left_lost = false;
  if (const double end = slope(b, b > 0); end < next.right)
    next.right = end, next.right_lost = false;
  if (next.right - next.left < kSame) return;  // a ray; the corners that bound it follow it
  const int x1 = at.ix + static_cast<int>(std::ceil(next.left * rows - kSame));
  const int x2 = at.ix + static_cast<int>(std::floor(next.right * rows + kSame));
  if (x1 > x2) {
    stack_.push_back(next);
    return;
  }
  const PaintedRow painted = Paint(cone.root, iy, x1, x2);
  if (a < 0 && x1 == run.first && floor_.IsFull({x1, iy}, -1, cone.up))
    PushCorner(cone.root, {x1, iy}, -1, cone.up, false);
  if (b > 0 && x2 == run.last && floor_.IsFull({x2, iy}, 1, cone.up))
    PushCorner(cone.root, {x2, iy}, 1, cone.up, false);
  Trim(next, x1, x2, painted);
}

PaintedRow AnyAngleField::Paint(int root, int iy, int x1, int x2) {
  const Root& from = roots_[Z(root)];
  const int rows = std::abs(iy - from.at.iy);
  const double margin = Margin(rows, std::clamp(from.at.ix, x1, x2) - from.at.ix);
  Prefetch(iy + (iy > from.at.iy ? 2 : -2), x1, x2);
  const PaintedRow painted = PaintRow(
      {root, static_cast<float>(from.distance), from.at.ix, rows, static_cast<float>(margin)}, x1,
      x2, &blocks_[Z(iy) * Z(pitch_)]);
  work_ += x2 - x1 + 1;
  if (const auto thin = floor_.ThinPlaces(iy); !thin.empty())
    for (auto x = std::lower_bound(thin.begin(), thin.end(), painted.first);
         x != thin.end() && *x <= painted.last; ++x)
      PushIfThin(root, {*x, iy});
  return painted;
}

// Each row lies on another page of memory; the one after next is about what the scan needs soon.
void AnyAngleField::Prefetch(int iy, int x1, int x2) const {
  if (iy < 0 || iy >= floor_.height()) return;
  const PlaceBlock* row = &blocks_[Z(iy) * Z(pitch_)];
  for (int x = x1; x <= x2; x += 2 * PlaceBlock::kPlaces)
    __builtin_prefetch(row + x / PlaceBlock::kPlaces, 1);
}

// Whether the root may be better between an end of the cone and the place x beside it, less than a
// cell away: others come along the row from x.
bool AnyAngleField::MayBeBetter(const Cone& cone, double slope, int x) const {
  const Root& root = roots_[Z(cone.root)];
  const double dx = x - root.at.ix, length = Hypotenuse(dx, cone.rows),
               width = dx - slope * cone.rows;
  const int iy = root.at.iy + cone.up * cone.rows;
  const double behind = root.distance + length - static_cast<double>(ReachOf(PlaceOf({x, iy})));
  return behind < std::abs(width) + width * dx / length - 1e-6 * (root.distance + length);
}

// Goes on with the part of the cone where the root may be better.
void AnyAngleField::Trim(Cone cone, int x1, int x2, const PaintedRow& painted) {
  const int ix = roots_[Z(cone.root)].at.ix;
  const auto slope = [&](int x) { return static_cast<double>(x - ix) / cone.rows; };
  const bool left_lives =
      painted.first == x1 || (!cone.left_lost && MayBeBetter(cone, cone.left, x1));
  const bool right_lives =
      painted.last == x2 || (!cone.right_lost && MayBeBetter(cone, cone.right, x2));
  const bool none = painted.first > painted.last;
  if (none && !left_lives && !right_lives) return;
  const int first = none ? (left_lives ? x1 : x2) : painted.first;
  const int last = none ? (right_lives ? x2 : x1) : painted.last;
  if (!left_lives && slope(first - 1) > cone.left)
    cone.left = slope(first - 1), cone.left_lost = true;
  if (!right_lives && slope(last + 1) < cone.right)
    cone.right = slope(last + 1), cone.right_lost = true;
  stack_.push_back(cone);
}

}  // namespace floorproof
