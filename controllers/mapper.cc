// SPDX-License-Identifier: Apache-2.0
#include "controllers/mapper.h"

#include <algorithm>
#include <cmath>

#include "env/core/coverage.h"
#include "env/geometry/grid_line.h"

namespace floorproof {
namespace {

constexpr double kNear_m = 3;              // farther off a lidar hardly tells cells apart
constexpr double kAskew_rad = kPi / 36;    // as lidars see glass by default (glass_angle_deg)
constexpr std::uint16_t kMostBeams = 250;  // of a mean: it may still move

// Between two lines: glass is seen from both sides.
double BetweenLines(double a_rad, double b_rad) { return std::remainder(a_rad - b_rad, kPi); }

}  // namespace

void Mapper::Visit(ParamVisitor& v) {
  v("cell_m", cell_m_, Between(0.01, 1), "largest cell of the map (m)");
  v("hit", hit_, Positive(), "log odds that a beam adds where it ends");
  v("miss", miss_, Positive(), "log odds that it takes where it passes");
  v("most", most_, AtLeast(1), "log odds that no cell exceeds, either way");
  v("range_m", range_m_, Positive(), "of a beam only so much is used (m)");
  v("mark_m", mark_m_, Between(0.01, 1), "width of what a bump or a drop marks (m)");
  v("glass", glass_,
    "keep what was seen from near by though beams pass it askew, as they do glass");
}

double Mapper::CellsOn(const GridFrame& site) const {
  const GridFrame frame = FineFrame(site, cell_m_);
  return 1.0 * frame.width * frame.height;
}

void Mapper::Start(const GridFrame& site, const RobotSpec& robot, bool tells) {
  robot_ = &robot;
  map_ = KnownMap(FineFrame(site, cell_m_));
  if (tells) map_.changed.emplace().reserve(4096);
  last_end_ = Grid<std::uint32_t>(map_.frame.width, map_.frame.height);
  seen_ = {};
  if (glass_) seen_ = Grid<Seen>(map_.frame.width, map_.frame.height);
  scans_ = 0;
  ends_.clear();
  ends_.reserve(4096);
  map_.marks.reserve(64);
  X_GW_ = map_.frame.X_WG.Inverse();
  stood_W_ = Vec2::Constant(1e9);
  pressed_ = false;
  dropped_ = {};
}

// `to_G` is where it ended, in cells, and `yaw_rad` the beam's direction on the map.
void Mapper::AddBeam(const Vec2& from_G, const Vec2& to_G, double yaw_rad) {
  VisitCellsBefore(from_G, to_G, [&](Cell at) {
    if (last_end_.Inside(at) && last_end_(at) != scans_ && !(glass_ && SaysNothing(at, yaw_rad)))
      Add(at.ix, at.iy, -miss_);
    return true;
  });
}

void Mapper::See(Cell c, double yaw_rad) {
  Seen& seen = seen_(c);
  if (map_.log_odds(c) <= miss_ - most_) seen.beams = 0;  // it has been free for long
  if (seen.beams < kMostBeams) ++seen.beams;
  seen.yaw_rad += static_cast<float>(BetweenLines(yaw_rad, seen.yaw_rad) / seen.beams);
}

// A beam that passes what was seen, but not along the line on which it was seen.
bool Mapper::SaysNothing(Cell c, double yaw_rad) const {
  return map_.log_odds(c) >= KnownMap::kSure && seen_(c).beams > 0 &&
         std::abs(BetweenLines(yaw_rad, seen_(c).yaw_rad)) > kAskew_rad;
}

// A cell in which a beam of this scan ends does not count as passed by other beams of the scan,
// which only graze it.
void Mapper::AddScan(const LidarScan& scan, const Pose2& X_WB) {
  const double cell_m = map_.frame.cell_m;
  const Pose2 X_GL = X_GW_ * X_WB * scan.X_BL;
  const Vec2 from_G = X_GL.p() / cell_m;
  ++scans_;
  ends_.clear();
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double range_m = scan.range_m[i];
    if (!(range_m <= range_m_)) continue;
    const double a = X_GL.yaw_rad + scan.angle_rad[i];
    // Half a cell on: a wall's face lies on the border of its first cell.
    const Vec2 in_G = from_G + (range_m / cell_m + 0.5) * Vec2(std::cos(a), std::sin(a));
    const Cell cell{static_cast<int>(std::floor(in_G.x())), static_cast<int>(std::floor(in_G.y()))};
    if (!last_end_.Inside(cell) || last_end_(cell) == scans_) continue;
    last_end_(cell) = scans_;
    ends_.push_back(cell);
    if (glass_ && range_m <= kNear_m) See(cell, a);
  }
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (!std::isfinite(scan.range_m[i])) continue;
    const double a = X_GL.yaw_rad + scan.angle_rad[i];
    const Vec2 way_G =
        std::min(scan.range_m[i], range_m_) / cell_m * Vec2(std::cos(a), std::sin(a));
    AddBeam(from_G, from_G + way_G, a);
  }
  for (const Cell& cell : ends_) Add(cell.ix, cell.iy, hit_);
}

void Mapper::Update(const Observation& sensed, const Estimate& estimate) {
  const Pose2& X_WB = estimate.X_WB;
  if (sensed.scan.fresh) AddScan(sensed.scan, X_WB);

  const double cell_m = map_.frame.cell_m;
  if ((X_WB.p() - stood_W_).norm() > cell_m / 2) {
    stood_W_ = X_WB.p();
    const Vec2 p_G = X_GW_ * X_WB.p() / cell_m;
    const double r = robot_->inscribed_radius_m / cell_m - 1;
    for (int iy = static_cast<int>(p_G.y() - r); iy <= p_G.y() + r; ++iy)
      for (int ix = static_cast<int>(p_G.x() - r); ix <= p_G.x() + r; ++ix)
        if ((Vec2(ix + 0.5, iy + 0.5) - p_G).norm() <= r) Add(ix, iy, -hit_);
  }

  // What stays pressed, or stays without floor, says nothing new.
  if (sensed.bump.pressed && !pressed_) {
    const double a = sensed.bump.bearing_rad;
    const double r_m = EdgeAlong(robot_->clear, a) + mark_m_ / 2;
    Mark(FloorMark::Kind::kBump, X_WB * Vec2(r_m * std::cos(a), r_m * std::sin(a)));
  }
  pressed_ = sensed.bump.pressed;
  const CliffRing& cliffs = sensed.cliffs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(cliffs.n); ++i) {
    if (cliffs.drop[i] && !dropped_[i]) {
      const Vec2& p_B = cliffs.p_B[i];  // zero where it was set in as far as the middle
      Mark(FloorMark::Kind::kDrop, X_WB * Vec2(p_B + mark_m_ / 2 * p_B.normalized()));
    }
    dropped_[i] = cliffs.drop[i];
  }
}

}  // namespace floorproof
