// SPDX-License-Identifier: Apache-2.0
// F2, stuck: a move is commanded, yet the robot does not get on within T.
//
// A sliding window covers the last T seconds in which a move was commanded; standing still on
// purpose stops its clock. To get on is to gain way along the plan (Sample::progress_m): the
// largest gain between two moments of the window, from the earlier to the later. Swaying, circling,
// and pushing forward to fall back again gain nothing in the end. This follows Nav2's pose progress
// checker, but r scales with what was commanded: r = min(displacement_m, fraction * way commanded),
// and a slower command than least_speed_mps lets the clock run slower in proportion, so that a
// window always holds a way that is worth judging. A robot that goes back from what it met, as it
// is told, is about something else: that stops the clock, too, and being held there does not. A
// robot that goes elsewhere is not stuck, it veers off: it is spared where it gets away by half of
// the way commanded.
//
// While the plan asks for a turn on the spot, or for folding, that is what is judged, in the same
// way: a = min(turn_rad, fraction * angle commanded), turned the way it was told. A window is about
// whichever took most of it. One place of a plan asks for a turn or two; a robot that is told to
// turn for kMostTurnsRad without getting further than ever before is turned away again and again,
// and does not get on by turning. States are kept ten times a second, in a ring made in Start().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "env/failures/detector.h"
#include "env/failures/evidence.h"

namespace floorproof {
namespace {

constexpr double kGravity = 9.81;
constexpr double kSampleS = 0.1;       // between kept states; 1 % of the default window
constexpr double kTimeSlackS = 1e-9;   // sums of time steps are not exact
constexpr double kNoSpeedMps = 0.001;  // no plan is slower
constexpr double kAwayShare = 0.5;     // of the way commanded: so far away, it is not held
constexpr double kFurtherM = 0.01;     // beyond where it was ever: tyres give by millimetres
constexpr double kMostTurnsRad = 4 * kPi;
constexpr double kStillM = 0.02;  // a robot that stays within this stands still

class Stuck final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("window_s", window_s_, Between(0.1, 3600),
      "T: time with a move commanded that is looked back upon");
    v("displacement_m", displacement_m_, Positive(),
      "r: way gained along the plan that counts as progress, at most");
    v("commanded_fraction", fraction_, Between(0, 1),
      "share of the way, or of the turn, commanded that counts as progress where it is less than "
      "that");
    v("turn_rad", turn_rad_, Positive(),
      "a: turn that counts as progress where the plan asks for one, at most");
    v("least_speed_mps", least_speed_mps_, Positive(),
      "a slower command lets T last longer, in proportion");
    v("least_yaw_rate_radps", least_yaw_rate_radps_, Positive(),
      "a slower turn lets T last longer, in proportion");
    v("belly_share", belly_share_, Between(0, 1),
      "kind high_centred: mean share of the weight on the belly, at least");
  }

  FailureMode mode() const override { return FailureMode::kStuck; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    weight_n_ = context.robot.mass_kg * kGravity;
    timestep_s_ = context.timestep_s;
    const auto intervals =
        static_cast<std::size_t>(std::max(10.0, std::ceil(window_s_ / kSampleS)));
    period_s_ = window_s_ / static_cast<double>(intervals);
    ring_.assign(intervals + 1, {});
    count_ = 0;
    newest_ = intervals;
    now_ = {};
    ticks_ = 0;
    further_than_m_ = -std::numeric_limits<double>::infinity();
    turned_here_rad_ = 0;
    started_ = reported_ = false;
    hazards_.Start(context);
    belly_hazard_ = -1;
    StartMargin(displacement_m_);
  }

  bool Update(const Sample& sample) override {
    hazards_.Update(sample);
    if (sample.belly_hazard >= 0) {
      belly_hazard_ = sample.belly_hazard;
      belly_t_s_ = sample.t_s;
    }
    const double dt_s = started_ ? sample.t_s - last_t_s_ : timestep_s_;
    started_ = true;
    last_t_s_ = sample.t_s;
    if (sample.command.dwelling || sample.command.done || GoesBack(sample)) return false;
    if (count_ == 0) Keep(sample);
    Add(sample, dt_s);
    if (now_.clock_s < static_cast<double>(ticks_ + 1) * period_s_ - kTimeSlackS) return false;
    ++ticks_;
    Keep(sample);
    return count_ == ring_.size() && Judge(sample);
  }

