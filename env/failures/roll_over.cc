// SPDX-License-Identifier: Apache-2.0
// F3, roll over, in three ways, each an inequality on the true motion:
//   tilt > tilt limit for tilt_duration_s: it lies on its side, or is about to;
//   kind `tipped`: the centre of mass lies outside the hull of what carries the robot, by more than
//     tipped_share of the support at rest, on the side to which it leans, and does not come back
//     for tipped_duration_s while a wheel touches (a robot in the air is not tipped yet);
//   kind `fell`: a driven wheel lost its footing and dropped by more than fall_m, than half a
//     wheel's radius, and than the step that the robot is measured or trusted to cross; or it
//     landed with more than landing_j_per_kg, half the square of its speed downwards. It is what
//     the wheels did that counts, on whatever floor and whatever the plan knew
//     (env/sim/drop_meter.h).
// The tilt limit is mjlab's bad-orientation termination; the others are static stability. The
// static tip angle is no limit: a robot that rears up on a cover leans by more and comes back, one
// that rests on its belly's edge leans by more and drives. What is that deep outside falls on: an
// upright pendulum's deviation grows by cosh(t sqrt(g / h)), 13 times in half a second at h = 0.2
// m. A robot that rocks over a bump crosses the border of its support as well. It does so from the
// far side, coming back to level, or by less than that, until the next wheel touches. One that
// rests on two points has no polygon, and no deviation beyond noise either.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "env/core/levels.h"
#include "env/core/measured_limits.h"
#include "env/core/slopes.h"
#include "env/failures/detector.h"
#include "env/failures/evidence.h"
#include "env/failures/footing.h"
#include "env/failures/posture.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;  // sums of time steps are not exact
constexpr double kRecallS = 3.0;      // from the edge to the floor takes about a second
constexpr double kWellS = 1.0;        // after which a failure is another one

// No contact is placed better than this: a support may be a line.
constexpr double kNoise_m = 0.002;
constexpr double kComesBack_rad = 0.005;  // lean lost by a robot that does not tip
constexpr double kSunk_m = 0.005;         // of what has gone over an edge

// True from the moment on that a condition has held for a duration.
class Lasting {
 public:
  bool Update(bool holds, double t_s, double duration_s) {
    if (!holds) {
      holds_ = false;
      return false;
    }
    if (!holds_) since_s_ = t_s;
    holds_ = true;
    return t_s - since_s_ >= duration_s - kTimeSlackS;
  }
  void Clear() { holds_ = false; }

 private:
  bool holds_ = false;
  double since_s_ = 0;
};

