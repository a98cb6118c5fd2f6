// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/leg_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "env/geometry/interpolate.h"
#include "planners/lines/turn_curves.h"

namespace floorproof {
namespace {

constexpr double kStop_m = 10;  // what a dwell that is left out costs
constexpr double kLeftOut = 2;  // cost of a metre that was to be driven and is not
constexpr double kSame_m = 1e-6;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kStep_m = 0.02;                              // between places that are looked at
constexpr double kShortenings[] = {0, 0.5, 1, 1.5, 2, 3, 4};  // turn radii
constexpr std::size_t kAhead = 4;  // legs that are looked at from each, as a rule
constexpr std::size_t kBack = 400, kMore = 8, kTriesALeg = 4;  // see Rescue

// Clearance between cell centres, for who asks at many places.
class Clearance {
 public:
  explicit Clearance(const ClearanceField& field)
      : field_(field), X_GW_(field.frame.X_WG.Inverse()), turned_(X_GW_.Rotate({1, 0})) {}
  // 0 beyond the grid.
  double At(const Vec2& p_W) const {
    const Vec2 p_G(X_GW_.x_m + turned_.x() * p_W.x() - turned_.y() * p_W.y(),
                   X_GW_.y_m + turned_.y() * p_W.x() + turned_.x() * p_W.y());
    return Interpolate(field_.distance_m, p_G / cell_m(), 0);
  }
  double cell_m() const { return field_.frame.cell_m; }

 private:
  const ClearanceField& field_;
  Pose2 X_GW_;
  Vec2 turned_;  // the world's x axis in the grid's frame, unit
};

class Choice {
 public:
  Choice(const std::vector<Leg>& legs, const TurnRequest& request)
      : request_(request), clearance_(request.clearance), legs_(legs), states_(legs_.size()) {
    for (const Leg& leg : legs_) {
      behind_m_.push_back(leg.length_m + (behind_m_.empty() ? 0 : behind_m_.back()));
      stops_m_.push_back((leg.dwells ? kStop_m : 0) + (stops_m_.empty() ? 0 : stops_m_.back()));
    }
  }

