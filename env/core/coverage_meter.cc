// SPDX-License-Identifier: Apache-2.0
// Counts swept cells along a motion. A disc that moves straight sweeps a capsule, which is filled
// row by row; each cell is entered and left at known path lengths, so that long segments and many
// short ones give the same passes. A footprint is stamped at steps of at most half a cell.
#include <algorithm>
#include <limits>

#include "env/core/line_of_sight.h"
#include "env/core/plan_passes.h"
#include "env/geometry/box.h"

namespace floorproof {
namespace {

double ToolExtent(const Shape2& tool) {
  if (tool.kind == Shape2::Kind::kCircle) return 2 * tool.radius_m;
  return BoxAround(tool.footprint_B).Size().maxCoeff();
}

double Reach(const Shape2& tool) {
  double reach = tool.radius_m;
  if (tool.kind == Shape2::Kind::kFootprint)
    for (const Vec2& p : tool.footprint_B) reach = std::max(reach, p.norm());
  return reach;
}

struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void Add(double from, double to) { low = std::min(low, from), high = std::max(high, to); }
};

// The x of a disc at height y.
void AddDisc(const Vec2& centre, double r, double y, Span& span) {
  const double h2 = r * r - (y - centre.y()) * (y - centre.y());
  if (h2 >= 0) span.Add(centre.x() - std::sqrt(h2), centre.x() + std::sqrt(h2));
}

// First and last cell whose centre lies in [low, high] (in cells), within 0 .. limit - 1.
std::pair<int, int> CentresIn(double low, double high, int limit) {
  return {static_cast<int>(std::ceil(std::clamp(low - 0.5, 0.0, limit + 0.0))),
          static_cast<int>(std::floor(std::clamp(high - 0.5, -1.0, limit - 1.0)))};
}

}  // namespace

CoverageMeter::CoverageMeter(const SweepArea& area, const Shape2& tool)
    : area_(&area),
      passes_(area.frame.width, area.frame.height),
      last_s_m_(area.frame.width, area.frame.height) {
  SetTool(tool);
}

void CoverageMeter::SetTool(const Shape2& tool) {
  Lift();
  tool_ = tool;
  gap_m_ = 2 * ToolExtent(tool);
  reach_m_ = Reach(tool);
  // Rows of a plan often put a footprint's edge exactly on cell centres. A tenth of a millimetre
  // must not decide whether these cells count as swept.
  constexpr double kEdge_m = 0.002;
  if (tool_.kind == Shape2::Kind::kFootprint) {
    tool_.footprint_B = Offset(tool_.footprint_B, kEdge_m);
    reach_m_ += std::sqrt(2.0) * kEdge_m;
    footprint_G_.resize(tool_.footprint_B.size());
    crossings_.reserve(footprint_G_.size());
  }
}

double CoverageMeter::OfSweepable(std::int64_t cells) const {
  return area_->sweepable_cells == 0
             ? 0.0
             : static_cast<double>(cells) / static_cast<double>(area_->sweepable_cells);
}

double CoverageMeter::overlap() const {
  return swept_ == 0 ? 0.0 : static_cast<double>(twice_) / static_cast<double>(swept_);
}

void CoverageMeter::Touch(int ix, int iy, double enter_s_m, double leave_s_m) {
  std::uint8_t& passes = passes_(ix, iy);
  float& last = last_s_m_(ix, iy);
  if (passes == 0 || enter_s_m - static_cast<double>(last) > gap_m_) {
    if (passes < 255) ++passes;
    if (area_->sweepable(ix, iy)) {
      swept_ += passes == 1;
      twice_ += passes == 2;
      ++passed_;
    }
  }
  last = std::max(last, static_cast<float>(leave_s_m));
}

// Whether the centre sees the cell at some place between `first` and `last` along the way, in
// cells. The middle of that stretch is nearest to the cell, and is tried first.
bool CoverageMeter::SeesOnTheWay(const Vec2& from_G, const Vec2& dir, double first, double last,
                                 const Vec2& cell_G) const {
  const auto sees = [&](double along) {
    return InSight(area_->clearance_m, area_->frame.cell_m, from_G + along * dir, cell_G);
  };
  if (sees((first + last) / 2)) return true;
  const int n = static_cast<int>(std::ceil(last - first));
  for (int k = 0; k <= n; ++k)
    if (sees(n == 0 ? first : first + (last - first) * k / n)) return true;
  return false;
}

