// SPDX-License-Identifier: Apache-2.0
#include "validate/robot_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity.h"

namespace floorproof {
namespace {

constexpr double kFriction = 0.8;  // of the floor that it was driven on
constexpr double kGap_m = 0.001;   // what a floor gives, and nobody sees
constexpr double kDegree = kPi / 180;

using Kind = Finding::Kind;

class Findings {
 public:
  explicit Findings(RobotCheck& check) : check_(check) {}

  void Wrong(std::string what, std::string mend) {
    check_.findings.push_back({Kind::kWrong, std::move(what), std::move(mend)});
  }
  void Note(std::string what, std::string mend) {
    check_.findings.push_back({Kind::kNote, std::move(what), std::move(mend)});
  }

  void Carriers() {
    for (const Carrier& carrier : check_.stance.carriers) {
      const double gap_m = carrier.p_B.z();
      if (std::abs(gap_m) <= kGap_m) continue;
      const std::string by = LengthText(std::abs(gap_m));
      if (gap_m < 0)
        Wrong(fmt::format("{} reaches {} into the floor", carrier.name, by),
              fmt::format("raise its body by that; z = 0 of `base` is the floor"));
      else if (carrier.driven)
        Wrong(fmt::format("the driven wheel {} hangs {} over the floor", carrier.name, by),
              fmt::format("lower its body by that, or let the floor, z = 0 of `base`, be there"));
      else
        Note(fmt::format("{} stands {} over the floor", carrier.name, by),
             "it carries nothing until the robot leans");
    }
  }

  void Inertias(const RobotModel& robot) {
    constexpr double kNone = 1e-6;  // MuJoCo takes what is below 0 for 0
    const ModelPtr model = CompileAlone(robot);
    const mjModel* m = model.get();
    for (int b = 1; b < m->nbody; ++b) {
      const double mass_kg = m->body_mass[b];
      if (!(mass_kg > 0)) continue;
      double reach_m = 0;  // no matter of the body is farther from its centre of mass
      for (int g = m->body_geomadr[b]; g < m->body_geomadr[b] + m->body_geomnum[b]; ++g)
        reach_m = std::max(
            reach_m, m->geom_rbound[g] + mju_dist3(m->geom_pos + 3 * g, m->body_ipos + 3 * b));
      const char* name = mj_id2name(m, mjOBJ_BODY, b);
      const std::string body = name != nullptr ? name : fmt::format("body {}", b);
      const auto [least, most] =
          std::minmax_element(m->body_inertia + 3 * b, m->body_inertia + 3 * b + 3);
      if (*least <= kNone * *most) {
        Wrong(fmt::format("the inertia of {} has a principal moment of 0, which no body has", body),
              "leave <inertial> out, so that its geoms say, or state three moments above 0");
        continue;
      }
      if (reach_m == 0 || *most <= mass_kg * reach_m * reach_m) continue;
      Wrong(fmt::format("the inertia of {}, {} kg m2, is more than {} kg can have within its shape",
                        body, NumberText(*most), NumberText(mass_kg)),
            fmt::format("leave <inertial> out, so that its geoms say, or state at most {} kg m2",
                        NumberText(mass_kg * reach_m * reach_m)));
    }
  }

  void Motors() {
    const RobotSpec& spec = check_.spec;
    const double left_n = check_.stall_force_n - check_.drive.rolling_n;
    const double asked_n = spec.mass_kg * spec.max_accel_mps2;
    if (left_n <= 0) {
      Wrong(fmt::format("the motors cannot move it: stalled they push {} N, rolling friction takes "
                        "{} N",
                        NumberText(check_.stall_force_n), NumberText(check_.drive.rolling_n)),
            "raise the stall torque, or lower frictionloss and the casters' friction");
      return;
    }
    if (left_n < asked_n)
      Wrong(fmt::format("the motors push {} N beyond rolling friction, and max_accel_mps2 asks for "
                        "{} N",
                        NumberText(left_n), NumberText(asked_n)),
            fmt::format("lower it to {} m/s2, or raise the stall torque",
                        NumberText(left_n / spec.mass_kg, 2)));
    const double grip_n = kFriction * check_.drive.driven_share * spec.mass_kg * kGravity_mps2;
    if (grip_n < asked_n + check_.drive.rolling_n)
      Wrong(fmt::format("the driven wheels carry {} of the weight and grip with {} N on friction "
                        "{}; max_accel_mps2 and rolling ask for {} N",
                        PercentText(check_.drive.driven_share), NumberText(grip_n), kFriction,
                        NumberText(asked_n + check_.drive.rolling_n)),
            "move the masses to the driven wheels, or lower max_accel_mps2");
    if (spec.max_speed_mps > check_.top_speed_mps)
      Wrong(fmt::format("max_speed_mps {} is more than the motors reach, {} m/s",
                        NumberText(spec.max_speed_mps), NumberText(check_.top_speed_mps)),
            "lower it, or raise the motors' speed without load");
    if (check_.top_yaw_radps > 0 && spec.max_yaw_rate_radps > check_.top_yaw_radps)
      Wrong(fmt::format("max_yaw_rate_radps {} is more than the motors reach, {} rad/s",
                        NumberText(spec.max_yaw_rate_radps), NumberText(check_.top_yaw_radps)),
            "lower it, or raise the motors' speed without load");
  }

