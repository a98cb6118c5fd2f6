// SPDX-License-Identifier: Apache-2.0
// A robot that has come to lean otherwise than at its start: a load has shifted, a spring has
// broken, a wheel is off. The mean of where the accelerometer says that down is, over a while in
// which hazards are crossed and speeds change, beside that of the first such while. What the known
// map's ramps make it lean, where it thinks that it is, is taken off: the slope under its middle
// and around.
//
// A floor that no map knows makes it lean, too: a ramp, a carpet under one wheel. Such a lean keeps
// its direction in the world, and ends with the floor. A load's keeps its direction in the body. So
// a lean is the load's if it began while the robot stood, or has kept its direction in the body
// while the robot turned, or over a longer way than ramps have.
#include <algorithm>
#include <cmath>

#include "controllers/monitors/monitor.h"
#include "env/core/slopes.h"
#include "env/core/standing.h"

namespace floorproof {
namespace {

class Lean final : public Monitor {
 public:
  Lean() : Monitor({.hold_s = 2}) {}
  MonitorKind kind() const override { return MonitorKind::kTrend; }
  std::string_view unit() const override { return "deg"; }
  std::vector<Reading> Needs() const override { return {Reading::kImu}; }

  void Update(const MonitorReadings& now) override {
    if (!now.has_imu) return;
    const Vec2 lean = now.accel_mps2.normalized().head<2>() - FloorsLean(now.estimate.X_WB);
    const double ahead = ahead_.Update(lean.x(), now.dt_s, mean_s_),
                 aside = aside_.Update(lean.y(), now.dt_s, mean_s_);
    heard_s_ += now.dt_s;
    if (heard_s_ < 2 * mean_s_) {
      first_ = {ahead, aside};
      return;
    }
    const Vec2 off = Vec2(ahead, aside) - first_;
    const double off_deg = std::asin(std::min(1.0, off.norm())) * 180 / kPi;
    const bool leans = off_deg > limit_deg_;
    const bool bad = IsTheLoads(off, off_deg, now);
    alarm().Update(now.t_s, now.dt_s, bad, !leans, off_deg, limit_deg_);
  }

 private:
  void VisitOwn(ParamVisitor& v) override {
    v("limit_deg", limit_deg_, Between(0, 180), "most change (deg)");
    v("mean_s", mean_s_, Positive(), "time constant of the mean (s)");
    v("turn_deg", turn_deg_, Between(1, 360),
      "a lean that keeps its direction in the body over such a turn is no floor's (deg)");
    v("way_m", way_m_, Positive(), "the same over such a distance (m)");
  }
  void StartOwn(const MonitorContext& context) override {
    known_ = &context.known;
    const auto is_ramp = [](const Hazard& hazard) { return IsRamp(hazard); };
    has_ramps_ = std::ranges::any_of(known_->hazards, is_ramp);
    around_m_ = kAround * context.robot.inscribed_radius_m;
    ahead_.Reset();
    aside_.Reset();
    heard_s_ = 0;
    first_ = Vec2::Zero();
    since_calm_ = since_leaning_ = {};
    direction_ = Vec2::Zero();
    stood_ = false;
  }

  // How the robot has moved.
  struct Moved {
    double way_m = 0, turned_rad = 0, most_turned_rad = 0;
    void Add(const MonitorReadings& now) {
      way_m += std::hypot(now.estimate.V_WB_B.vx_mps, now.estimate.V_WB_B.vy_mps) * now.dt_s;
      turned_rad += now.gyro_radps.z() * now.dt_s;
      most_turned_rad = std::max(most_turned_rad, std::abs(turned_rad));
    }
  };

  // One period: whether a floor can no longer be what makes it lean so in the body frame.
  bool IsTheLoads(const Vec2& off, double off_deg, const MonitorReadings& now) {
    constexpr double kCalm = 0.25;  // of the limit
    constexpr double kStood_m = 0.03, kStood_rad = 0.05, kSameDirection_rad = 30 * kPi / 180;
    since_calm_.Add(now);
    if (off_deg < kCalm * limit_deg_) since_calm_ = {};
    const double same = std::cos(kSameDirection_rad) * off.norm() * direction_.norm();
    if (off_deg <= limit_deg_ || off.dot(direction_) < same) {
      since_leaning_ = {};
      direction_ = off;
      stood_ = since_calm_.way_m < kStood_m && since_calm_.most_turned_rad < kStood_rad;
      return false;
    }
    since_leaning_.Add(now);
    return stood_ || since_leaning_.way_m > way_m_ ||
           since_leaning_.most_turned_rad > turn_deg_ * kPi / 180;
  }

  // What upwards is in the body frame, of a robot that stands on the known floor there.
  Vec2 FloorsLean(const Pose2& X_WB) const {
    if (!has_ramps_) return Vec2::Zero();
    Vec2 gradient_W = Vec2::Zero();
    for (const Vec2& p_B : {Vec2(1, 1), Vec2(1, -1), Vec2(-1, 1), Vec2(-1, -1)})
      gradient_W += GroundAt(*known_, X_WB * Vec2(around_m_ * p_B)).gradient / 4;
    return Pose2{0, 0, -X_WB.yaw_rad}.Rotate(gradient_W) / std::sqrt(1 + gradient_W.squaredNorm());
  }

  static constexpr double kAround = 0.7;  // of the radius: about where wheels are
  double limit_deg_ = 1.5, mean_s_ = 2, turn_deg_ = 80, way_m_ = 10, around_m_ = 0;
  const HazardMap* known_ = nullptr;
  bool has_ramps_ = false;
  LowPass ahead_, aside_;
  double heard_s_ = 0;
  Vec2 first_ = Vec2::Zero();
  Moved since_calm_, since_leaning_;
  Vec2 direction_ = Vec2::Zero();  // in which it leans, in the body frame
  bool stood_ = false;             // when it began to
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, Lean)

}  // namespace floorproof
