// SPDX-License-Identifier: Apache-2.0
#include "tests/real_robots/real_robots.h"

#include <fstream>
#include <iterator>

#include "tests/places.h"
#include "tests/urdf/urdf_files.h"

namespace floorproof {
namespace {

// Motors whose data nobody states: the rated power at the top speed, the stall torque six times
// what that takes (so they are 83 % efficient there), the driver's limit twice that, the speed
// without load 1.2 times that at the top speed.
constexpr RealRobot kRobots[] = {
    {"kobuki",
     "no_load_radps: 21.04, stall_nm: 4.19, peak_nm: 1.62, friction_nm: 0.114, max_speed_mps: 0.7, "
     "cruise_mps: 0.35, hotel_load_w: 3, sprung_share: 0.9, spring_travel_m: 0.01",
     0.7, 2.4, 32.6, true},
    {"turtlebot3_burger",
     "no_load_radps: 6.388, stall_nm: 1.5, max_speed_mps: 0.2, cruise_mps: 0.1, hotel_load_w: 5",
     0.2, 1.0, 19.98, true},
    {"turtlebot3_waffle_pi",
     "no_load_radps: 8.063, stall_nm: 3.0, max_speed_mps: 0.25, cruise_mps: 0.13, hotel_load_w: 6",
     0.25, 1.8, 19.98, true},
    {"nova_carter",
     "motor_voltage_v: 48, no_load_radps: 10.3, stall_nm: 175, peak_nm: 58.3, max_speed_mps: 1.2, "
     "cruise_mps: 0.6, hotel_load_w: 60",
     1.0, 57.2, 0, false},
    {"mir250",
     "motor_voltage_v: 48, no_load_radps: 24, stall_nm: 60, peak_nm: 20, max_speed_mps: 2, "
     "cruise_mps: 1, hotel_load_w: 60, sprung_share: 0.5, spring_travel_m: 0.01",
     1.0, 94, 0, false},
    {"tracer",
     "motor_voltage_v: 24, no_load_radps: 29.8, stall_nm: 36.3, peak_nm: 12.1, max_speed_mps: 1.5, "
     "cruise_mps: 0.75, hotel_load_w: 15, sprung_share: 0.5, spring_travel_m: 0.008",
     1.0, 30, 360, false},
    {"scout",
     "motor_voltage_v: 24, no_load_radps: 10.9, stall_nm: 263, peak_nm: 87.8, friction_nm: 0.55, "
     "max_speed_mps: 1.5, cruise_mps: 0.75, hotel_load_w: 15, sprung_share: 1, "
     "spring_travel_m: 0.03",
     1.0, 68, 720, false},
    {"scout_mini",
     "motor_voltage_v: 24, no_load_radps: 40.5, stall_nm: 26.7, peak_nm: 8.9, friction_nm: 0.1, "
     "max_speed_mps: 2.7, cruise_mps: 1.35, hotel_load_w: 15, sprung_share: 1, "
     "spring_travel_m: 0.015",
     1.0, 26, 360, false},
    {"husky",
     "motor_voltage_v: 24, no_load_radps: 7.27, stall_nm: 198, peak_nm: 66, friction_nm: 0.4, "
     "max_speed_mps: 1, max_yaw_rate_radps: 1.5, cruise_mps: 0.5, hotel_load_w: 20, "
     "sprung_share: 1, spring_travel_m: 0.005",
     1.0, 50, 480, false},
    {"ridgeback",
     "roller_radius_m: 0.014, motor_voltage_v: 24, no_load_radps: 17.4, stall_nm: 82.8, "
     "peak_nm: 27.6, max_speed_mps: 1.1, max_yaw_rate_radps: 1.5, cruise_mps: 0.55, "
     "hotel_load_w: 60, sprung_share: 1, spring_travel_m: 0.005",
     1.0, 135, 2400, false},
};

std::string TextOf(const RealRobot& robot) {
  std::ifstream in(SourceFile("models/others") / (std::string(robot.name) + ".urdf"));
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::span<const RealRobot> RealRobots() { return kRobots; }

UrdfAnswers AnswersOf(const RealRobot& robot, const std::string& more) {
  UrdfAnswers answers;
  for (const std::string& keys : {std::string(robot.answers), more})
    ReadParams(ParseYaml("{" + keys + "}", "answers"), "",
               [&](ParamVisitor& v) { answers.Visit(v); });
  return answers;
}

std::filesystem::path MjcfFile(const RealRobot& robot, const std::string& more) {
  return ConvertedFile(TextOf(robot), AnswersOf(robot, more));
}

std::filesystem::path GuessedMjcfFile(const RealRobot& robot) {
  return ConvertedFile(TextOf(robot));
}

}  // namespace floorproof