 private:
  // What is summed up while moves are commanded, and where the robot then is.
  struct Kept {
    double clock_s = 0;          // time with a move commanded
    double commanded_s = 0;      // the same, where a slow command counts in full
    double moving_s = 0;         // of it: with a way commanded, not a turn on the spot
    double way_m = 0;            // commanded
    double angle_rad = 0;        // commanded on the spot: of the body, or of a hinge
    double turned_rad = 0;       // of that angle, as commanded
    bool turns_in_vain = false;  // so many turns commanded here are not the plan's
    double belly_ns = 0;         // belly load
    double driven_ns = 0;        // load of the driven wheels
    double rim_m = 0;            // way of their rims
    double progress_m = 0;
    Vec2 p_WB = Vec2::Zero();
    double t_s = 0;
  };

  // A turn asked for on the spot: of the body, or of the hinge that is to turn fastest.
  struct Turn {
    double wanted_radps = 0, done_radps = 0;  // the latter positive where it turns as wanted
  };
  static Turn TurnOf(const Sample& sample) {
    Turn turn;
    const auto take = [&](double wanted, double done) {
      if (std::abs(wanted) > turn.wanted_radps)
        turn = {std::abs(wanted), wanted > 0 ? done : -done};
    };
    take(sample.command.twist.wz_radps, sample.V_WB_B.wz_radps);
    for (std::size_t h = 0; h < static_cast<std::size_t>(sample.hinges.n); ++h)
      take(sample.command.hinges.radps[h], sample.hinges.radps[h]);
    return turn;
  }

  // As it is told to, from what it met.
  static bool GoesBack(const Sample& sample) {
    constexpr double kShare = 0.5;  // of the speed commanded
    const BodyTwist &cmd = sample.command.twist, &v = sample.V_WB_B;
    if (!sample.command.reacting) return false;
    const double speed_mps = std::hypot(cmd.vx_mps, cmd.vy_mps);
    if (sample.command.turning || speed_mps < kNoSpeedMps)
      return v.wz_radps * cmd.wz_radps >= kShare * cmd.wz_radps * cmd.wz_radps;
    return v.vx_mps * cmd.vx_mps + v.vy_mps * cmd.vy_mps >= kShare * speed_mps * speed_mps;
  }

  void Add(const Sample& sample, double dt_s) {
    const BodyTwist& cmd = sample.command.twist;
    const double speed_mps = std::sqrt(cmd.vx_mps * cmd.vx_mps + cmd.vy_mps * cmd.vy_mps);
    double clock_s = 0;
    if (sample.command.turning || speed_mps < kNoSpeedMps) {
      const Turn turn = TurnOf(sample);
      clock_s = dt_s * std::min(1.0, turn.wanted_radps / least_yaw_rate_radps_);
      now_.angle_rad += turn.wanted_radps * dt_s;
      now_.turned_rad += turn.done_radps * dt_s;
      turned_here_rad_ += std::abs(cmd.wz_radps) * dt_s;
    } else {
      clock_s = dt_s * std::min(1.0, speed_mps / least_speed_mps_);
      now_.moving_s += clock_s;
      now_.way_m += speed_mps * dt_s;
    }
    if (sample.progress_m > further_than_m_ + kFurtherM) {
      further_than_m_ = sample.progress_m;
      turned_here_rad_ = 0;
    }
    now_.clock_s += clock_s;
    now_.commanded_s += dt_s;
    now_.belly_ns += sample.belly_load_n * clock_s;
    now_.driven_ns += sample.driven_load_n * clock_s;
    now_.rim_m += sample.rim_mps * dt_s;
  }

  void Keep(const Sample& sample) {
    now_.turns_in_vain = turned_here_rad_ > kMostTurnsRad;
    now_.progress_m = sample.progress_m;
    now_.p_WB = sample.p_WB.head<2>();
    now_.t_s = sample.t_s;
    newest_ = (newest_ + 1) % ring_.size();
    ring_[newest_] = now_;
    count_ = std::min(count_ + 1, ring_.size());
  }

  // What the robot did in the window, and what it had to do; as lengths.
  struct Judgement {
    double done_m = 0, least_m = 0;
    double gained_m = 0, away_m = 0, turned_rad = 0, least_rad = 0;
    bool turning = false;  // the window is about a turn
  };

