// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/search/grid_paths.h"

namespace floorproof {
namespace {

constexpr double kBeyond = 0.1;  // of a cell's width
constexpr double kSample = 0.1;  // cells
constexpr int kRanges = 10;

}  // namespace

RiskMeter::RiskMeter(const RiskMap& risk)
    : risk_(&risk), visits_of_(risk.grid.frame.width, risk.grid.frame.height) {}

void RiskMeter::Lift() {
  in_.reset();
  last_G_.reset();
}

void RiskMeter::Visit(Cell cell) {
  const auto terrain = [&](Cell c) { return risk_->grid.contents(c).terrain(); };
  if (terrain(cell) && !(in_ && terrain(*in_))) ++crossings_;
  in_ = cell;
  ++visits_;
  ++visits_of_(cell);
  sum_ += risk_->rf(cell);
}

void RiskMeter::Add(const Vec2& p_W) {
  const GridFrame& frame = risk_->grid.frame;
  const Vec2 to = frame.ToGrid(p_W) / frame.cell_m;
  const Vec2 from = last_G_.value_or(to);
  last_G_ = to;
  const int samples = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kSample)));
  for (int i = 1; i <= samples; ++i) {
    const Vec2 p = from + (to - from) * i / samples;
    const auto off = [&](Cell c) {
      return (p - Vec2(c.ix + 0.5, c.iy + 0.5)).cwiseAbs().maxCoeff();
    };
    if (in_ && off(*in_) <= 0.5 + kBeyond) continue;
    const Cell cell{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
    if (visits_of_.Inside(cell)) Visit(cell);
  }
}

RiskOfPath MeasureRisk(const RiskMap& risk, const Path& path) {
  RiskMeter meter(risk);
  for (const Waypoint& waypoint : path) meter.Add(waypoint.p_W);
  RiskOfPath out;
  out.cumulative_risk = meter.cumulative_risk();
  out.visits = meter.visits();
  out.terrain_crossings = meter.terrain_crossings();
  out.visits_of = meter.visits_of();

  const auto& cells = risk.grid.contents.cells;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!cells[i].solid)
      low = std::min(low, risk.rf.cells[i]), high = std::max(high, risk.rf.cells[i]);
  if (low > high) return out;
  for (int r = 0; r < kRanges; ++r)
    out.ranges.push_back(
        {low + (high - low) * r / kRanges, low + (high - low) * (r + 1) / kRanges, 0, 0});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int visits = out.visits_of.cells[i];
    if (visits > 0) ++out.cells, out.each_cell_once += risk.rf.cells[i];
    if (cells[i].solid) continue;
    const double share = high > low ? (risk.rf.cells[i] - low) / (high - low) : 0;
    auto& range = out.ranges[static_cast<std::size_t>(std::min(kRanges - 1.0, share * kRanges))];
    ++range.cells;
    range.visits += visits;
  }
  const Grid<std::uint8_t> drivable = CellsThat(risk.grid, &RiskCell::drivable);
  // On a fine map the robot may start where its cell holds a wall, too.
  const auto first = std::ranges::find_if(path, [&](const Waypoint& waypoint) {
    const Cell cell = risk.grid.frame.ToCell(waypoint.p_W);
    return drivable.Inside(cell) && drivable(cell);
  });
  if (first == path.end()) return out;
  const Grid<std::int32_t> steps = StepsFrom(drivable, risk.grid.frame.ToCell(first->p_W));
  int free = 0, covered = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i].free() || steps.cells[i] < 0) continue;
    ++free;
    covered += out.visits_of.cells[i] > 0;
  }
  out.coverage = free > 0 ? static_cast<double>(covered) / free : 0;
  return out;
}

}  // namespace floorproof