  void Balance() {
    const RobotSpec& spec = check_.spec;
    const double leans_rad = std::atan(spec.max_accel_mps2 / kGravity_mps2);
    constexpr double kFew_rad = 5 * kDegree;
    if (spec.static_tip_rad < leans_rad)
      Wrong(fmt::format("at max_accel_mps2 it goes over an edge of its support: it tips at {:.1f} "
                        "deg, which {} m/s2 is worth",
                        spec.static_tip_rad / kDegree,
                        NumberText(kGravity_mps2 * std::tan(spec.static_tip_rad), 2)),
            "lower max_accel_mps2 or the masses, or widen the support");
    else if (spec.static_tip_rad < kFew_rad)
      Note(fmt::format("it tips at {:.1f} deg", spec.static_tip_rad / kDegree),
           "lower the masses, or widen the support");
  }

  void Limits() {
    const RobotSpec& spec = check_.spec;
    if (spec.step_m > spec.clearance_m)
      Wrong(fmt::format("step_m {} is more than the belly's clearance, {}", LengthText(spec.step_m),
                        LengthText(spec.clearance_m)),
            "it would hang on such a step; lower step_m");
    if (!spec.measured.why_unused.empty())
      Note(fmt::format("the limits measured by {} are not used: {}", spec.measured.by,
                       spec.measured.why_unused),
           "measure them again with --ladder");
    else if (!spec.measured.limits.empty() && !spec.measured.hashed)
      Note(fmt::format("the limits measured by {} come without measured_figures: whether they were "
                       "edited since cannot be told",
                       spec.measured.by),
           "measure them again with --ladder");
    if (!check_.stance.lidar_z_m)
      Note("no site named `lidar`", "say where the scan plane is, or set sensors.lidar.z_m");
  }

  // A rigid base with its axle between casters stands on the casters where the floor bends. With
  // the front caster on a ramp and the axle at its foot, the axle hangs a b / (a + b) times the
  // slope over the floor (a, b: from the axle to the casters).
  void RigidBetweenCasters(const RobotModel& robot) {
    constexpr double kAxle_m = 0.01, kRamp = 1.0 / 12;
    const ModelPtr model = CompileAlone(robot);
    const mjModel* m = model.get();
    if (std::any_of(m->jnt_stiffness, m->jnt_stiffness + m->njnt, [](mjtNum k) { return k > 0; }))
      return;
    double front_m = 0, rear_m = 0;
    for (const Carrier& carrier : check_.stance.carriers) {
      if (carrier.driven && std::abs(carrier.p_B.x()) > kAxle_m) return;  // several axles
      if (carrier.driven || carrier.p_B.z() > kGap_m) continue;
      front_m = std::max(front_m, carrier.p_B.x());
      rear_m = std::max(rear_m, -carrier.p_B.x());
    }
    const double hangs_m = kRamp * front_m * rear_m / std::max(front_m + rear_m, kGap_m);
    if (hangs_m <= kGap_m) return;
    Note(fmt::format(
             "its driven axle is between casters and the base has no suspension: at the foot of a "
             "1:12 ramp the driven wheels are {} above the floor",
             LengthText(hangs_m)),
         "add springs to the wheels (for a URDF: --set sprung_share=...), or leave a gap under the "
         "front or the rear casters");
  }

  void TurnsAboutItsLoad() {
    if (!check_.drive.turns_about_m) return;
    const double about_m = *check_.drive.turns_about_m;
    Note(fmt::format("it turns about a point {} {} the middle of its wheels, towards its centre of "
                     "mass: wheels that carry less load slip more",
                     LengthText(std::abs(about_m)), about_m > 0 ? "ahead of" : "behind"),
         "allow that much more room for turns, or move the centre of mass to the middle of the "
         "wheels");
  }

  void DriveRows() {
    for (const LawRow& row : check_.drive.rows) {
      if (row.ok()) continue;
      const bool way = row.law == "straight/way", yaw = row.law == "turn/yaw";
      Wrong(fmt::format("{}: {} {}, expected {} within {}", row.law, NumberText(row.measured),
                        row.unit, NumberText(row.expected), NumberText(row.tolerance)),
            way   ? check_.drive.straight_hint
            : yaw ? check_.drive.turn_hint
                  : HintOf(row.law));
    }
  }

 private:
  static std::string HintOf(const std::string& law) {
    struct Hint {
      std::string_view law, text;
    };
    static constexpr Hint kHints[] = {
        {"stand/drift", "it does not stand still; look for wheels in the floor or one another"},
        {"stand/tilt", "it leans as it stands; wheels and casters must all reach the floor, z = 0"},
        {"straight/aside", "its way bends; wheels, masses and casters left and right must match"},
        {"straight/yaw", "its way bends; wheels, masses and casters left and right must match"},
        {"brake/way",
         "it brakes otherwise than max_accel_mps2 says; motors or grip do not suffice"},
        {"brake/rest",
         "it does not come to rest; the driver's gain may be too high for the wheel's "
         "armature, or wheels slip"},
        {"turn/off_the_spot", "the frame `base` should lie below the middle of the axle"},
        {"halt/rest",
         "it does not come to rest; the driver's gain may be too high for the wheel's "
         "armature, or wheels slip"},
    };
    const auto hint = std::ranges::find(kHints, law, &Hint::law);
    return hint == std::end(kHints) ? "" : std::string(hint->text);
  }

  RobotCheck& check_;
};

}  // namespace

void AddFindings(const RobotModel& robot, RobotCheck& check) {
  Findings findings(check);
  findings.Carriers();
  findings.Inertias(robot);
  findings.Motors();
  findings.Balance();
  findings.Limits();
  findings.DriveRows();
  findings.TurnsAboutItsLoad();
  findings.RigidBetweenCasters(robot);
}

}  // namespace floorproof
