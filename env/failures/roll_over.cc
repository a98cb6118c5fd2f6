// SPDX-License-Identifier: Apache-2.0
// F3, roll over, in three ways, each an inequality on the true motion:
//   tilt > min(tilt limit, static tip angle) for tilt_duration_s: it is about to lie on its side;
//   kind `tipped`: the centre of mass lies outside the hull of the wheel contacts for
//     tipped_duration_s while a wheel touches (a robot in the air is not tipped yet);
//   kind `fell`: the lowest driven wheel is more than fall_m below the plan's floor; a robot that
//     lands on its wheels after a drop was never tilted much.
// The tilt limit is mjlab's bad-orientation termination; the others are static stability.
// The plan's floor is z = 0, or the lowest level change under the centre or a wheel that is known
// and low enough to be driven over, or on which the robot was set down. It does not judge how hard
// a landing was.
#include <algorithm>
#include <limits>
#include <vector>

#include "env/failures/detector.h"
#include "env/failures/evidence.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;  // sums of time steps are not exact
constexpr double kRecallS = 3.0;      // from the edge to the floor takes about a second

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
    v("tilt_limit_deg", tilt_limit_deg_, Between(1, 180),
      "tilt allowed at most; the robot's static tip angle where that is less");
    v("tilt_duration_s", tilt_duration_s_, NonNegative(), "how long the tilt must last");
    v("tipped_duration_s", tipped_duration_s_, NonNegative(),
      "how long the centre of mass must stand outside the wheels' support");
    v("fall_m", fall_m_, Positive(), "depth of the wheels below the plan's floor that is a fall");
  }

  FailureMode mode() const override { return FailureMode::kRollOver; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    const RobotSpec& robot = context.robot;
    limit_rad_ = tilt_limit_deg_ * kPi / 180;
    if (robot.static_tip_rad > 0) limit_rad_ = std::min(limit_rad_, robot.static_tip_rad);
    // While it folds, and in whatever shape a plan may give it, the least stable shape's limit.
    if (!robot.hinges.empty())
      for (const ShapeSpec& shape : robot.shapes)
        limit_rad_ = std::min(limit_rad_, shape.static_tip_rad);
    feet_B_ = {Vec2::Zero()};
    for (const WheelSpec& wheel : robot.wheels) feet_B_.push_back(wheel.p_BW.head<2>());
    levels_.clear();
    highest_floor_m_ = 0;
    for (const Hazard& hazard : context.map.hazards) {
      if (!hazard.known || hazard.hazard_class != HazardClass::kLevelChange ||
          IsObstacle(hazard, robot.step_m))
        continue;
      levels_.push_back(&hazard);
      highest_floor_m_ = std::max(highest_floor_m_, hazard.height_m);
    }
    starts_ = true;
    hazards_.Clear();
    tilted_.Clear();
    unsupported_.Clear();
    reported_ = false;
    rest_support_m_ = window_support_m_ = 0;
    window_since_s_ = 0;
    margin_ = limit_rad_;
  }

  bool Update(const Sample& sample) override {
    hazards_.Update(sample);
    if (starts_) AddStartLevels(sample.X_WB());
    const double tilt_margin_rad = limit_rad_ - sample.tilt_rad;
    const bool tilted = tilted_.Update(tilt_margin_rad < 0, sample.t_s, tilt_duration_s_);

    const bool off_support = sample.wheel_contacts > 0 && sample.support_margin_m < 0;
    const bool tipped = unsupported_.Update(off_support, sample.t_s, tipped_duration_s_);

    // The exact floor matters only to a wheel that is below any floor the plan can have.
    double fall_threshold_m = highest_floor_m_ - fall_m_;
    if (sample.wheel_floor_z_m < fall_threshold_m)
      fall_threshold_m = PlanFloor(sample.X_WB()) - fall_m_;
    const bool fell = sample.wheel_floor_z_m < fall_threshold_m;

    // In radians of tilt: each inequality's share still left, times the tilt limit. Conditions that
    // have not lasted long enough count as just met.
    double left =
        tilted ? tilt_margin_rad / limit_rad_ : std::max(0.0, tilt_margin_rad / limit_rad_);
    left = std::min(left, tipped && rest_support_m_ > 0 ? sample.support_margin_m / rest_support_m_
                                                        : SupportLeft(sample));
    left = std::min(left, (sample.wheel_floor_z_m - fall_threshold_m) / fall_m_);
    if (tipped || fell) left = std::min(left, -std::numeric_limits<double>::min());
    margin_ = std::min(margin_, left * limit_rad_);

    if (!tilted && !tipped && !fell) {
      // Rearmed when all is well again, not merely when a condition's clock restarted.
      if (tilt_margin_rad >= 0 && !off_support) reported_ = false;
      return false;
    }
    if (reported_) return false;
    reported_ = true;
    Report(sample, tilted, fell, fall_threshold_m);
    return true;
  }

 private:
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
    window_support_m_ = 0;
    window_since_s_ = sample.t_s;
    return rest_support_m_ > 0 && sample.wheel_contacts > 0 ? best_m / rest_support_m_ : 1;
  }

  // Whoever sets a robot down on a level means it to drive there.
  void AddStartLevels(const Pose2& X_WB) {
    starts_ = false;
    std::vector<const Hazard*> levels;
    for (const Hazard& hazard : map_->hazards) {
      const bool under = hazard.hazard_class == HazardClass::kLevelChange &&
                         std::ranges::any_of(hazard.footprint, [&](const Polygon& polygon) {
                           return std::ranges::any_of(feet_B_, [&](const Vec2& p_B) {
                             return Contains(polygon, X_WB * p_B);
                           });
                         });
      if (under || std::ranges::find(levels_, &hazard) != levels_.end()) levels.push_back(&hazard);
      if (under) highest_floor_m_ = std::max(highest_floor_m_, hazard.height_m);
    }
    levels_ = std::move(levels);  // in the map's order: later ones win
  }

  double PlanFloor(const Pose2& X_WB) const {
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const Vec2& p_B : feet_B_) {
      const Vec2 p_W = X_WB * p_B;
      double floor_m = 0;
      for (const Hazard* level : levels_)
        for (const Polygon& polygon : level->footprint)
          if (Contains(polygon, p_W)) floor_m = level->height_m;
      lowest_m = std::min(lowest_m, floor_m);
    }
    return lowest_m;
  }

  // The low floor under the centre or a wheel: a robot in the air touches no hazard.
  std::string DropBelow(const Pose2& X_WB) const {
    std::string id;
    for (const Vec2& p_B : feet_B_)
      for (const Hazard& hazard : map_->hazards)
        for (const Polygon& polygon : hazard.footprint)
          if (hazard.height_m < 0 && Contains(polygon, X_WB * p_B)) id = hazard.id;
    return id;
  }

  void Report(const Sample& sample, bool tilted, bool fell, double fall_threshold_m) {
    std::string hazard = hazards_.Recall(*map_, sample.t_s - kRecallS);
    if (hazard.empty()) hazard = DropBelow(sample.X_WB());
    if (tilted)
      event_ = MakeEvent(mode(), "", sample, std::move(hazard), sample.tilt_rad, limit_rad_);
    else if (fell)
      event_ = MakeEvent(mode(), "fell", sample, std::move(hazard), sample.wheel_floor_z_m,
                         fall_threshold_m);
    else
      event_ = MakeEvent(mode(), "tipped", sample, std::move(hazard), sample.support_margin_m, 0.0);
    event_.evidence = {{"tilt_rad", sample.tilt_rad},
                       {"support_margin_m", sample.support_margin_m},
                       {"wheel_floor_z_m", sample.wheel_floor_z_m},
                       {"roll_rad", sample.roll_rad},
                       {"pitch_rad", sample.pitch_rad}};
  }

  double tilt_limit_deg_ = 70;  // mjlab's
  double tilt_duration_s_ = 0.1, tipped_duration_s_ = 0.5;
  double fall_m_ = 0.030;

  const HazardMap* map_ = nullptr;
  double limit_rad_ = 0, highest_floor_m_ = 0;
  std::vector<Vec2> feet_B_;
  std::vector<const Hazard*> levels_;  // known level changes that are driven over
  HazardMemory hazards_;
  Lasting tilted_, unsupported_;
  double rest_support_m_ = 0;  // the most seen: the support when standing well
  double window_support_m_ = 0, window_since_s_ = 0;
  bool reported_ = false;
  bool starts_ = true;  // no sample was seen yet
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, RollOver)

}  // namespace floorproof