class RollOver final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("tilt_limit_deg", tilt_limit_deg_, Between(1, 180), "tilt allowed at most");
    v("tilt_duration_s", tilt_duration_s_, NonNegative(), "how long the tilt must last");
    v("tipped_duration_s", tipped_duration_s_, NonNegative(),
      "how long the centre of mass must stand outside the wheels' support");
    v("tipped_share", tipped_share_, Between(0, 1),
      "how far outside that is, as a share of the support at rest");
    v("fall_m", fall_m_, Positive(),
      "how far a wheel may drop that loses its footing; half its radius or the robot's own step if "
      "that is more");
    v("landing_j_per_kg", landing_j_per_kg_, Positive(),
      "energy with which a wheel may land, for each kilogram; 1 is a drop of 0.1 m");
  }

  FailureMode mode() const override { return FailureMode::kRollOver; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    const RobotSpec& robot = context.robot;
    limit_rad_ = tilt_limit_deg_ * kPi / 180;
    robot_ = &robot;
    // From the centre of mass to the nearest edge of the wheels' polygon.
    deep_m_ = std::max(kNoise_m, tipped_share_ * robot.p_BCom.z() * std::tan(robot.static_tip_rad));
    // A large wheel that hops off an edge comes down by a part of its radius.
    constexpr double kHop = 0.5;
    most_drop_m_ = std::max(fall_m_, TrustedStep(robot, context.map.floor_friction));
    for (const WheelSpec& wheel : robot.wheels)
      most_drop_m_ = std::max(most_drop_m_, kHop * wheel.radius_m);
    start_m_.reset();
    hazards_.Start(context);
    tilted_.Clear();
    unsupported_.Clear();
    well_.Clear();
    reported_ = false;
    rest_support_m_ = window_support_m_ = most_lean_rad_ = 0;
    window_since_s_ = 0;
    StartMargin(limit_rad_);
  }

  bool Update(const Sample& sample) override {
    hazards_.Update(sample);
    if (!start_m_) start_m_ = FloorUnder(*map_, *robot_, sample);
    const double tilt_margin_rad = limit_rad_ - sample.tilt_rad;
    const bool tilted = tilted_.Update(tilt_margin_rad < 0, sample.t_s, tilt_duration_s_);

    const bool off_support = sample.wheel_contacts > 0 && FallsOn(sample);
    const bool tipped = unsupported_.Update(off_support, sample.t_s, tipped_duration_s_);

    const double landing_j_per_kg = LandingEnergy(sample);
    const bool fell = sample.drop_m > most_drop_m_ || landing_j_per_kg > landing_j_per_kg_;

    // In radians of tilt: each inequality's share still left, times the tilt limit. Conditions that
    // have not lasted long enough count as just met.
    double left =
        tilted ? tilt_margin_rad / limit_rad_ : std::max(0.0, tilt_margin_rad / limit_rad_);
    left = std::min(left, tipped && rest_support_m_ > 0 ? ShareOfSupport(sample.support_margin_m)
                                                        : SupportLeft(sample));
    left = std::min(
        {left, 1 - sample.drop_m / most_drop_m_, 1 - landing_j_per_kg / landing_j_per_kg_});
    if (tipped || fell) left = std::min(left, -std::numeric_limits<double>::min());
    margin_ = std::min(margin_, left * limit_rad_);

    if (!tilted && !tipped && !fell) {
      // Rearmed when all has been well for a while, not merely when a condition's clock restarted:
      // of one that goes over an edge, one wheel falls after the other.
      if (well_.Update(tilt_margin_rad >= 0 && !off_support, sample.t_s, kWellS)) reported_ = false;
      return false;
    }
    well_.Clear();
    if (reported_) return false;
    reported_ = true;
    Report(sample, tilted, fell);
    return true;
  }

 private:
  // Of each kilogram, J.
  static double LandingEnergy(const Sample& sample) {
    return sample.landing_mps * sample.landing_mps / 2;
  }

  // Outside on the low side, and not on its way back.
  bool FallsOn(const Sample& sample) {
    const double lean_rad = LeanOf(Attitude(sample)).dot(sample.off_support_W);
    const bool outside = sample.support_margin_m < -deep_m_ && lean_rad > 0;
    most_lean_rad_ = outside ? std::max(most_lean_rad_, lean_rad) : 0;
    return outside && lean_rad > most_lean_rad_ - kComesBack_rad;
  }

  // 1 as at rest, 0 where it would fall on.
  double ShareOfSupport(double margin_m) const {
    return (margin_m + deep_m_) / (rest_support_m_ + deep_m_);
  }

  // When a wheel lifts for one step, the hull of the contacts is empty. What counts is therefore
  // the best support within tipped_duration_s, as a share of the support at rest. 1 until that is
  // known.
  double SupportLeft(const Sample& sample) {
    if (sample.wheel_contacts > 0) {
      rest_support_m_ = std::max(rest_support_m_, sample.support_margin_m);
      window_support_m_ = std::max(window_support_m_, sample.support_margin_m);
    }
    if (sample.t_s - window_since_s_ < tipped_duration_s_) return 1;
    const double best_m = window_support_m_;
    window_support_m_ = -deep_m_;
    window_since_s_ = sample.t_s;
    return rest_support_m_ > 0 && sample.wheel_contacts > 0 ? ShareOfSupport(best_m) : 1;
  }

  // The id of the gap there: in the floor, or a floor below that of the start. Else "".
  std::string DropAt(const Vec2& p_W) const {
    bool is_base = true;
    for (std::size_t h = map_->hazards.size(); h-- > 0;) {
      const Hazard& hazard = map_->hazards[h];
      const bool is_level = hazard.hazard_class == HazardClass::kLevelChange || IsRamp(hazard);
      for (const Polygon& polygon : hazard.footprint) {
        if (!Contains(polygon, p_W)) continue;
        if (IsGap(hazard, *start_m_)) return hazard.id;
        is_base &= !is_level;
      }
    }
    return is_base && *start_m_ > 0 ? BaseFloorId(*map_) : "";
  }

  // What a wheel fell from: the gap into which it went, else the hazard on which it stood.
  std::string FellFrom(const Sample& sample) const {
    for (std::size_t h = map_->hazards.size(); h-- > 0;) {
      const Hazard& hazard = map_->hazards[h];
      for (const Polygon& polygon : hazard.footprint)
        if (hazard.height_m < 0 && static_cast<int>(h) != sample.drop_hazard &&
            Contains(polygon, sample.drop_W))
          return hazard.id;
    }
    return HazardId(*map_, sample.drop_hazard, false);
  }

  // The gap into which the robot has gone: below what has sunk deepest, of its wheels and its
  // outline. A robot in the air touches no hazard.
  std::string DropBelow(const Sample& sample) const {
    const Mat3 R_WB = Attitude(sample);
    std::string drop;
    double deepest_m = kSunk_m;
    const auto look = [&](const Vec3& p_B, double rest_m) {
      const Vec3 p_W = sample.p_WB + R_WB * p_B;
      const double sunk_m = *start_m_ + rest_m - p_W.z();
      if (sunk_m <= deepest_m) return;
      std::string below = DropAt(p_W.head<2>());
      if (below.empty()) return;
      deepest_m = sunk_m;
      drop = std::move(below);
    };
    const WheelCentres centres(*robot_, sample);
    for (const WheelSpec& wheel : robot_->wheels) {
      const Vec3 p_B = centres.Of(wheel);
      look(p_B, p_B.z());
    }
    constexpr int kAround = 16;
    for (int i = 0; i < kAround; ++i) {
      const double bearing_rad = 2 * kPi * i / kAround;
      const double r_m = EdgeAlong(robot_->clear, bearing_rad);
      look({r_m * std::cos(bearing_rad), r_m * std::sin(bearing_rad), robot_->clearance_m},
           robot_->clearance_m);
    }
    return drop;
  }

  void Report(const Sample& sample, bool tilted, bool fell) {
    std::string hazard = fell ? FellFrom(sample) : DropBelow(sample);
    if (hazard.empty()) hazard = hazards_.Recall(sample.t_s - kRecallS);
    if (fell && sample.drop_m > most_drop_m_)
      event_ = MakeEvent(mode(), "fell", sample, std::move(hazard), sample.drop_m, most_drop_m_);
    else if (fell)
      event_ = MakeEvent(mode(), "landed", sample, std::move(hazard), LandingEnergy(sample),
                         landing_j_per_kg_);
    else if (tilted)
      event_ = MakeEvent(mode(), "", sample, std::move(hazard), sample.tilt_rad, limit_rad_);
    else
      event_ =
          MakeEvent(mode(), "tipped", sample, std::move(hazard), sample.support_margin_m, -deep_m_);
    event_.evidence = {{"tilt_rad", sample.tilt_rad}, {"support_margin_m", sample.support_margin_m},
                       {"drop_m", sample.drop_m},     {"landing_mps", sample.landing_mps},
                       {"roll_rad", sample.roll_rad}, {"pitch_rad", sample.pitch_rad}};
  }

  double tilt_limit_deg_ = 70;  // mjlab's
  double tilt_duration_s_ = 0.1, tipped_duration_s_ = 0.5;
  double tipped_share_ = 0.1;                     // ours
  double fall_m_ = 0.030, landing_j_per_kg_ = 1;  // ours

  const HazardMap* map_ = nullptr;
  const RobotSpec* robot_ = nullptr;
  double limit_rad_ = 0;
  double deep_m_ = 0, most_lean_rad_ = 0, most_drop_m_ = 0;
  std::optional<double> start_m_;  // height of the floor on which it was set down
  HazardMemory hazards_{&HazardMemory::Tilts};
  Lasting tilted_, unsupported_, well_;
  double rest_support_m_ = 0;  // the most seen: the support when standing well
  double window_support_m_ = 0, window_since_s_ = 0;
  bool reported_ = false;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, RollOver)

}  // namespace floorproof
