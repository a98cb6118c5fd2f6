// SPDX-License-Identifier: Apache-2.0
// Each piece of the way is compared with the obstacles whose boxes it may meet, no farther off than
// the nearest that was found so far: what is far is never looked at. Pieces one after the other
// that overlap the same thing are one stretch. Stretches are one place, to which the plan comes
// several times, where the deepest point of one lies within the robot's length of the other's way:
// a gap as long as a corridor may be entered from either end. What both sides of one gap say is one
// place, too.
// A stretch on which the centre itself gets into a level change crosses it.
#include "run/plan_check/plan_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "env/core/driven_floor.h"
#include "env/geometry/box.h"
#include "env/geometry/convex.h"
#include "run/plan_check/obstacles.h"
#include "run/plan_check/plan_sweep.h"
#include "run/scenario/floors.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

// How far along the way from `a` to `b` it first is within the convex polygon or on its border, as
// a share of the way; none: nowhere.
std::optional<double> FirstWithin(const Polygon& polygon, const Vec2& a, const Vec2& b) {
  double from = 0, to = 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    const double inside_m = Cross(edge, a - polygon[i]), gained_m = Cross(edge, b - a);
    if (std::abs(gained_m) < 1e-12) {
      if (inside_m < -Obstacles::kTouch_m) return {};
      continue;
    }
    const double share = -inside_m / gained_m;
    (gained_m > 0 ? from : to) = gained_m > 0 ? std::max(from, share) : std::min(to, share);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

// A stretch of the path, m.
struct PathInterval {
  double from_m = 0, to_m = 0;
};

// The polygon `part` moves by `length_m` along the unit vector `direction`. Returns the interval on
// which it overlaps `obstacle` by more than a touch; both are convex. Along each edge's normal both
// are intervals, and one of them moves (separating axes).
std::optional<PathInterval> OverlapAlong(const Polygon& part, const Polygon& obstacle,
                                         const Vec2& direction, double length_m) {
  PathInterval stretch{0, length_m};
  const auto clip = [&](const Polygon& edges, const Polygon& other, double side) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec2 edge = (edges[(i + 1) % edges.size()] - edges[i]).normalized();
      const Vec2 out(edge.y(), -edge.x());
      double least = std::numeric_limits<double>::infinity();
      for (const Vec2& p : other) least = std::min(least, out.dot(p - edges[i]));
      // The other one's nearest corner is `least` outside of the edge, and moves by `rate` a metre.
      const double rate = side * out.dot(direction), deep = -least - Obstacles::kTouch_m;
      if (std::abs(rate) < 1e-12) {
        if (deep < 0) stretch.to_m = -1;
        continue;
      }
      if (rate > 0)
        stretch.to_m = std::min(stretch.to_m, deep / rate);
      else
        stretch.from_m = std::max(stretch.from_m, deep / rate);
    }
  };
  clip(part, obstacle, -1);  // the obstacle moves backwards past the part
  clip(obstacle, part, 1);
  if (stretch.from_m > stretch.to_m) return {};
  return stretch;
}

