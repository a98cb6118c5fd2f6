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
  const Vec2 start = ground.ToGrid(start_W) / ground.cell_m;
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
  ListNeeding();
  CountNeeded();
}

// Far from the ground's borders, cells that lie alike on the ground's need as many of them.
void RobotCells::CountNeeded() {
  std::vector<int> alike(static_cast<std::size_t>(division_ * division_), -1);
  const Vec2 ground(ground_.width, ground_.height), reach = clear_.Reach() + Vec2::Ones();
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix) {
      const Vec2 middle = MiddleOnGround({ix, iy});
      const bool inner = (middle.array() > reach.array()).all() &&
                         ((ground - middle).array() > reach.array()).all();
      if (inner && division_ > 0) {
        int& cells = alike[static_cast<std::size_t>(iy % division_ * division_ + ix % division_)];
        if (cells < 0) cells = NeededBy({ix, iy}).cells;
        not_free_(ix, iy) = cells;
        continue;
      }
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

// Whether any of it lies in the middle of a cell, or nearer to it than what is to be kept clear.
bool RobotCells::Needs(const Vec2& middle, const Extent& extent, Cell ground) {
  const Vec2 by = Vec2(ground.ix + 0.5, ground.iy + 0.5) - middle;
  return by.cwiseAbs().maxCoeff() < 0.5 + kSlack || extent.HoldsPartOf(by, 0.5, kSlack);
}

// The cells whose middles are so near to the ground's cell that they may need it.
RobotCells::Span RobotCells::Near(Cell ground) const {
  const Vec2 low = (Vec2(ground.ix, ground.iy) - corner_ - clear_.Reach()) / side_;
  const Vec2 high = (Vec2(ground.ix + 1, ground.iy + 1) - corner_ + clear_.Reach()) / side_;
  const auto first = [](double at) { return static_cast<int>(std::floor(at - 0.5)); };
  const auto last = [](double at) { return static_cast<int>(std::ceil(at - 0.5)); };
  return {{first(low.x()), first(low.y())}, {last(high.x()), last(high.y())}};
}

void RobotCells::ListNeeding() {
  const double cells = 1 / side_;
  if (std::abs(cells - std::round(cells)) > kSlack) return;
  division_ = static_cast<int>(std::lround(cells));
  const Span span = Near({0, 0});
  for (int iy = span.low.iy; iy <= span.high.iy; ++iy) {
    Row row = {iy, span.high.ix + 1, span.low.ix - 1};
    for (int ix = span.low.ix; ix <= span.high.ix; ++ix) {
      if (!Needs({ix, iy}, {0, 0})) continue;
      row.first = std::min(row.first, ix);
      row.last = ix;
    }
    if (row.first <= row.last) needing_.push_back(row);
  }
}

// Calls see(ground) with each of the ground's cells that a cell needs, those beyond it too.
template <class See>
void RobotCells::ForEachNeeded(Cell c, const Extent& extent, const See& see) const {
  const Vec2 middle = MiddleOnGround(c);
  const Vec2 low = middle - extent.Reach(), high = middle + extent.Reach();
  const auto down = [](double m) { return static_cast<int>(std::floor(m)); };
  for (int iy = down(low.y()); iy <= down(high.y()); ++iy)
    for (int ix = down(low.x()); ix <= down(high.x()); ++ix)
      if (Needs(middle, extent, {ix, iy})) see(Cell{ix, iy});
}

RobotCells::Needed RobotCells::NeededBy(Cell c) const {
  Needed needed;
  ForEachNeeded(c, clear_, [&](Cell ground) {
    ++needed.cells;
    needed.beyond += ground_.Inside(ground) ? 0 : 1;
  });
  return needed;
}

bool RobotCells::IsFreeFor(const Extent& extent, Cell c) const {
  bool free = frame_.Inside(c);
  ForEachNeeded(c, extent, [&](Cell ground) {
    free &= taken_.Inside(ground) && taken_(ground) == CellState::kFree;
  });
  return free;
}

void RobotCells::Update(const KnownMap& known, std::span<const Cell> changed) {
  if (changed_) changed_->clear();
  for (const Cell& c : changed) {
    const CellState now = known.At(c);
    if (now == taken_(c)) continue;
    Take(c, taken_(c), now);
    taken_(c) = now;
  }
}

void RobotCells::Change(int ix, int iy, int not_free, int blocked) {
  not_free_(ix, iy) += not_free;
  blocked_(ix, iy) += blocked;
  if (changed_) changed_->push_back({ix, iy});
}

void RobotCells::Take(Cell ground, CellState was, CellState now) {
  const int not_free = (was == CellState::kFree ? 1 : 0) - (now == CellState::kFree ? 1 : 0);
  const int blocked = (now == CellState::kOccupied ? 1 : 0) - (was == CellState::kOccupied ? 1 : 0);
  for (const Row& row : needing_) {
    const int iy = row.iy + ground.iy * division_;
    if (iy < 0 || iy >= frame_.height) continue;
    const int first = std::max(0, row.first + ground.ix * division_),
              last = std::min(frame_.width - 1, row.last + ground.ix * division_);
    for (int ix = first; ix <= last; ++ix) Change(ix, iy, not_free, blocked);
  }
  if (division_ > 0) return;
  const Span span = Near(ground);
  for (int iy = std::max(0, span.low.iy); iy <= std::min(frame_.height - 1, span.high.iy); ++iy)
    for (int ix = std::max(0, span.low.ix); ix <= std::min(frame_.width - 1, span.high.ix); ++ix)
      if (Needs({ix, iy}, ground)) Change(ix, iy, not_free, blocked);
}

}  // namespace floorproof
