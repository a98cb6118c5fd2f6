// SPDX-License-Identifier: Apache-2.0
// An edge that is higher than a body's bottom holds the body, whatever its speed and the kind of
// hazard: a cart with a box that reaches far ahead of its wheels, driven against the edge. Its
// motors stall before its wheels spin, because wheels that spin hop.
//
// Tolerance 1 mm: lower edges than 0.2 mm above the bottom do not hold, and the body nods.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "validate/bisect.h"
#include "validate/cart.h"
#include "validate/law.h"
#include "validate/made_hazard.h"

namespace floorproof {
namespace {

constexpr double kNose_m = 0.45, kWheel_m = 0.05;
constexpr double kTolerance_mm = 1;

// A drive against an edge that lies across `yaw_rad`, 0.1 m before the foremost corner of the nose.
struct Approach {
  double clearance_m = 0, yaw_rad = 0, speed_mps = 0;
  std::string hazard = "step";

  Pose2 X_WE() const {
    constexpr double kRun_m = 0.1;
    const Vec2 across(std::cos(yaw_rad), std::sin(yaw_rad));
    const Vec2 p_W = Vec2(kNose_m, kNoseHalfWidth_m) + kRun_m * across;
    return {p_W.x(), p_W.y(), yaw_rad};
  }
};

// The keys of a hazard with an upright edge of that height.
std::string Keys(const std::string& hazard, double height_m) {
  const std::string height = fmt::format("height_m: {}", height_m);
  if (hazard == "threshold")
    return height + fmt::format(", vertical_m: {}, bevel: 0, width_m: 0.5", height_m);
  if (hazard == "carpet") return height + ", bevel: 0";
  if (hazard == "lift_sill") return fmt::format("level_m: {}, gap_m: 0.005", height_m);
  return height;
}

class EdgeHold final : public Law {
 public:
  std::string_view statement() const override {
    return "a body gets onto no edge that is higher than its bottom, at any speed";
  }
  std::vector<WrongModel> notices() const override { return {{.contacts_forget = true}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    const auto add = [&](const std::string& name, const Approach& approach) {
      rows.push_back({fmt::format("edge/{}/{}mps", name, approach.speed_mps),
                      1000 * approach.clearance_m, 1000 * Limit_m(approach, wrong), kTolerance_mm,
                      "mm"});
    };
    for (const double clearance_m : {0.005, 0.015, 0.06})
      for (const double yaw_deg : {0.0, 3.0, 45.0})
        for (const double speed_mps : {0.1, 0.3, 1.0})
          add(fmt::format("{}mm/{}deg", 1000 * clearance_m, yaw_deg),
              {clearance_m, yaw_deg * kPi / 180, speed_mps});
    for (const char* hazard : {"blind_object", "threshold", "carpet", "lift_sill"})
      add(hazard, {0.015, 0, 1.0, hazard});
  }

 private:
  // The highest edge that the body gets onto.
  static double Limit_m(const Approach& approach, const WrongModel& wrong) {
    return Bisect(approach.clearance_m - 0.002, approach.clearance_m + 0.01, 1e-4,
                  [&](double height_m) { return GetsOn(approach, height_m, wrong); });
  }

  static bool GetsOn(const Approach& approach, double height_m, const WrongModel& wrong) {
    constexpr double kOn_m = 0.03;
    const Pose2 X_WE = approach.X_WE();
    std::vector<Vec2> place;
    if (approach.hazard == "threshold")
      place = {{0.25, -2}, {0.25, 2}};
    else
      place = {{0, 2}, {0, -2}, {1, -2}, {1, 2}};
    for (Vec2& p : place) p = X_WE * p;
    RigOptions options{.wrong = wrong};
    options.hazards = {MakeHazard(approach.hazard, Keys(approach.hazard, height_m), place)};
    Rig rig(MakeCart({.wheel_radius_m = kWheel_m,
                      .axle_x_m = 0.15,
                      .motor_nm = 0.25,
                      .nose_m = kNose_m,
                      .clearance_m = approach.clearance_m}),
            std::move(options));
    rig.CommandWheels(approach.speed_mps / kWheel_m);
    const double end_s = 1 + 0.3 / approach.speed_mps;
    while (rig.truth().t_s < end_s) {
      rig.Step();
      if (BeyondEdge_m(rig, X_WE) > kOn_m) return true;
    }
    return false;
  }

  // How far the nose's foremost corner is beyond the edge.
  static double BeyondEdge_m(const Rig& rig, const Pose2& X_WE) {
    const auto beyond_m = [&](double y_m) {
      return X_WE.InverseTimes(rig.truth().X_WB() * Vec2(kNose_m, y_m)).x();
    };
    return std::max(beyond_m(-kNoseHalfWidth_m), beyond_m(kNoseHalfWidth_m));
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, EdgeHold)

}  // namespace floorproof