// The length that these stretches have together.
double TotalLength(std::vector<PathInterval> stretches) {
  std::ranges::sort(stretches, {}, &PathInterval::from_m);
  double total_m = 0, end_m = -std::numeric_limits<double>::infinity();
  for (const PathInterval& s : stretches) {
    total_m += std::max(0.0, s.to_m - std::max(s.from_m, end_m));
    end_m = std::max(end_m, s.to_m);
  }
  return total_m;
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
    for (std::size_t k = 0; k < piece.parts_W.size(); ++k)
      Look(piece, InGrid(piece.parts_W[k]), InGrid(piece.begin_W[k]));
  }

  PlanClearance Finish() {
    for (auto& [hazard, stretch] : stretches_) Close(hazard, stretch);
    std::ranges::stable_sort(places_, [](const Place& a, const Place& b) {
      return std::pair(-a.conflict.overlap_m, a.conflict.along_m) <
             std::pair(-b.conflict.overlap_m, b.conflict.along_m);
    });
    for (auto& [hazard, crossing] : crossings_) out_.crossings.push_back(std::move(crossing));
    std::ranges::stable_sort(out_.crossings, {}, &PlanCrossing::along_m);
    JoinSidesOfGaps();
    for (Place& place : places_) {
      place.conflict.times = static_cast<int>(place.passes.size());
      for (const Pass& pass : place.passes) place.conflict.over_m += TotalLength(pass.overlaps);
      out_.conflicts.push_back(std::move(place.conflict));
    }
    return std::move(out_);
  }

 private:
  struct Pass {
    double begin_m = 0, end_m = 0;            // along the plan
    std::vector<PathInterval> overlaps = {};  // of that, where it overlaps
  };
  struct Stretch {
    PlanConflict conflict;
    Pass pass;
    std::vector<Vec2> way_W;  // of the robot's centre, a point each quarter of place_m_ or more
    std::optional<PlanCrossing> crossing = {};  // where the centre gets into a level change
  };
  struct Place {
    int hazard;
    PlanConflict conflict;
    std::vector<Pass> passes;
    std::vector<Vec2> way_W;  // of its first stretch
  };

  Polygon InGrid(Polygon polygon_W) const {
    for (Vec2& p : polygon_W) p = X_GW_ * p;
    return polygon_W;
  }

  // begin_G: the part where the piece begins.
  void Look(const SweptPiece& piece, const Polygon& part_G, const Polygon& begin_G) {
    const auto [low, high] = BoxAround(part_G);
    const double reach_m = std::max(0.0, out_.least_m);
    const Vec2 reach(reach_m, reach_m);
    found_.clear();
    obstacles_.Near(low - reach, high + reach,
                    [&](const Obstacles::Part& obstacle) { found_.push_back(&obstacle); });
    for (const Obstacles::Part* obstacle : found_) {
      const Separation apart = Separate(part_G, obstacle->polygon_G);
      if (apart.distance_m < -Obstacles::kTouch_m) Overlaps(piece, begin_G, *obstacle, apart);
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

  void Overlaps(const SweptPiece& piece, const Polygon& begin_G, const Obstacles::Part& obstacle,
                const Separation& apart) {
    Stretch& stretch = stretches_[obstacle.hazard];
    PlanConflict& conflict = stretch.conflict;
    Pass& pass = stretch.pass;
    if (conflict.overlap_m > 0 && !IsSamePass(pass, piece.along_m)) Close(obstacle.hazard, stretch);
    if (conflict.overlap_m == 0) pass = {piece.along_m, piece.along_m};
    pass.end_m = std::max(pass.end_m, piece.along_m + piece.length_m);
    if (const auto over =
            OverlapAlong(begin_G, obstacle.polygon_G,
                         Pose2{0, 0, X_GW_.yaw_rad}.Rotate(piece.direction_W), piece.length_m))
      pass.overlaps.push_back({piece.along_m + over->from_m, piece.along_m + over->to_m});
    AddToWay(piece.X_WB.p(), stretch);
    AddToWay(piece.X_WB.p() + piece.length_m * piece.direction_W, stretch);
    if (OnTheWay(obstacle.hazard) && !stretch.crossing) Crosses(piece, obstacle, stretch);
    if (-apart.distance_m <= conflict.overlap_m) return;
    conflict.obstacle = obstacles_.Id(obstacle.hazard);
    conflict.overlap_m = -apart.distance_m;
    conflict.width_m = piece.width_m;
    std::tie(conflict.p_W, conflict.along_m) = Where(piece, apart);
    FindGap(piece, apart, obstacle.hazard, conflict);
  }

  static bool IsSamePass(const Pass& pass, double along_m) {
    return along_m <= pass.end_m + Obstacles::kSameStretch_m;
  }

  void AddToWay(const Vec2& p_W, Stretch& stretch) const {
    if (stretch.way_W.empty() || (stretch.way_W.back() - p_W).norm() > place_m_ / 4)
      stretch.way_W.push_back(p_W);
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
  // the robot would fit through if it were moved aside. The place may be an obstacle's very corner,
  // which a ray across passes or not as rounding goes: a centimetre before and behind are tried,
  // too.
  void FindGap(const SweptPiece& piece, const Separation& apart, int hazard,
               PlanConflict& conflict) {
    constexpr double kBeside_m = 0.01;
    conflict.gap_m.reset();
    conflict.other_side.clear();
    if (piece.length_m == 0) return;
    const Vec2 along_G = Pose2{0, 0, X_GW_.yaw_rad}.Rotate(piece.direction_W);
    const Vec2 left_G(-along_G.y(), along_G.x());
    const Vec2 centre_G = X_GW_ * piece.X_WB.p();
    const double place_m = (apart.place - centre_G).dot(along_G);
    for (const double at_m : {place_m, place_m - kBeside_m, place_m + kBeside_m}) {
      const Vec2 from_G = centre_G + at_m * along_G;
      const auto left = obstacles_.Cast(from_G, left_G, piece.width_m);
      const auto right = obstacles_.Cast(from_G, -left_G, piece.width_m);
      if (!left || !right || Within(from_G)) continue;
      const double gap_m = left->along_m + right->along_m;
      if (gap_m >= conflict.gap_m.value_or(piece.width_m)) continue;
      conflict.gap_m = gap_m;
      conflict.other_side = obstacles_.Id(left->hazard == hazard ? right->hazard : left->hazard);
    }
  }

  bool Within(const Vec2& p_G) {
    bool within = false;
    obstacles_.Near(p_G, p_G, [&](const Obstacles::Part& part) {
      within = within || Contains(part.polygon_G, p_G);
    });
    return within;
  }

  // The stretch is over: it is a place of its own, or one that the plan came to before.
  void Close(int hazard, Stretch& open) {
    Stretch stretch = std::exchange(open, {});
    PlanConflict& conflict = stretch.conflict;
    if (conflict.overlap_m == 0) return;
    if (stretch.crossing) {
      const auto [known, is_new] = crossings_.try_emplace(hazard, std::move(*stretch.crossing));
      if (!is_new) ++known->second.times;
      return;
    }
    if (-conflict.overlap_m < out_.least_m)
      Nearest(-conflict.overlap_m, conflict.obstacle, conflict.p_W, conflict.along_m);
    if (Place* known = FindPlace(hazard, stretch)) {
      known->passes.push_back(stretch.pass);
      if (conflict.overlap_m <= known->conflict.overlap_m) return;
      known->conflict = std::move(conflict);
      Index(known->conflict.p_W, static_cast<std::size_t>(known - places_.data()));
      return;
    }
    for (const Vec2& p_W : stretch.way_W) Index(p_W, places_.size());
    Index(conflict.p_W, places_.size());
    places_.push_back({hazard, std::move(conflict), {stretch.pass}, std::move(stretch.way_W)});
  }

  // The first that is the same; nullptr: none.
  Place* FindPlace(int hazard, const Stretch& stretch) {
    std::size_t found = places_.size();
    const auto look = [&](const Vec2& p_W, const auto& is_same) {
      const auto [ix, iy] = CellOf(p_W);
      for (int y = iy - 1; y <= iy + 1; ++y)
        for (int x = ix - 1; x <= ix + 1; ++x) {
          const auto near = places_at_.find({x, y});
          if (near == places_at_.end()) continue;
          for (const std::size_t i : near->second)
            if (i < found && places_[i].hazard == hazard && is_same(places_[i])) found = i;
        }
    };
    look(stretch.conflict.p_W, [&](const Place& place) {
      return IsNear(place.conflict.p_W, stretch.conflict.p_W) ||
             IsNear(place.way_W, stretch.conflict.p_W);
    });
    for (const Vec2& p_W : stretch.way_W)
      look(p_W, [&](const Place& place) { return IsNear(place.conflict.p_W, p_W); });
    return found < places_.size() ? &places_[found] : nullptr;
  }

  std::pair<int, int> CellOf(const Vec2& p_W) const {
    return {static_cast<int>(std::floor(p_W.x() / place_m_)),
            static_cast<int>(std::floor(p_W.y() / place_m_))};
  }
  void Index(const Vec2& p_W, std::size_t place) {
    std::vector<std::size_t>& there = places_at_[CellOf(p_W)];
    if (there.empty() || there.back() != place) there.push_back(place);
  }

  bool IsNear(const Vec2& a_W, const Vec2& b_W) const { return (a_W - b_W).norm() <= place_m_; }
  bool IsNear(const std::vector<Vec2>& way_W, const Vec2& p_W) const {
    return std::ranges::any_of(way_W, [&](const Vec2& at_W) { return IsNear(at_W, p_W); });
  }

  // One gap between two obstacles was met at both: the deeper overlap stays.
  void JoinSidesOfGaps() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      PlanConflict& a = places_[i].conflict;
      if (!a.gap_m || a.other_side == a.obstacle) continue;
      const auto is_other = [&](const Place& place) {
        const PlanConflict& b = place.conflict;
        return b.gap_m && b.obstacle == a.other_side && b.other_side == a.obstacle &&
               (IsNear(places_[i].way_W, b.p_W) || IsNear(place.way_W, a.p_W));
      };
      const auto other = std::find_if(places_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                      places_.end(), is_other);
      if (other == places_.end()) continue;
      places_[i].passes = Joined(std::move(places_[i].passes), other->passes);
      places_.erase(other);
    }
  }

  // Of both sides of a gap: one pass may touch one side or both.
  static std::vector<Pass> Joined(std::vector<Pass> all, const std::vector<Pass>& more) {
    all.insert(all.end(), more.begin(), more.end());
    std::ranges::sort(all, {}, &Pass::begin_m);
    std::vector<Pass> joined;
    for (const Pass& pass : all) {
      if (joined.empty() || !IsSamePass(joined.back(), pass.begin_m)) {
        joined.push_back(pass);
        continue;
      }
      joined.back().end_m = std::max(joined.back().end_m, pass.end_m);
      joined.back().overlaps.insert(joined.back().overlaps.end(), pass.overlaps.begin(),
                                    pass.overlaps.end());
    }
    return joined;
  }

  Pose2 X_GW_;
  Obstacles obstacles_;
  double place_m_;
  const std::vector<Hazard>& hazards_;
  std::vector<bool> on_the_way_;  // of each of them
  std::vector<const Obstacles::Part*> found_;
  std::map<int, Stretch> stretches_;  // by hazard
  std::vector<Place> places_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> places_at_;  // by CellOf
  std::map<int, PlanCrossing> crossings_;                              // by hazard
  PlanClearance out_;
};

}  // namespace

PlanClearance CheckClearance(const World& world, const PlanResult& plan) {
  const HazardMap known = KnownFloor(world);
  Check check(known, world.robot.spec, world.start.p(), plan.path);
  SweepPlan(world.robot, world.start, plan.path,
            [&](const SweptPiece& piece) { check.Look(piece); });
  return check.Finish();
}

}  // namespace floorproof
