// SPDX-License-Identifier: Apache-2.0
// The body moves as its wheels roll without slip: differential drive by its two wheels' rims,
// Mecanum drive by Muir & Neuman 1987 (controllers/mecanum_drive.cc).
//
// Tolerances: rolling friction makes the motors droop by a third of a per cent; turning while it
// moves needs a force across, which soft friction gives with a creep. A plain tyre is as wide as
// its cylinder: turning, it scrubs, and rolls true on a line anywhere within that width. BELUGA's
// half width of 8 mm on a half track of 135 mm could cost 6 % of the yaw rate at most; half of that
// is allowed.
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kPlainError = 0.005, kCurveError = 0.0075, kScrubError = 0.03;

class Kinematics final : public Law {
 public:
  std::string_view statement() const override {
    return "V_B = J^+ R omega, the wheels rolling without slip on a flat floor";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    constexpr double kSpeed_mps = 0.2, kTurn_radps = 0.5;
    const auto both = [&](const char* robot) {
      Row(robot, "forward", {kSpeed_mps, 0, 0}, wrong, rows);
      Row(robot, "backward", {-kSpeed_mps, 0, 0}, wrong, rows);
      Row(robot, "turning", {0, 0, kTurn_radps}, wrong, rows);
    };
    both("beluga");
    Row("beluga", "curve", {kSpeed_mps, 0, 0.4}, wrong, rows);
    both("htetro");
    for (int deg = 30; deg < 360; deg += 30) {
      if (deg == 180) continue;  // backward
      const double way_rad = deg * kPi / 180;
      const BodyTwist twist{kSpeed_mps * std::cos(way_rad), kSpeed_mps * std::sin(way_rad), 0};
      Row("htetro", "direction" + std::to_string(deg), twist, wrong, rows);
    }
    Row("htetro", "curve", {kSpeed_mps, 0.1, 0.3}, wrong, rows);
  }

 private:
  // The velocity along the twist commanded, each component in its own unit.
  static void Row(const std::string& robot, const std::string& name, const BodyTwist& twist,
                  const WrongModel& wrong, std::vector<LawRow>& rows) {
    Rig rig(robot, {.wrong = wrong});
    const BodyTwist v = rig.Run(twist, 3);
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    const double share = speed > 0 && twist.wz_radps != 0 ? kCurveError : kPlainError;
    const bool plain_tyres = rig.robot().wheels.front().roller_radius_m == 0;
    const double tyre_share = plain_tyres ? kScrubError : share;
    const std::string law = "kinematics/" + robot + "/" + name;
    if (speed > 0) {
      const double along = (v.vx_mps * twist.vx_mps + v.vy_mps * twist.vy_mps) / speed;
      const double across = (v.vy_mps * twist.vx_mps - v.vx_mps * twist.vy_mps) / speed;
      rows.push_back({law + "/along", speed, along, share * speed, "m/s"});
      rows.push_back({law + "/across", 0, across, share * speed, "m/s"});
    }
    rows.push_back({law + "/turn", twist.wz_radps, v.wz_radps,
                    std::max(tyre_share * std::abs(twist.wz_radps), kPlainError * kLeastTurn_radps),
                    "rad/s"});
  }

  static constexpr double kLeastTurn_radps = 0.2;  // of a straight drive's tolerance: 1 mrad/s
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Kinematics)

}  // namespace floorproof