void CoverageMeter::SweepDisc(const Vec2& from_G, const Vec2& to_G, double length_m) {
  // A cell whose centre lies on the rim counts, here as in ComputeSweepArea, whatever the rounding.
  constexpr double kEps = 1e-6;
  const double cell_m = area_->frame.cell_m, r = tool_.radius_m / cell_m + kEps;
  const Vec2 way = to_G - from_G;
  const double length = way.norm();
  const Vec2 dir = length > 0 ? Vec2(way / length) : Vec2(1, 0);
  const auto [y0, y1] = CentresIn(std::min(from_G.y(), to_G.y()) - r,
                                  std::max(from_G.y(), to_G.y()) + r, passes_.height);
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5;
    Span span;
    AddDisc(from_G, r, y, span);
    AddDisc(to_G, r, y, span);
    // The strip between the discs: |offset across the way| <= r and 0 <= offset along it <= length.
    if (length > 0) {
      double low = -std::numeric_limits<double>::infinity(), high = -low;
      const auto clip = [&](double slope, double base, double min, double max) {
        // min <= slope * x + base <= max
        if (std::abs(slope) < 1e-12) {
          if (base < min || base > max) high = -std::numeric_limits<double>::infinity();
          return;
        }
        const double u = (min - base) / slope, v = (max - base) / slope;
        low = std::max(low, std::min(u, v)), high = std::min(high, std::max(u, v));
      };
      const double dy = y - from_G.y();
      clip(dir.x(), dir.y() * dy - dir.x() * from_G.x(), 0, length);
      clip(-dir.y(), dir.x() * dy + dir.y() * from_G.x(), -r, r);
      if (low <= high) span.Add(low, high);
    }
    if (span.low > span.high) continue;
    const auto [x0, x1] = CentresIn(span.low, span.high, passes_.width);
    for (int ix = x0; ix <= x1; ++ix) {
      const Vec2 d = Vec2(ix + 0.5, y) - from_G;
      const double along = d.dot(dir), across = Cross(dir, d);
      const double half = std::sqrt(std::max(0.0, r * r - across * across));
      if (!area_->hidden.cells.empty() &&
          !SeesOnTheWay(from_G, dir, std::clamp(along - half, 0.0, length),
                        std::clamp(along + half, 0.0, length), {ix + 0.5, y}))
        continue;
      Touch(ix, iy, s_m_ + std::clamp((along - half) * cell_m, 0.0, length_m),
            s_m_ + std::clamp((along + half) * cell_m, 0.0, length_m));
    }
  }
}

// Row by row: the cell centres between an edge where the row enters the footprint and the next,
// where it leaves.
void CoverageMeter::StampFootprint(const Pose2& X_GB, double s_m) {
  const double c = std::cos(X_GB.yaw_rad) / area_->frame.cell_m,
               d = std::sin(X_GB.yaw_rad) / area_->frame.cell_m;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < footprint_G_.size(); ++i) {
    const Vec2& p_B = tool_.footprint_B[i];
    footprint_G_[i] = X_GB.p() + Vec2(c * p_B.x() - d * p_B.y(), d * p_B.x() + c * p_B.y());
    low = std::min(low, footprint_G_[i].y()), high = std::max(high, footprint_G_[i].y());
  }
  const auto [y0, y1] = CentresIn(low, high, passes_.height);
  for (int iy = y0; iy <= y1; ++iy) {
    const double y = iy + 0.5;
    crossings_.clear();
    for (std::size_t i = 0, j = footprint_G_.size() - 1; i < footprint_G_.size(); j = i++) {
      const Vec2 &a = footprint_G_[j], &b = footprint_G_[i];
      if ((a.y() <= y) != (b.y() <= y))
        crossings_.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
    std::ranges::sort(crossings_);
    for (std::size_t k = 0; k + 1 < crossings_.size(); k += 2) {
      const auto [x0, x1] = CentresIn(crossings_[k], crossings_[k + 1], passes_.width);
      for (int ix = x0; ix <= x1; ++ix) Touch(ix, iy, s_m, s_m);
    }
  }
}

void CoverageMeter::Add(const Pose2& X_WB) {
  const GridFrame& frame = area_->frame;
  const auto to_grid = [&frame](const Pose2& X) {
    const Pose2 X_GB = frame.X_WG.Inverse() * X;
    return Pose2{X_GB.x_m / frame.cell_m, X_GB.y_m / frame.cell_m, X_GB.yaw_rad};
  };
  const Pose2 to = to_grid(X_WB), from = has_last_ ? to_grid(last_) : to;
  const double length_m = (to.p() - from.p()).norm() * frame.cell_m;
  if (tool_.kind == Shape2::Kind::kCircle) {
    SweepDisc(from.p(), to.p(), length_m);
  } else {
    const double turn = WrapAngle(to.yaw_rad - from.yaw_rad);
    const double travel = length_m + std::abs(turn) * reach_m_;
    const int n = std::max(1, static_cast<int>(std::ceil(travel / (0.5 * frame.cell_m))));
    for (int i = has_last_ ? 1 : n; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      const Vec2 p = from.p() + t * (to.p() - from.p());
      StampFootprint({p.x(), p.y(), from.yaw_rad + t * turn}, s_m_ + t * length_m);
    }
  }
  s_m_ += length_m;
  last_ = X_WB;
  has_last_ = true;
}

CoverageMeter PassesOf(const SweepArea& area, const Shape2& tool, const Path& path) {
  CoverageMeter meter(area, tool);
  double yaw_rad = area.frame.X_WG.yaw_rad;
  for (const Waypoint& w : path) {
    yaw_rad = w.yaw_rad.value_or(yaw_rad);
    meter.Add({w.p_W.x(), w.p_W.y(), yaw_rad});
  }
  return meter;
}

PathCoverage MeasureCoverage(const SweepArea& area, const Shape2& tool, const Path& path) {
  const CoverageMeter meter = PassesOf(area, tool, path);
  return {meter.coverage(), meter.overlap()};
}

}  // namespace floorproof
