// SPDX-License-Identifier: Apache-2.0
#include "planners/online/tool_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace floorproof {
namespace {

constexpr double kSlack = 1e-6;                             // cells
constexpr double kLeastAcross = 12, kMostAcross = 24;       // cells of the tool
constexpr double kMostCells = 4e7;                          // of a finer grid: some 30 bytes each
constexpr double kWorthIt = 0.01;                           // of a lane's width, more than that
constexpr int kStraight = 5, kDiagonal = 7, kSqueeze = 15;  // costs
constexpr double kPinned_m = 0.5;  // so near to the robot, where it can go no farther

// How far apart lanes of a tool that is `across` cells wide lie. Where tools touch on the middles
// of cells, within this, these count as swept.
int LaneCells(double across) { return static_cast<int>(across + 0.05); }

// Into how many parts a cell of the ground is divided. Lanes lie whole cells apart: of the
// finenesses at which the tool is some cells wide, the coarsest is taken at which lanes are almost
// as far apart as at any.
int Division(const GridFrame& ground, const Extent& tool) {
  const double across = 2 * std::min(tool.Reach().x(), tool.Reach().y()) / ground.cell_m;
  const auto share = [&](int division) {
    return LaneCells(division * across) / (division * across);
  };
  const int coarsest = std::max(1, static_cast<int>(std::ceil(kLeastAcross / across - kSlack)));
  int best = coarsest;
  const double cells = 1.0 * ground.width * ground.height;
  for (int d = coarsest + 1; d * across <= kMostAcross && d * d * cells <= kMostCells; ++d)
    if (share(d) > share(best) + kWorthIt) best = d;
  return best;
}

// Walls mostly lie on borders of the ground's cells. Of poses whose middles lie on borders of the
// grid or between them, those that come nearer to such a wall, which is to stay `clear_m` away.
double FirstPose(double clear_m, double cell_m) {
  const auto away = [=](double first_m) {
    return first_m + std::ceil((clear_m - first_m) / cell_m - kSlack) * cell_m;
  };
  return away(0) < away(cell_m / 2) ? 0 : cell_m / 2;
}

}  // namespace

ToolFloor::ToolFloor(const GridFrame& ground, const Extent& body, const Extent& clear,
                     const Extent& tool)
    : division_(Division(ground, tool)),
      body_(body / ground.cell_m),
      clear_(clear / (ground.cell_m / division_)),
      tool_(tool / (ground.cell_m / division_)),
      poses_(ground,
             ground.X_WG * Vec2::Constant(FirstPose(clear.half_m.x(), ground.cell_m / division_)),
             ground.cell_m / division_, clear),
      known_free_(poses_.frame().width, poses_.frame().height),
      open_(known_free_),
      stood_(known_free_),
      swept_(known_free_.width, known_free_.height),
      under_(known_free_.width, known_free_.height),
      search_(known_free_.cells.size()) {
  const Vec2 reach = tool_.Reach();
  const int rx = static_cast<int>(reach.x()), ry = static_cast<int>(reach.y());
  const auto holds = [this](Cell by) { return tool_.Holds(Vec2(by.ix, by.iy), kSlack); };
  for (std::size_t k = 0; k < kSteps.size(); ++k) {
    const Cell aside = kSteps[(k + 2) % kSteps.size()];
    while (holds(beside_[k] + aside)) beside_[k] = beside_[k] + aside;
    if (k % 2 == 1) {
      beside_[k] = beside_[k] + aside;
      continue;
    }
    // So far do both tools reach, this one and that of the lane beside it.
    const int under = std::abs(beside_[k].ix + beside_[k].iy);
    const int by = LaneCells(2 * (aside.ix != 0 ? reach.x() : reach.y())) - under;
    beside_[k] = {by * aside.ix, by * aside.iy};
  }
  for (int iy = -ry; iy <= ry; ++iy) {
    ToolRow row = {iy, -1};
    for (int ix = -rx; ix <= rx; ++ix) {
      const Cell by = {ix, iy};
      if (!holds(by)) continue;
      row.half = ix;
      tool_cells_.push_back(by);
      for (std::size_t k = 0; k < kSteps.size(); ++k)
        if (!holds(by + kSteps[k])) added_[k].push_back(by);
    }
    if (row.half >= 0) tool_rows_.push_back(row);
  }
}