  Judgement Look() const {
    const Kept &first = ring_[(newest_ + 1) % ring_.size()], &last = ring_[newest_];
    double progress_m = first.progress_m, turned_rad = first.turned_rad, squared_m2 = 0;
    Judgement out;
    for (std::size_t i = 1; i <= ring_.size(); ++i) {
      const Kept& kept = ring_[(newest_ + i) % ring_.size()];
      progress_m = std::min(progress_m, kept.progress_m);
      turned_rad = std::min(turned_rad, kept.turned_rad);
      out.gained_m = std::max(out.gained_m, kept.progress_m - progress_m);
      out.turned_rad = std::max(out.turned_rad, kept.turned_rad - turned_rad);
      squared_m2 = std::max(squared_m2, (kept.p_WB - first.p_WB).squaredNorm());
    }
    out.away_m = std::sqrt(squared_m2);
    const double way_m = last.way_m - first.way_m;
    const double moving_s = last.moving_s - first.moving_s;
    out.least_rad = std::min(turn_rad_, fraction_ * (last.angle_rad - first.angle_rad));
    if (2 * moving_s >= last.clock_s - first.clock_s) {
      out.least_m = std::min(displacement_m_, fraction_ * way_m);
      const double away_m = out.away_m * out.least_m / (kAwayShare * way_m);
      out.done_m = std::max(out.gained_m, away_m);
    } else {  // a turn by turn_rad counts as a way of displacement_m
      out.turning = true;
      out.least_m = out.least_rad * displacement_m_ / turn_rad_;
      out.done_m = last.turns_in_vain ? 0 : out.turned_rad * displacement_m_ / turn_rad_;
      // Between the turns it may have got on by the way that was commanded.
      if (way_m >= least_speed_mps_ * window_s_)
        out.done_m = std::max(
            out.done_m, out.least_m * out.gained_m / std::min(displacement_m_, fraction_ * way_m));
    }
    return out;
  }

  // For how long, up to the window, it has been where it is while a move was commanded.
  double Still() const {
    const Kept& last = ring_[newest_];
    double since_s = last.commanded_s;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Kept& kept = ring_[(newest_ + ring_.size() - i) % ring_.size()];
      if ((kept.p_WB - last.p_WB).norm() > kStillM) break;
      since_s = kept.commanded_s;
    }
    return last.commanded_s - since_s;
  }

  bool Judge(const Sample& sample) {
    const Judgement now = Look();
    margin_ = std::min(margin_, now.done_m - now.least_m);
    const bool stuck = now.done_m < now.least_m;
    if (!stuck) reported_ = false;
    if (!stuck || reported_) return false;
    reported_ = true;

    const Kept &first = ring_[(newest_ + 1) % ring_.size()], &last = ring_[newest_];
    const double belly_n = (last.belly_ns - first.belly_ns) / window_s_;
    const bool high_centred = weight_n_ > 0 && belly_n >= belly_share_ * weight_n_;
    const bool on_hazard = high_centred && belly_hazard_ >= 0 && belly_t_s_ >= first.t_s;
    std::string hazard = on_hazard ? HazardId(*map_, belly_hazard_, false) : "";
    if (hazard.empty()) hazard = hazards_.Recall(first.t_s);
    event_ = MakeEvent(mode(), high_centred ? "high_centred" : "", sample, std::move(hazard),
                       now.done_m, now.least_m);
    event_.evidence = {{"gained_m", now.gained_m},
                       {"away_m", now.away_m},
                       {"commanded_m", last.way_m - first.way_m},
                       {"turn_rad", now.turned_rad},
                       {"turn_threshold_rad", now.least_rad},
                       {"commanded_rad", last.angle_rad - first.angle_rad},
                       {"turning", now.turning ? 1 : 0},
                       {"commanded_s", last.commanded_s - first.commanded_s},
                       {"still_s", Still()},
                       {"belly_load_n", belly_n},
                       {"driven_share", (last.driven_ns - first.driven_ns) / window_s_ / weight_n_},
                       {"rim_m", last.rim_m - first.rim_m},
                       {"since_s", first.t_s}};
    return true;
  }

  double window_s_ = 10, displacement_m_ = 0.5, fraction_ = 0.25, turn_rad_ = 0.5;
  double least_speed_mps_ = 0.02, least_yaw_rate_radps_ = 0.05;
  double belly_share_ = 0.1;  // a belly that only grazes carries less

  const HazardMap* map_ = nullptr;
  double weight_n_ = 0, timestep_s_ = 0;
  std::vector<Kept> ring_;
  std::size_t count_ = 0, newest_ = 0;
  double period_s_ = kSampleS;
  Kept now_;
  double further_than_m_ = 0;   // along the plan, the robot has not been
  double turned_here_rad_ = 0;  // commanded on the spot since it got there
  std::int64_t ticks_ = 0;
  double last_t_s_ = 0;
  bool started_ = false, reported_ = false;
  HazardMemory hazards_{&HazardMemory::Holds};
  int belly_hazard_ = -1;
  double belly_t_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, Stuck)

}  // namespace floorproof
