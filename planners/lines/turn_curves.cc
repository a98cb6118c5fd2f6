// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/turn_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "planners/lines/dubins.h"

namespace floorproof {
namespace {

constexpr double kStop_m = 10;  // what a dwell that is left out costs
constexpr double kLeftOut = 2;  // cost of a metre that was to be driven and is not
constexpr double kStraight_rad = 0.005;
constexpr double kSame_m = 1e-6;
constexpr double kStep_m = 0.02;                              // between places that are looked at
constexpr double kPiece_rad = 0.15;                           // an arc's waypoints are so far apart
constexpr double kShortenings[] = {0, 0.5, 1, 1.5, 2, 3, 4};  // turn radii
constexpr std::size_t kAhead = 4;              // legs that are looked at from each, as a rule
constexpr std::size_t kBack = 400, kMore = 8;  // see Rescue

// A straight part of the plan.
struct Leg {
  Pose2 from;  // at its beginning, facing along it
  double length_m = 0;
  std::vector<Waypoint> ends;  // of the plan, at its end; the first says how it is driven
  bool dwells = false;         // there
  double least_m = 0;          // clearance along it
  Pose2 At(double s_m) const {
    const Vec2 p = from * Vec2(s_m, 0);
    return {p.x(), p.y(), from.yaw_rad};
  }
};

Waypoint WaypointAt(const Vec2& p_W, double speed_mps) {
  Waypoint w;
  w.p_W = p_W;
  w.speed_mps = speed_mps;
  return w;
}

bool Dwells(const Waypoint& w) { return w.dwell_s > 0 || w.task; }

// The plan's legs; the first stands for the start, faces as the robot does, and has no length.
std::vector<Leg> LegsOf(const Path& path, const TurnRequest& request) {
  std::vector<Leg> legs(1);
  legs[0].from = request.start;
  for (const Waypoint& w : path) {
    const Vec2 last = legs.back().At(legs.back().length_m).p(), way = w.p_W - last;
    Leg& before = legs.back();
    if (way.norm() < kSame_m || before.ends.empty()) {
      before.ends.push_back(w);
      before.dwells |= Dwells(w);
      if (way.norm() < kSame_m) continue;
      before.ends.clear();
      before.dwells = false;
    }
    Leg leg;
    leg.from = {last.x(), last.y(), std::atan2(way.y(), way.x())};
    leg.length_m = way.norm();
    leg.ends = {w};
    leg.dwells = Dwells(w);
    const bool on = legs.size() > 1 && !before.dwells &&
                    before.ends.front().speed_mps == w.speed_mps &&
                    std::abs(WrapAngle(leg.from.yaw_rad - before.from.yaw_rad)) < kStraight_rad;
    if (!on) {
      legs.push_back(std::move(leg));
      continue;
    }
    const Vec2 whole = w.p_W - before.from.p();
    before.from.yaw_rad = std::atan2(whole.y(), whole.x());
    before.length_m = whole.norm();
    before.ends = std::move(leg.ends);
    before.dwells = leg.dwells;
  }
  return legs;
}

class Turns {
 public:
  Turns(const Path& path, const TurnRequest& request)
      : request_(request), legs_(LegsOf(path, request)), states_(legs_.size()) {
    for (Leg& leg : legs_) {
      leg.least_m = std::numeric_limits<double>::infinity();
      for (double s_m = 0; s_m < leg.length_m + kStep_m; s_m += kStep_m)
        leg.least_m =
            std::min(leg.least_m, request.clearance.At(leg.At(std::min(s_m, leg.length_m)).p()));
      behind_m_.push_back(leg.length_m + (behind_m_.empty() ? 0 : behind_m_.back()));
      stops_m_.push_back((leg.dwells ? kStop_m : 0) + (stops_m_.empty() ? 0 : stops_m_.back()));
    }
  }

  TurnedPath Make() {
    states_[0].push_back({});
    std::size_t reached = 0;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if (i > reached) Rescue(i);
      if (states_[i].empty()) continue;
      reached = std::max(reached, i);
      for (std::size_t j = i + 1; j < legs_.size() && j <= i + kAhead; ++j)
        if (Join(i, j)) reached = std::max(reached, j);
    }
    return Collect();
  }

