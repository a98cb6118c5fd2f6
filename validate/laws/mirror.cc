// SPDX-License-Identifier: Apache-2.0
// Mirrored scene, mirrored motion: driven straight over a plank under its left side, or in a left
// curve, a robot ends where the mirror image of its twin ends, which had plank and curve on the
// right. All rows are differences; left and right twin are two simulations, and the wrong model is
// put into the right one alone.
//
// Tolerance 0.1 mm and 0.1 mrad over a metre: the equations are the same but for the order in which
// the solver meets the contacts, and where it stops (measured: 20 micrometres at most).
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kOrder_m = 1e-4, kOrder_rad = 1e-4;

class Mirror final : public Law {
 public:
  std::string_view statement() const override {
    return "the mirrored scene gives the mirrored motion: differences 0";
  }
  std::vector<WrongModel> notices() const override { return {kMoreFriction, kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    Row("beluga/plank", "beluga", {0.2, 0, 0}, 0.006, wrong, rows);
    Row("beluga/curve", "beluga", {0.2, 0, 0.5}, 0, wrong, rows);
    Row("htetro/plank", "htetro", {0.2, 0, 0}, 0.012, wrong, rows);
    Row("htetro/curve", "htetro", {0.2, 0.1, 0.5}, 0, wrong, rows);
  }

 private:
  // `side`: 1 left, -1 right.
  static Truth Drive(const char* robot, const BodyTwist& twist, double plank_m, double side,
                     const WrongModel& wrong) {
    RigOptions options{.wrong = wrong};
    if (plank_m > 0) {
      constexpr double kWide_m = 2;
      options.hazards.push_back(
          Prism("plank",
                Rectangle({0.4, std::min(0.0, side * kWide_m)}, {2, std::max(0.0, side * kWide_m)}),
                {}, plank_m));
    }
    Rig rig(robot, std::move(options));
    rig.Run({twist.vx_mps, side * twist.vy_mps, side * twist.wz_radps}, 5);
    return rig.truth();
  }

  static void Row(const std::string& name, const char* robot, const BodyTwist& twist,
                  double plank_m, const WrongModel& wrong, std::vector<LawRow>& rows) {
    const Truth left = Drive(robot, twist, plank_m, 1, {});
    const Truth right = Drive(robot, twist, plank_m, -1, wrong);
    const auto row = [&](const char* what, double difference, double tolerance, const char* unit) {
      rows.push_back({"mirror/" + name + "/" + what, 0, difference, tolerance, unit});
    };
    row("x", left.p_WB.x() - right.p_WB.x(), kOrder_m, "m");
    row("y", left.p_WB.y() + right.p_WB.y(), kOrder_m, "m");
    row("yaw", left.yaw_rad + right.yaw_rad, kOrder_rad, "rad");
    if (plank_m > 0) row("roll", left.roll_rad + right.roll_rad, kOrder_rad, "rad");
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Mirror)

}  // namespace floorproof
