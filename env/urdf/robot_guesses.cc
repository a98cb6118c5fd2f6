// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/robot_guesses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/quantity.h"
#include "env/core/robot_spec.h"
#include "env/scene/tyre.h"
#include "env/urdf/round_fit.h"

namespace floorproof {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr std::string_view kGuess = "guess: ";

// In three digits, as a guess deserves.
double Rounded(double value) {
  if (!(value > 0)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return std::round(value / unit) * unit;
}

Figure Take(const std::optional<double>& answer, double guess, const std::string& why) {
  if (answer) return {*answer, "given"};
  return {Rounded(guess), std::string(kGuess) + why};
}

// Plain wheels on several axles slide sideways whenever the robot turns.
double Wheelbase(const UrdfRobot& robot) {
  const auto [rear, front] =
      std::ranges::minmax(robot.wheels, {}, [](const UrdfWheel& wheel) { return wheel.p_B.x(); });
  return front.p_B.x() - rear.p_B.x();
}
bool Scrub(const UrdfRobot& robot) {
  constexpr double kAxle_m = 0.01;
  return Wheelbase(robot) > kAxle_m && robot.wheels.front().roller_radius_m == 0;
}

struct Sizes {
  double radius_m = 0, half_track_m = 0, width_m = 0, belly_m = 0;
};

Sizes SizesOf(const UrdfRobot& robot) {
  Sizes sizes;
  sizes.belly_m = std::numeric_limits<double>::infinity();
  double right_m = 0, left_m = 0;
  const auto hold = [&](double y_m) {
    right_m = std::min(right_m, y_m);
    left_m = std::max(left_m, y_m);
  };
  for (const UrdfWheel& wheel : robot.wheels) {
    sizes.radius_m = std::max(sizes.radius_m, wheel.radius_m);
    sizes.half_track_m = std::max(sizes.half_track_m, std::abs(wheel.p_B.y()));
    hold(wheel.p_B.y());
  }
  for (const UrdfShape& shape : robot.shapes) {
    if (!shape.collides) continue;
    sizes.belly_m = std::min(sizes.belly_m, BoundsOf(shape).min().z());
    for (const Vec3& p : shape.Points()) hold(p.y());
  }
  sizes.width_m = left_m - right_m;
  return sizes;
}

// A URDF's limits are often placeholders: what no floor robot has is not believed.
bool IsBelievable(double value, double low, double high) { return value >= low && value <= high; }
// That it was not, to go behind a guess's reason; 0: the URDF states none.
std::string NotBelieved(const char* limit, double value, const char* unit) {
  if (!(value > 0)) return "";
  const std::string figure =
      std::isfinite(value) ? fmt::format("{:g} {}", value, unit) : "which is infinite";
  return fmt::format("; the URDF's {} limit, {}, is no floor robot's", limit, figure);
}

Figure NoLoad(const UrdfWheel& wheel, const UrdfAnswers& answers, double radius_m) {
  constexpr double kUsual_mps = 0.8, kDroop = 1.1;
  if (answers.no_load_radps) return {*answers.no_load_radps, "given"};
  if (answers.top_speed_mps)
    return {Rounded(kDroop * *answers.top_speed_mps / radius_m),
            "guess: a tenth more than the top_speed_mps given"};
  if (IsBelievable(wheel.velocity_radps * radius_m, 0.1, 4))
    return {wheel.velocity_radps, "guess: the velocity limit that the URDF gives the joint"};
  return {Rounded(kUsual_mps / radius_m),
          "guess: 0.8 m/s, as indoor robots have" +
              NotBelieved("velocity", wheel.velocity_radps, "rad/s")};
}

Figure Stall(const UrdfRobot& robot, const UrdfAnswers& answers, double weight_n, double radius_m) {
  const UrdfWheel& wheel = robot.wheels.front();
  const double wheels = static_cast<double>(robot.wheels.size());
  // Of the weight, at the rims of all wheels. A skid-steer's slide as it turns, on friction 0.8 and
  // at speeds where a motor gives half its stall torque, and drivers droop.
  const bool scrub = Scrub(robot);
  const double push = scrub ? 3 : 0.4;
  if (answers.stall_nm) return {*answers.stall_nm, "given"};
  // Geared servos on small wheels can push with far more than the weight. They give some 60 N m per
  // kg of their own, and are no more than a quarter of a robot; larger robots have none.
  constexpr double kServo_nmpkg = 15, kServos_kg = 5;
  const double weight_nm = weight_n * radius_m;  // pushes with it
  if (IsBelievable(wheel.effort_nm * wheels, 0.1 * weight_nm,
                   std::max(4 * weight_nm, kServo_nmpkg * std::min(robot.mass_kg(), kServos_kg))))
    return {wheel.effort_nm, "guess: the effort limit that the URDF gives the joint"};
  return {Rounded(push * weight_n * radius_m / wheels),
          "guess: stalled, all motors push with " + NumberText(push) +
              (scrub ? " times the weight, as wheels that slide in turns take" : " of the weight") +
              NotBelieved("effort", wheel.effort_nm, "N m")};
}

double Most(const RobotGuesses& guesses) {
  return std::min(guesses.stall_nm.value, guesses.peak_nm.value_or(guesses.stall_nm.value));
}

void GuessMotors(const UrdfRobot& robot, const UrdfAnswers& answers, const Sizes& sizes,
                 RobotGuesses& out) {
  constexpr double kRolling = 0.01, kRotor = 0.2;
  const double wheels = static_cast<double>(robot.wheels.size());
  const double weight_n = robot.mass_kg() * kGravity_mps2, r = sizes.radius_m;
  out.no_load_radps = NoLoad(robot.wheels.front(), answers, r);
  out.stall_nm = Stall(robot, answers, weight_n, r);
  out.peak_nm = answers.peak_nm;
  out.friction_nm =
      Take(answers.friction_nm, kRolling * weight_n * r / wheels, "0.01 of the weight at the rims");
  // A strong motor's rotor has more: alone it reaches its speed with a time constant of 5 to 50 ms.
  constexpr double kRotor_s = 0.02;
  out.armature_kgm2 =
      Take(answers.armature_kgm2,
           std::max(kRotor * robot.mass_kg() * r * r / wheels,
                    kRotor_s * out.stall_nm.value / out.no_load_radps.value),
           "rotor and gear, 0.2 of m r2 of its share of the mass, and at least 20 ms "
           "of stall torque over speed without load");
  constexpr double kStiff = 2;  // per rad/s
  out.driver_gain =
      Take({}, kStiff * Most(out), "all its torque 0.5 rad/s below the speed asked for");
}

// A wheel's rim speed over the yaw rate: half the track; with rollers at 45 degrees half the
// wheelbase more; where wheels slide, as the law `skid` (docs/validation.md) has it.
double TurningArm(const UrdfRobot& robot, const Sizes& sizes) {
  const double half_track_m = std::max(1e-3, sizes.half_track_m);
  const double half_base_m = Wheelbase(robot) / 2;
  return half_track_m + (Scrub(robot) ? half_base_m * half_base_m / half_track_m : half_base_m);
}

void GuessLimits(const UrdfRobot& robot, const UrdfAnswers& answers, const Sizes& sizes,
                 RobotGuesses& out) {
  constexpr double kReach = 0.85, kCruise = 0.6, kWheelShare = 0.7;
  constexpr double kMost_mps = 0.5, kUsual_mps2 = 0.5, kUsual_radps = 1.5;
  out.max_speed_mps = Take(answers.max_speed_mps, kReach * out.no_load_radps.value * sizes.radius_m,
                           "0.85 of the speed without load");
  out.cruise_mps = Take(answers.cruise_mps, std::min(kMost_mps, kCruise * out.max_speed_mps.value),
                        "0.6 of max_speed_mps, at most 0.5 m/s");
  const double push_n = static_cast<double>(robot.wheels.size()) * Most(out) / sizes.radius_m;
  out.max_accel_mps2 =
      Take(answers.max_accel_mps2, std::min(kUsual_mps2, push_n / robot.mass_kg() / 2),
           "as indoor robots have, at most half of what the motors can");
  const double spin_radps = kWheelShare * out.max_speed_mps.value / TurningArm(robot, sizes);
  out.max_yaw_rate_radps = Take(answers.max_yaw_rate_radps, std::min(kUsual_radps, spin_radps),
                                "as indoor robots have, at most 0.7 of what the wheels can");
  out.max_yaw_accel_radps2 =
      Take({}, 2 * out.max_yaw_rate_radps.value, "its yaw rate in half a second");
}

void GuessSprings(const UrdfRobot& robot, const UrdfAnswers& answers, const Sizes& sizes,
                  RobotGuesses& out) {
  if (answers.sprung_share == 0) {
    for (const auto& [key, answer] : {std::pair{"--set spring_travel_m", answers.spring_travel_m},
                                      {"--set spring_preload", answers.spring_preload}})
      if (answer) throw InputError({key, 0}, "", FormatDouble(*answer), "needs sprung_share");
    return;
  }
  constexpr double kTravel = 0.1;
  out.spring_travel_m =
      Take(answers.spring_travel_m, kTravel * sizes.radius_m, "a tenth of the wheel's radius");
  out.spring_preload = Take(answers.spring_preload, 0, "slack at the lower stop");
  out.springs = WheelSprings(
      robot, {answers.sprung_share, out.spring_travel_m.value, out.spring_preload.value});
}

Choice Choose(const std::string& given, std::string_view usual, const std::string& why) {
  if (!given.empty()) return {given, "given"};
  return {std::string(usual), std::string(kGuess) + why};
}

}  // namespace

RobotGuesses GuessRobot(const UrdfRobot& robot, const UrdfAnswers& answers) {
  const Sizes sizes = SizesOf(robot);
  RobotGuesses out;
  GuessMotors(robot, answers, sizes, out);
  GuessLimits(robot, answers, sizes, out);
  constexpr double kTool = 0.8, kStep = 0.1, kHotel_w = 10;
  out.tool_width_m = Take(answers.tool_width_m, kTool * sizes.width_m, "0.8 of its width");
  out.step_m = Take(answers.step_m, std::min(kStep * sizes.radius_m, sizes.belly_m / 2),
                    "a tenth of the wheel's radius, at most half the belly's clearance");
  out.standstill = Choose(answers.standstill, Name(UsualStandstill(robot.mass_kg())),
                          fmt::format("robots of more than {:g} kg have brakes, others have motors "
                                      "that hold their wheels' positions",
                                      kHeavyRobot_kg));
  out.tyre = Choose(answers.tyre, Name(kUsualTyre), "most robots' wheels are solid");
  out.caster = Choose(answers.caster, Name(kUsualCaster), "most casters have polyurethane wheels");
  out.hotel_load_w = Take(answers.hotel_load_w, kHotel_w, "a small computer and a lidar");
  GuessSprings(robot, answers, sizes, out);
  return out;
}

std::vector<std::string> Questions(const RobotGuesses& guesses) {
  const auto line = [](const std::string& key, const std::string& value, const std::string& why) {
    return fmt::format("{}{} {}, {} (--set {}=...)", kGuess, key, value, why.substr(kGuess.size()),
                       key);
  };
  struct Question {
    const char *key, *unit;
    const Figure& figure;
  };
  const Question questions[] = {{"no_load_radps", "rad/s", guesses.no_load_radps},
                                {"stall_nm", "N m", guesses.stall_nm},
                                {"friction_nm", "N m", guesses.friction_nm},
                                {"cruise_mps", "m/s", guesses.cruise_mps},
                                {"max_speed_mps", "m/s", guesses.max_speed_mps},
                                {"max_accel_mps2", "m/s2", guesses.max_accel_mps2},
                                {"max_yaw_rate_radps", "rad/s", guesses.max_yaw_rate_radps},
                                {"tool_width_m", "m", guesses.tool_width_m},
                                {"step_m", "m", guesses.step_m},
                                {"hotel_load_w", "W", guesses.hotel_load_w},
                                {"armature_kgm2", "kg m2", guesses.armature_kgm2},
                                {"spring_travel_m", "m", guesses.spring_travel_m},
                                {"spring_preload", "", guesses.spring_preload}};
  std::vector<std::string> lines;
  for (const Question& q : questions)
    if (q.figure.why.starts_with(kGuess))
      lines.push_back(
          line(q.key, NumberText(q.figure.value) + (*q.unit ? " " : "") + q.unit, q.figure.why));
  const std::pair<const char*, const Choice&> choices[] = {
      {"standstill", guesses.standstill}, {"tyre", guesses.tyre}, {"caster", guesses.caster}};
  for (const auto& [key, choice] : choices)
    if (choice.why.starts_with(kGuess)) lines.push_back(line(key, choice.value, choice.why));
  return lines;
}

}  // namespace floorproof