 private:
  // A way to have come to a leg: from where on it is driven, and how it was come to.
  struct State {
    double begin_m = 0, cost = 0;
    std::size_t leg = 0, state = 0;  // that came before, and where that ended
    double end_m = 0;
    DubinsCurve curve;
  };

  // Shortenings of a leg that are tried.
  std::vector<double> Shortenings(const Leg& leg, double fillet_m) const {
    std::vector<double> out;
    for (const double radii : kShortenings)
      if (radii * request_.turn_radius_m <= leg.length_m)
        out.push_back(radii * request_.turn_radius_m);
    // Into a dead end no farther than where there is room to turn.
    for (const double share : {0.25, 0.5, 0.75})
      if (share * leg.length_m > out.back()) out.push_back(share * leg.length_m);
    if (fillet_m <= leg.length_m) out.push_back(fillet_m);
    return out;
  }

  // Nothing led as far as to this leg: what lies before it is a dead end. It is joined to the legs
  // from which that was entered, the nearest and some more.
  void Rescue(std::size_t leg) {
    std::size_t joined = 0;
    for (std::size_t back = 1; back <= std::min(leg, kBack) && joined < kMore; ++back)
      joined += !states_[leg - back].empty() && (Join(leg - back, leg) || joined > 0);
  }

  bool Join(std::size_t i, std::size_t j) {
    const Leg &a = legs_[i], &b = legs_[j];
    const double half = 0.5 * std::abs(WrapAngle(b.from.yaw_rad - a.from.yaw_rad));
    const double fillet_m =
        half < 1.4 ? request_.turn_radius_m * std::tan(half) : std::numeric_limits<double>::max();
    double least_m = request_.clear_radius_m + request_.margin_m;
    for (std::size_t k = i; k <= j; ++k) least_m = std::min(least_m, legs_[k].least_m);
    const double skipped_m = behind_m_[j - 1] - behind_m_[i];
    const double stops_m = stops_m_[j - 1] - stops_m_[i];
    const std::vector<double> ends = a.dwells ? std::vector<double>{0} : Shortenings(a, fillet_m);
    bool any = false;
    for (const double begin_m : Shortenings(b, fillet_m))
      for (const double cut_m : ends) {
        const auto from = BestUntil(i, a.length_m - cut_m);
        if (!from) continue;
        const State& before = states_[i][*from];
        const Pose2 leaves = a.At(a.length_m - cut_m), enters = b.At(begin_m);
        const double cost = before.cost + a.length_m - cut_m - before.begin_m +
                            kLeftOut * (cut_m + skipped_m + begin_m) + stops_m;
        // No curve is shorter than the straight.
        if (IsKept(j, begin_m, cost + (enters.p() - leaves.p()).norm())) continue;
        const auto curve = Clear(leaves, enters, least_m);
        if (!curve) continue;
        Keep(j, {begin_m, cost + curve->Length(), i, *from, a.length_m - cut_m, *curve});
        any = true;
      }
    return any;
  }

  // The cheapest way to have come to the leg that begins it by then.
  std::optional<std::size_t> BestUntil(std::size_t leg, double until_m) const {
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < states_[leg].size(); ++s) {
      const State& state = states_[leg][s];
      const double cost = state.cost - state.begin_m;
      if (state.begin_m > until_m + kSame_m || cost >= least) continue;
      best = s;
      least = cost;
    }
    return best;
  }

  // Whether a way to have come to the leg there is kept that costs no more than this.
  bool IsKept(std::size_t leg, double begin_m, double cost) const {
    return std::ranges::any_of(states_[leg], [&](const State& other) {
      return std::abs(other.begin_m - begin_m) < kSame_m && other.cost <= cost;
    });
  }

  // One a beginning: the cheapest.
  void Keep(std::size_t leg, const State& state) {
    for (State& other : states_[leg])
      if (std::abs(other.begin_m - state.begin_m) < kSame_m) {
        if (state.cost < other.cost) other = state;
        return;
      }
    states_[leg].push_back(state);
  }

