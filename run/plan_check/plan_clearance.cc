// SPDX-License-Identifier: Apache-2.0
// Each piece of the way is compared with the obstacles whose boxes it may meet, no farther off than
// the nearest that was found so far: what is far is never looked at. Pieces one after the other
// that overlap the same thing are one stretch, and stretches whose deepest places lie within the
// robot's length of each other one place, to which the plan comes several times. A stretch on which
// the centre itself gets into a level change crosses it.
#include "run/plan_check/plan_clearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "env/core/driven_floor.h"
#include "env/geometry/convex.h"
#include "run/plan_check/obstacles.h"
#include "run/plan_check/plan_sweep.h"
#include "run/scenario/floors.h"

namespace floorproof {
namespace {

constexpr double kTouch_m = 0.001;  // as a start that stands beside a wall (env/core/standing.h)
constexpr double kSameStretch_m = 0.3;

// How far along the way from `a` to `b` it first is within the convex polygon or on its border, as
// a share of the way; none: nowhere.
std::optional<double> FirstWithin(const Polygon& polygon, const Vec2& a, const Vec2& b) {
  double from = 0, to = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    const double inside_m = Cross(edge, a - polygon[i]), gained_m = Cross(edge, b - a);
    if (std::abs(gained_m) < 1e-12) {
      if (inside_m < -kTouch_m) return {};
      continue;
    }
    const double share = -inside_m / gained_m;
    (gained_m > 0 ? from : to) = gained_m > 0 ? std::max(from, share) : std::min(to, share);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

class Check {
 public:
  Check(const HazardMap& known, const RobotSpec& robot, const Vec2& start_W, const Path& path)
      : X_GW_(known.frame.X_WG.Inverse()),
        obstacles_(known, robot, start_W),
        place_m_(std::max(0.1, 2 * robot.circumscribed_radius_m)),
        hazards_(known.hazards),
        on_the_way_(known.hazards.size()) {
    for (const std::size_t i : LevelChangesOnTheWay(known, path)) on_the_way_[i] = true;
  }

  void Look(const SweptPiece& piece) {
    for (const Polygon& part_W : piece.parts_W) Look(piece, part_W);
  }

  PlanClearance Finish() {
    for (auto& [hazard, stretch] : stretches_) Close(hazard, stretch);
    for (auto& [place, conflict] : places_) out_.conflicts.push_back(std::move(conflict));
    std::ranges::stable_sort(out_.conflicts, [](const PlanConflict& a, const PlanConflict& b) {
      return std::pair(-a.overlap_m, a.along_m) < std::pair(-b.overlap_m, b.along_m);
    });
    for (auto& [hazard, crossing] : crossings_) out_.crossings.push_back(std::move(crossing));
    std::ranges::stable_sort(out_.crossings, {}, &PlanCrossing::along_m);
    return std::move(out_);
  }

 private:
  struct Stretch {
    PlanConflict conflict;
    double end_m = 0;
    std::optional<PlanCrossing> crossing = {};  // where the centre gets into a level change
  };

  void Look(const SweptPiece& piece, const Polygon& part_W) {
    Polygon part_G = part_W;
    for (Vec2& p : part_G) p = X_GW_ * p;
    Vec2 low = part_G.front(), high = low;
    for (const Vec2& p : part_G) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double reach_m = std::max(0.0, out_.least_m);
    const Vec2 reach(reach_m, reach_m);
    found_.clear();
    obstacles_.Near(low - reach, high + reach,
                    [&](const Obstacles::Part& obstacle) { found_.push_back(&obstacle); });
    for (const Obstacles::Part* obstacle : found_) {
      const Separation apart = Separate(part_G, obstacle->polygon_G);
      if (apart.distance_m < -kTouch_m) Overlaps(piece, *obstacle, apart);
      if (OnTheWay(obstacle->hazard) || apart.distance_m >= out_.least_m) continue;
      const auto [p_W, along_m] = Where(piece, apart);
      Nearest(apart.distance_m, obstacles_.Id(obstacle->hazard), p_W, along_m);
    }
  }

  void Nearest(double least_m, const std::string& obstacle, const Vec2& p_W, double along_m) {
    out_.least_m = least_m;
    out_.obstacle = obstacle;
    out_.p_W = p_W;
    out_.along_m = along_m;
  }

  bool OnTheWay(int hazard) const {
    return hazard != Obstacles::kWall && on_the_way_[static_cast<std::size_t>(hazard)];
  }

  // Where on the piece the robot's centre is beside that place.
  std::pair<Vec2, double> Where(const SweptPiece& piece, const Separation& apart) const {
    const Vec2 place_W = X_GW_.Inverse() * apart.place;
    const double s_m =
        std::clamp((place_W - piece.X_WB.p()).dot(piece.direction_W), 0.0, piece.length_m);
    return {piece.X_WB.p() + s_m * piece.direction_W, piece.along_m + s_m};
  }

  void Overlaps(const SweptPiece& piece, const Obstacles::Part& obstacle, const Separation& apart) {
    Stretch& stretch = stretches_[obstacle.hazard];
    if (stretch.conflict.overlap_m > 0 && piece.along_m > stretch.end_m + kSameStretch_m)
      Close(obstacle.hazard, stretch);
    PlanConflict& conflict = stretch.conflict;
    const double end_m = piece.along_m + piece.length_m;
    const double before_m = std::max(stretch.end_m, piece.along_m);
    conflict.over_m += std::max(0.0, end_m - (conflict.overlap_m > 0 ? before_m : piece.along_m));
    stretch.end_m = std::max(stretch.end_m, end_m);
    if (OnTheWay(obstacle.hazard) && !stretch.crossing) Crosses(piece, obstacle, stretch);
    if (-apart.distance_m <= conflict.overlap_m) return;
    conflict.obstacle = obstacles_.Id(obstacle.hazard);
    conflict.overlap_m = -apart.distance_m;
    conflict.width_m = piece.width_m;
    std::tie(conflict.p_W, conflict.along_m) = Where(piece, apart);
    conflict.gap_m = Gap(piece, apart);
  }

  void Crosses(const SweptPiece& piece, const Obstacles::Part& obstacle, Stretch& stretch) {
    const Vec2 from_W = piece.X_WB.p(), way_W = piece.length_m * piece.direction_W;
    const auto share =
        FirstWithin(obstacle.polygon_G, X_GW_ * from_W, X_GW_ * Vec2(from_W + way_W));
    if (!share) return;
    const Hazard& hazard = hazards_[static_cast<std::size_t>(obstacle.hazard)];
    stretch.crossing = {hazard.id, hazard.height_m, from_W + *share * way_W,
                        piece.along_m + *share * piece.length_m};
  }

  // Across the way beside that place; none where an obstacle stands in the middle of the way, or
  // the robot would fit through if it were moved aside.
  std::optional<double> Gap(const SweptPiece& piece, const Separation& apart) {
    if (piece.length_m == 0) return {};
    const Vec2 along_G = Pose2{0, 0, X_GW_.yaw_rad}.Rotate(piece.direction_W);
    const Vec2 centre_G = X_GW_ * piece.X_WB.p();
    const Vec2 from_G = centre_G + (apart.place - centre_G).dot(along_G) * along_G;
    const Vec2 left_G(-along_G.y(), along_G.x());
    const auto left = obstacles_.Cast(from_G, left_G, piece.width_m);
    const auto right = obstacles_.Cast(from_G, -left_G, piece.width_m);
    if (!left || !right || *left + *right >= piece.width_m) return {};
    if (Within(from_G)) return {};
    return *left + *right;
  }

  bool Within(const Vec2& p_G) {
    bool within = false;
    obstacles_.Near(p_G, p_G, [&](const Obstacles::Part& part) {
      within = within || Contains(part.polygon_G, p_G);
    });
    return within;
  }

  // The stretch is over: it is a place of its own, or one that the plan came to before.
  void Close(int hazard, Stretch& stretch) {
    auto [conflict, end_m, crossing] = std::exchange(stretch, {});
    if (conflict.overlap_m == 0) return;
    if (crossing) {
      const auto [known, is_new] = crossings_.try_emplace(hazard, std::move(*crossing));
      if (!is_new) ++known->second.times;
      return;
    }
    if (-conflict.overlap_m < out_.least_m)
      Nearest(-conflict.overlap_m, conflict.obstacle, conflict.p_W, conflict.along_m);
    const auto cell = [this](double along_m) {
      return static_cast<int>(std::floor(along_m / place_m_));
    };
    const int ix = cell(conflict.p_W.x()), iy = cell(conflict.p_W.y());
    for (int y = iy - 1; y <= iy + 1; ++y)
      for (int x = ix - 1; x <= ix + 1; ++x) {
        const auto found = places_.find({hazard, x, y});
        if (found == places_.end()) continue;
        PlanConflict& known = found->second;
        const bool same_cell = x == ix && y == iy;
        if (!same_cell && (known.p_W - conflict.p_W).norm() > place_m_) continue;
        const int times = known.times + conflict.times;
        const double over_m = known.over_m + conflict.over_m;
        if (conflict.overlap_m > known.overlap_m) known = std::move(conflict);
        known.times = times;
        known.over_m = over_m;
        return;
      }
    places_.emplace(std::tuple(hazard, ix, iy), std::move(conflict));
  }

  Pose2 X_GW_;
  Obstacles obstacles_;
  double place_m_;
  const std::vector<Hazard>& hazards_;
  std::vector<bool> on_the_way_;  // of each of them
  std::vector<const Obstacles::Part*> found_;
  std::map<int, Stretch> stretches_;  // by hazard
  std::map<std::tuple<int, int, int>, PlanConflict> places_;
  std::map<int, PlanCrossing> crossings_;  // by hazard
  PlanClearance out_;
};

}  // namespace

PlanClearance CheckClearance(const Scenario& s, const PlanResult& plan) {
  const HazardMap known = KnownFloor(s);
  Check check(known, s.robot.spec, s.start.p(), plan.path);
  SweepPlan(s.robot, s.start, plan.path, [&](const SweptPiece& piece) { check.Look(piece); });
  return check.Finish();
}

}  // namespace floorproof