void ToolFloor::Update(const KnownMap& known, std::span<const Cell> changed) {
  poses_.Update(known, changed);
  for (const Cell& ground : changed) {
    const bool free = known.At(ground) == CellState::kFree;
    if (known.marked(ground)) ForgetStanding(ground);
    for (int iy = ground.iy * division_; iy < (ground.iy + 1) * division_; ++iy)
      for (int ix = ground.ix * division_; ix < (ground.ix + 1) * division_; ++ix) {
        known_free_(ix, iy) = free;
        Tell({ix, iy});
      }
  }
}

// Cells whose middles the tool passes over.
void ToolFloor::Count(const Vec2& a_W, const Vec2& b_W, int by) {
  const Pose2 X_GW = frame().X_WG.Inverse();
  const Vec2 half = Vec2::Constant(0.5);  // a cell's middle is at its number
  const Vec2 a = X_GW * a_W / frame().cell_m - half, way = X_GW * b_W / frame().cell_m - half - a;
  const Vec2 reach = tool_.Reach();
  const Vec2 low = a.cwiseMin(a + way) - reach, high = a.cwiseMax(a + way) + reach;
  const int x0 = std::max(0, static_cast<int>(std::ceil(low.x()))),
            y0 = std::max(0, static_cast<int>(std::ceil(low.y()))),
            x1 = std::min(swept_.width - 1, static_cast<int>(std::floor(high.x()))),
            y1 = std::min(swept_.height - 1, static_cast<int>(std::floor(high.y())));
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      if (!tool_.PassesOver(Vec2(ix, iy) - a, way, kSlack)) continue;
      std::uint16_t& swept = swept_(ix, iy);
      swept = static_cast<std::uint16_t>(std::clamp(swept + by, 0, 0xffff));
      Tell({ix, iy});
    }
}

void ToolFloor::Tell(Cell c) {
  const bool open = known_free_(c) && swept_(c) == 0;
  if (open == (open_(c) != 0)) return;
  open_(c) = open;
  for (const ToolRow& row : tool_rows_) {
    const int iy = c.iy - row.iy;
    if (iy < 0 || iy >= under_.height) continue;
    const int first = std::max(0, c.ix - row.half),
              last = std::min(under_.width - 1, c.ix + row.half);
    for (int ix = first; ix <= last; ++ix)
      under_(ix, iy) = static_cast<std::uint16_t>(under_(ix, iy) + (open ? 1 : -1));
  }
}

void ToolFloor::Stand(const Vec2& a_W, const Vec2& b_W) {
  const double step_m = frame().cell_m / 2;
  const int n = static_cast<int>(std::ceil((b_W - a_W).norm() / step_m));
  for (int i = 0; i <= n; ++i) {
    const Cell at = poses_.At(a_W + (b_W - a_W) * i / std::max(n, 1));
    for (const Cell by : {Cell{0, 0}, Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}})
      if (stood_.Inside(at + by)) stood_(at + by) = 1;
  }
}

// No place beside it has more: the robot goes as deep into what is open as it can.
bool ToolFloor::IsPeak(Cell c, int open) const {
  return std::ranges::none_of(
      kSteps, [&](Cell step) { return IsFree(c + step) && OpenAt(c + step) > open; });
}

void ToolFloor::ForgetStanding(Cell ground) {
  const int rx = static_cast<int>(clear_.Reach().x()) + division_,
            ry = static_cast<int>(clear_.Reach().y()) + division_;
  const Cell middle = {ground.ix * division_ + division_ / 2,
                       ground.iy * division_ + division_ / 2};
  for (int iy = -ry; iy <= ry; ++iy)
    for (int ix = -rx; ix <= rx; ++ix)
      if (stood_.Inside(middle + Cell{ix, iy})) stood_(middle + Cell{ix, iy}) = 0;
}