  std::optional<DubinsCurve> Clear(const Pose2& from, const Pose2& to, double least_m) const {
    const DubinsCurves found = CurvesBetween(from, to, request_.turn_radius_m);
    for (int k = 0; k < found.n; ++k) {
      const DubinsCurve& curve = found.curves[static_cast<std::size_t>(k)];
      const double length_m = curve.Length();
      bool clear = true;
      // From cell to cell clearance falls by their distance at most: what is left of it need not be
      // looked at.
      const double cells_m = std::numbers::sqrt2 * request_.clearance.frame.cell_m;
      for (double s_m = 0; clear && s_m < length_m;) {
        const double left_m = request_.clearance.At(curve.At(s_m).p()) - least_m;
        clear = left_m >= 0;
        s_m += std::max(kStep_m, left_m - cells_m);
      }
      if (clear) return curve;
    }
    return {};
  }

  // The cheapest way to drive, what it leaves out behind its end counted, too.
  TurnedPath Collect() const {
    std::size_t leg = 0, state = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < legs_.size(); ++i)
      for (std::size_t s = 0; s < states_[i].size(); ++s) {
        const double cost = states_[i][s].cost + legs_[i].length_m - states_[i][s].begin_m +
                            kLeftOut * (behind_m_.back() - behind_m_[i]) + stops_m_.back() -
                            stops_m_[i];
        if (cost >= least) continue;
        least = cost;
        leg = i;
        state = s;
      }
    TurnedPath out;
    std::vector<const State*> kept;
    std::vector<std::size_t> at;
    while (leg > 0) {
      kept.push_back(&states_[leg][state]);
      at.push_back(leg);
      state = kept.back()->state;
      leg = kept.back()->leg;
    }
    for (std::size_t i = 1, k = at.size(); i < legs_.size(); ++i) {
      const bool lane = legs_[i].length_m > request_.lane_m;
      out.lanes += lane;
      if (k > 0 && at[k - 1] == i) {
        --k;
        continue;
      }
      out.stops_left_out += legs_[i].dwells;
      out.left_out += lane;
      if (lane) out.left_out_m += legs_[i].length_m;
    }
    if (at.empty()) return out;
    out.path = legs_[0].ends;
    if (out.path.empty()) out.path.push_back(WaypointAt(request_.start.p(), 0));
    for (std::size_t k = at.size(); k-- > 0;) {
      const Leg& driven = legs_[at[k]];
      Add(kept[k]->curve, driven.ends.front().speed_mps, out.path);
      const double end_m = k > 0 ? kept[k - 1]->end_m : driven.length_m;
      if (end_m > driven.length_m - kSame_m) {
        for (const Waypoint& w : driven.ends) out.path.push_back(w);
      } else if (end_m > kept[k]->begin_m + kSame_m) {
        out.path.push_back(WaypointAt(driven.At(end_m).p(), driven.ends.front().speed_mps));
      }
    }
    return out;
  }

  // The waypoints of a curve behind its beginning.
  static void Add(const DubinsCurve& curve, double speed_mps, Path& path) {
    double before_m = 0;
    for (std::size_t k = 0; k < curve.turns.size(); ++k) {
      const double length_m = curve.length_m[k];
      if (length_m > kSame_m) {
        const double turn_rad = curve.turns[k] == 0 ? 0 : length_m / curve.radius_m;
        const int n = std::max(1, static_cast<int>(std::ceil(turn_rad / kPiece_rad)));
        for (int i = 1; i <= n; ++i) {
          const Vec2 p_W = curve.At(before_m + length_m * i / n).p();
          if ((p_W - path.back().p_W).norm() > kSame_m) path.push_back(WaypointAt(p_W, speed_mps));
        }
      }
      before_m += length_m;
    }
  }

  const TurnRequest& request_;
  std::vector<Leg> legs_;
  // Up to the end of each leg: their length, and what their dwells cost if they are left out.
  std::vector<double> behind_m_, stops_m_;
  std::vector<std::vector<State>> states_;  // of each leg
};

}  // namespace

TurnedPath WithTurns(const Path& path, const TurnRequest& request) {
  return Turns(path, request).Make();
}

}  // namespace floorproof
