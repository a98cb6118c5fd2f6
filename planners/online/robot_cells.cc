// SPDX-License-Identifier: Apache-2.0
#include "planners/online/robot_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

constexpr double kSlack = 1e-9;  // of a cell: sums of lengths are not exact

// Where a row of cells of this side begins, at 0 or less than a side before it, such that `middle`
// is the middle of one.
double Corner(double middle, double side) {
  const double cells = middle / side - 0.5;
  const double beyond = cells - std::floor(cells + kSlack);
  return beyond < kSlack ? 0 : (beyond - 1) * side;
}

}  // namespace

RobotCells CellsOf(const OnlineTask& task, const OnlineParams& params) {
  return {task.ground, task.start.p(), params.step_m.value_or(task.tool_width_m), task.clear};
}

RobotCells::RobotCells(const GridFrame& ground, const Vec2& start_W, double step_m,
                       const Extent& clear)
    : ground_(ground),
      side_(step_m / ground.cell_m),
      clear_(clear / ground.cell_m),
      taken_(ground.width, ground.height, CellState::kUnknown) {
  const Vec2 start = ground.X_WG.Inverse() * start_W / ground.cell_m;
  corner_ = {Corner(start.x(), side_), Corner(start.y(), side_)};
  const auto cells = [this](int n, double corner) {
    return static_cast<int>(std::ceil((n - corner) / side_ - kSlack));
  };
  const Vec2 corner_W = ground.X_WG * Vec2(corner_ * ground.cell_m);
  frame_ = {cells(ground.width, corner_.x()),
            cells(ground.height, corner_.y()),
            step_m,
            {corner_W.x(), corner_W.y(), ground.X_WG.yaw_rad}};
  visits_ = Grid<std::int32_t>(frame_.width, frame_.height);
  not_free_ = blocked_ = Grid<std::int32_t>(frame_.width, frame_.height);
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix) {
      const Needed needed = NeededBy({ix, iy});
      not_free_(ix, iy) = needed.cells;
      blocked_(ix, iy) = needed.beyond;
    }
}

Cell RobotCells::FreeAt(const Vec2& p_W, int reach) const {
  const Cell here = At(p_W);
  if (IsFree(here)) return here;
  Cell nearest = here;
  double least_m = std::numeric_limits<double>::infinity();
  for (int iy = -reach; iy <= reach; ++iy)
    for (int ix = -reach; ix <= reach; ++ix) {
      const Cell c = here + Cell{ix, iy};
      const double way_m = (frame_.Center(c) - p_W).norm();
      if (!IsFree(c) || way_m >= least_m) continue;
      least_m = way_m;
      nearest = c;
    }
  return nearest;
}

Vec2 RobotCells::MiddleOnGround(Cell c) const {
  return corner_ + side_ * Vec2(c.ix + 0.5, c.iy + 0.5);
}

// Whether any of it lies in the cell's middle, or nearer to it than what is to be kept clear.
bool RobotCells::Needs(Cell c, Cell ground) const {
  const Vec2 middle = MiddleOnGround(c);
  const Vec2 low(ground.ix, ground.iy);
  const Vec2 nearest = middle.cwiseMax(low).cwiseMin(low + Vec2::Ones());
  const Vec2 by = nearest - middle;
  return by.norm() < kSlack || clear_.Holds(by, kSlack);
}

RobotCells::Needed RobotCells::NeededBy(Cell c) const {
  const Vec2 middle = MiddleOnGround(c);
  const Vec2 reach = clear_.Reach();
  const Vec2 low = middle - reach, high = middle + reach;
  const auto down = [](double m) { return static_cast<int>(std::floor(m)); };
  Needed needed;
  for (int iy = down(low.y()); iy <= down(high.y()); ++iy)
    for (int ix = down(low.x()); ix <= down(high.x()); ++ix) {
      if (!Needs(c, {ix, iy})) continue;
      ++needed.cells;
      needed.beyond += ground_.Inside({ix, iy}) ? 0 : 1;
    }
  return needed;
}

void RobotCells::Update(const KnownMap& known, std::span<const Cell> changed) {
  changed_.clear();
  for (const Cell& c : changed) {
    const CellState now = known.At(c);
    if (now == taken_(c)) continue;
    Take(c, taken_(c), now);
    taken_(c) = now;
  }
}

void RobotCells::Take(Cell ground, CellState was, CellState now) {
  const Vec2 low = Vec2(ground.ix, ground.iy) - corner_ - clear_.Reach();
  const Vec2 high = Vec2(ground.ix + 1, ground.iy + 1) - corner_ + clear_.Reach();
  const auto first = [&](double m) {
    return std::max(0, static_cast<int>(std::floor(m / side_ - 0.5)));
  };
  const auto last = [&](double m, int cells) {
    return std::min(cells - 1, static_cast<int>(std::ceil(m / side_ - 0.5)));
  };
  const int x1 = last(high.x(), frame_.width), y1 = last(high.y(), frame_.height);
  for (int iy = first(low.y()); iy <= y1; ++iy)
    for (int ix = first(low.x()); ix <= x1; ++ix)
      if (Needs({ix, iy}, ground)) {
        not_free_(ix, iy) += (was == CellState::kFree ? 1 : 0) - (now == CellState::kFree ? 1 : 0);
        blocked_(ix, iy) +=
            (now == CellState::kOccupied ? 1 : 0) - (was == CellState::kOccupied ? 1 : 0);
        changed_.push_back({ix, iy});
      }
}

}  // namespace floorproof