// Where the way passes between the middles of two cells, both must be free; along a diagonal it
// passes through middles alone.
bool ToolFloor::Sees(Cell a, Cell b) const {
  const int dx = b.ix - a.ix, dy = b.iy - a.iy, n = std::max(std::abs(dx), std::abs(dy));
  for (int i = 0; i <= n; ++i) {
    const double x = a.ix + 1.0 * i * dx / std::max(n, 1), y = a.iy + 1.0 * i * dy / std::max(n, 1);
    const Cell low = {static_cast<int>(std::floor(x + kSlack)),
                      static_cast<int>(std::floor(y + kSlack))};
    const Cell high = {static_cast<int>(std::ceil(x - kSlack)),
                       static_cast<int>(std::ceil(y - kSlack))};
    if (!IsFree(low) || !IsFree(high)) return false;
  }
  return true;
}

std::vector<ToolFloor::Leg> ToolFloor::WayToOpen(Cell from, const Worth& worth) {
  std::vector<Leg> way = WayToOpen(from, worth, Squeeze::kNot, body_);
  const auto around = static_cast<std::int64_t>(2 * kPinned_m / frame().cell_m);
  const bool pinned = search_.pops() < around * around;
  if (way.empty()) way = WayToOpen(from, worth, Squeeze::kWhereItWent, body_);
  if (!way.empty() || !pinned) return way;
  // What is known may be a cell wrong.
  const double wrong = std::min(1.0, body_.half_m.minCoeff() / 4);
  for (const Extent& body : {body_, body_.Wider(-wrong)})
    if (way.empty()) way = WayToOpen(from, worth, Squeeze::kNearby, body);
  return way;
}

std::vector<ToolFloor::Leg> ToolFloor::WayToOpen(Cell from, const Worth& worth, Squeeze squeeze,
                                                 const Extent& body) {
  const int near = static_cast<int>(kPinned_m / frame().cell_m);
  const int width = frame().width;
  const auto number = [width](Cell c) { return c.iy * width + c.ix; };
  const auto cell = [width](int node) { return Cell{node % width, node / width}; };
  const auto squeezes = [&](Cell c) {
    if (squeeze == Squeeze::kNot || !known_free_.Inside(c)) return false;
    if (stood_(c)) return true;
    return squeeze == Squeeze::kNearby && std::abs(c.ix - from.ix) < near &&
           std::abs(c.iy - from.iy) < near && poses_.IsFreeFor(body, c);
  };
  search_.Begin();
  search_.Reach(number(from), 0);
  const int found = search_.Run(
      [&](const auto& at) {
        const Cell c = cell(at.node);
        const int open = OpenAt(c);
        const double way = static_cast<double>(at.cost) / kStraight;
        return open >= std::min(worth.least + worth.a_cell * way, worth.most) && IsFree(c) &&
               IsPeak(c, open);
      },
      [&](const auto& at, const auto& reach) {
        const Cell here = cell(at.node);
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
          const int cost = at.cost + (k % 2 == 0 ? kStraight : kDiagonal);
          if (poses_.MayStep(here, k))
            reach(number(here + kSteps[k]), cost);
          else if (squeezes(here + kSteps[k]))
            reach(number(here + kSteps[k]), cost + kSqueeze);
        }
      });
  std::vector<Leg> legs;
  if (found == search_.kNone) return legs;
  const std::vector<int> path = search_.PathTo(found);
  for (std::size_t i = 0; i + 1 < path.size();) {
    std::size_t next = i + 1;
    while (next + 1 < path.size() && Sees(cell(path[i]), cell(path[next + 1]))) ++next;
    const bool is_free = next > i + 1 || Sees(cell(path[i]), cell(path[next]));
    legs.push_back({frame().Center(cell(path[next])), is_free});
    i = next;
  }
  if (path.size() == 1) legs.push_back({frame().Center(cell(found)), true});
  return legs;
}

}  // namespace floorproof
