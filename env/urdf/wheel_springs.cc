// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/wheel_springs.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kGravity_mps2 = 9.81;
constexpr double kDamping = 0.45;  // of the critical one, with the mass that the spring carries
constexpr double kLeast = 0.05;    // of its even share, what a spring carries at least

Vec3 CentreOfMass(const UrdfRobot& robot) {
  MassOf all = robot.base;
  for (const UrdfWheel& wheel : robot.wheels) all += wheel.mass;
  for (const UrdfCaster& caster : robot.casters) {
    all += caster.wheel.mass;
    all += caster.fork;
  }
  return all.com_M;
}

}  // namespace

std::vector<WheelSpring> WheelSprings(const UrdfRobot& robot, const SpringAnswers& answers) {
  const double n = static_cast<double>(robot.wheels.size());
  const double share = robot.casters.empty() ? 1 : answers.share;
  const double on_springs_n = share * robot.mass_kg() * kGravity_mps2;
  Vec3 mean = Vec3::Zero(), squares = Vec3::Zero();
  for (const UrdfWheel& wheel : robot.wheels) mean += wheel.p_B / n;
  for (const UrdfWheel& wheel : robot.wheels) squares += (wheel.p_B - mean).cwiseAbs2();
  const Vec3 off = CentreOfMass(robot) - mean;
  std::vector<WheelSpring> springs;
  for (const UrdfWheel& wheel : robot.wheels) {
    constexpr double kSame_m2 = 1e-6;  // wheels on one axle
    double load_n = on_springs_n / n;
    for (const int axis : {0, 1})
      if (squares[axis] > kSame_m2)
        load_n += on_springs_n * off[axis] * (wheel.p_B - mean)[axis] / squares[axis];
    // The wheel itself stands on the floor.
    load_n = std::max(load_n - wheel.mass.mass_kg * kGravity_mps2, kLeast * on_springs_n / n);
    WheelSpring spring;
    spring.travel_m = answers.travel_m;
    spring.stiffness_npm = (1 - answers.preload) * load_n / spring.travel_m;
    spring.slack_m = -load_n / spring.stiffness_npm;
    spring.damping_nspm = 2 * kDamping * std::sqrt(spring.stiffness_npm * load_n / kGravity_mps2);
    springs.push_back(spring);
  }
  return springs;
}

}  // namespace floorproof