  std::vector<JoinedLeg> Make() {
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
  // from which that was entered, the nearest and some more. Of those that a way leads to kBack are
  // tried; kMore where that was in vain so often that there were more than kTriesALeg for each leg.
  void Rescue(std::size_t leg) {
    const bool far = tries_ <= kTriesALeg * leg + kBack;
    std::size_t joined = 0, tried = 0;
    for (std::size_t i = leg; i-- > 0 && joined < kMore && tried < (far ? kBack : kMore);) {
      if (states_[i].empty()) continue;
      ++tried;
      joined += Join(i, leg) || joined > 0;
    }
    tries_ += tried;
  }

  bool Join(std::size_t i, std::size_t j) {
    const Leg &a = legs_[i], &b = legs_[j];
    const double half = 0.5 * std::abs(WrapAngle(b.from.yaw_rad - a.from.yaw_rad));
    const double fillet_m =
        half < 1.4 ? request_.turn_radius_m * std::tan(half) : std::numeric_limits<double>::max();
    const double skipped_m = behind_m_[j - 1] - behind_m_[i];
    const double stops_m = stops_m_[j - 1] - stops_m_[i];
    const std::vector<Exit> exits = Exits(i, fillet_m);
    const double wanted_m = request_.clear_radius_m + request_.margin_m;
    bool any = false;
    for (const double begin_m : Shortenings(b, fillet_m)) {
      const Pose2 enters = b.At(begin_m);
      const double enters_least_m =
          std::min(wanted_m, i > 0 ? LeastAlong(j, begin_m, -1) : clearance_.At(enters.p()));
      for (const Exit& exit : exits) {
        const double cost = exit.cost + kLeftOut * (exit.cut_m + skipped_m + begin_m) + stops_m;
        // No curve is shorter than the straight.
        const double most_m = KeptCost(j, begin_m) - cost;
        if ((enters.p() - exit.leaves.p()).norm() >= most_m) continue;
        const auto curve =
            Clear(exit.leaves, enters, std::min(enters_least_m, exit.least_m), most_m);
        if (!curve) continue;
        Keep(j, {begin_m, cost + curve->Length(), i, exit.state, a.length_m - exit.cut_m, *curve});
        any = true;
      }
    }
    return any;
  }

  // Where a leg may be left, by its cheapest state.
  struct Exit {
    double cut_m = 0, cost = 0;
    std::size_t state = 0;
    Pose2 leaves;
    double least_m = 0;  // clearance that the leg allows there
  };
  std::vector<Exit> Exits(std::size_t i, double fillet_m) const {
    const Leg& leg = legs_[i];
    std::vector<Exit> out;
    for (const double cut_m : leg.dwells ? std::vector<double>{0} : Shortenings(leg, fillet_m)) {
      const double s_m = leg.length_m - cut_m;
      const auto state = BestUntil(i, s_m);
      if (!state) continue;
      const State& before = states_[i][*state];
      out.push_back({cut_m, before.cost + leg.length_m - cut_m - before.begin_m, *state,
                     leg.At(s_m), i > 0 ? LeastAlong(i, s_m, 1) : kUnlimited});
    }
    return out;
  }

  // Clearance of the plan from there on, as far as an arc reaches ahead, or (side -1) from there
  // back: of the leg, and of those next to it where it is shorter.
  double LeastAlong(std::size_t leg, double s_m, int side) const {
    double least_m = clearance_.At(legs_[leg].At(s_m).p());
    for (double left_m = request_.turn_radius_m; left_m > 0;) {
      const double way_m = std::min(left_m, side > 0 ? legs_[leg].length_m - s_m : s_m);
      const int n = static_cast<int>(std::ceil(way_m / kStep_m));
      for (int k = 1; k <= n; ++k)
        least_m = std::min(least_m, clearance_.At(legs_[leg].At(s_m + side * way_m * k / n).p()));
      left_m -= way_m;
      if (side > 0 ? leg + 1 == legs_.size() : leg == 1) break;
      leg = side > 0 ? leg + 1 : leg - 1;
      s_m = side > 0 ? 0 : legs_[leg].length_m;
    }
    return least_m;
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

  // What the way to have come to the leg there costs that is kept.
  double KeptCost(std::size_t leg, double begin_m) const {
    for (const State& state : states_[leg])
      if (std::abs(state.begin_m - begin_m) < kSame_m) return state.cost;
    return kUnlimited;
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

  // The shortest, of less than most_m, that is as clear as `least_m`, or, until it has become so,
  // as where it begins.
  std::optional<DubinsCurve> Clear(const Pose2& from, const Pose2& to, double least_m,
                                   double most_m) const {
    const double first_m = std::min(least_m, clearance_.At(from.p()));
    // From cell to cell clearance changes by their distance at most: what is left of it need not be
    // looked at.
    const double cells_m = std::numbers::sqrt2 * clearance_.cell_m();
    const DubinsCurves found = CurvesBetween(from, to, request_.turn_radius_m);
    for (int k = 0; k < found.n; ++k) {
      const DubinsCurve& curve = found.curves[static_cast<std::size_t>(k)];
      const double length_m = curve.Length();
      if (length_m >= most_m) break;
      const CurvePlaces places(curve);
      bool clear = true;
      double needs_m = first_m;
      for (double s_m = 0; clear && s_m < length_m;) {
        const double here_m = clearance_.At(places.At(s_m));
        clear = here_m >= needs_m;
        if (here_m >= least_m) needs_m = least_m;
        s_m += std::max(kStep_m, std::abs(here_m - least_m) - cells_m);
      }
      if (clear) return curve;
    }
    return {};
  }

  // The cheapest way to drive, what it leaves out behind its end counted, too.
  std::vector<JoinedLeg> Collect() const {
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
    std::vector<JoinedLeg> out;
    for (double end_m = legs_[leg].length_m; leg > 0;) {
      const State& driven = states_[leg][state];
      out.push_back({leg, driven.curve, driven.begin_m, end_m});
      end_m = driven.end_m;
      leg = driven.leg;
      state = driven.state;
    }
    std::ranges::reverse(out);
    return out;
  }

  const TurnRequest& request_;
  const Clearance clearance_;
  const std::vector<Leg>& legs_;
  // Up to the end of each leg: their length, and what their dwells cost if they are left out.
  std::vector<double> behind_m_, stops_m_;
  std::vector<std::vector<State>> states_;  // of each leg
  std::size_t tries_ = 0;                   // of Rescue
};

}  // namespace

std::vector<JoinedLeg> ChooseLegs(const std::vector<Leg>& legs, const TurnRequest& request) {
  return Choice(legs, request).Make();
}

}  // namespace floorproof
