// SPDX-License-Identifier: Apache-2.0
#include "tests/real_robots/real_robots.h"

#include <fmt/format.h>

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
    {.name = "kobuki",
     .answers = "no_load_radps: 21.04, stall_nm: 4.19, peak_nm: 1.62, friction_nm: 0.114, "
                "max_speed_mps: 0.7, "
                "cruise_mps: 0.35, hotel_load_w: 3, sprung_share: 0.9, spring_travel_m: 0.01",
     .top_mps = 0.7,
     .mass_kg = 2.4,
     .battery_wh = 32.6,
     .motor_data = true,
     .stated_as = "threshold",
     .stated_mm = 12,
     .payload_kg = 5,
     .deck_x_m = 0,
     .deck_z_m = 0.124},
    {.name = "turtlebot3_burger",
     .answers = "no_load_radps: 6.388, stall_nm: 1.5, max_speed_mps: 0.2, cruise_mps: 0.1, "
                "hotel_load_w: 5",
     .top_mps = 0.2,
     .mass_kg = 1.0,
     .battery_wh = 19.98,
     .motor_data = true,
     .stated_as = "threshold",
     .stated_mm = 10,
     .payload_kg = 15,
     .deck_x_m = -0.032,
     .deck_z_m = 0.152},
    {.name = "turtlebot3_waffle_pi",
     .answers = "no_load_radps: 8.063, stall_nm: 3.0, max_speed_mps: 0.25, cruise_mps: 0.13, "
                "hotel_load_w: 6",
     .top_mps = 0.25,
     .mass_kg = 1.8,
     .battery_wh = 19.98,
     .motor_data = true,
     .stated_as = "threshold",
     .stated_mm = 10,
     .payload_kg = 30,
     .deck_x_m = -0.064,
     .deck_z_m = 0.104},
    {.name = "nova_carter",
     .answers = "motor_voltage_v: 48, no_load_radps: 10.3, stall_nm: 175, peak_nm: 58.3, "
                "max_speed_mps: 1.2, "
                "cruise_mps: 0.6, hotel_load_w: 60",
     .top_mps = 1.0,
     .mass_kg = 57.2,
     .stated_mm = 40,
     .payload_kg = 50,
     .deck_x_m = -0.25,
     .deck_z_m = 0.556},
    {.name = "mir250",
     .answers =
         "motor_voltage_v: 48, no_load_radps: 24, stall_nm: 60, peak_nm: 20, max_speed_mps: 2, "
         "cruise_mps: 1, hotel_load_w: 60, sprung_share: 0.5, spring_travel_m: 0.01",
     .top_mps = 1.0,
     .mass_kg = 94,
     .payload_kg = 250,
     .deck_x_m = -0.0045,
     .deck_z_m = 0.3},
    {.name = "tracer",
     .answers = "motor_voltage_v: 24, no_load_radps: 29.8, stall_nm: 36.3, peak_nm: 12.1, "
                "max_speed_mps: 1.5, "
                "cruise_mps: 0.75, hotel_load_w: 15, sprung_share: 0.5, spring_travel_m: 0.008",
     .top_mps = 1.0,
     .mass_kg = 30,
     .battery_wh = 360,
     .stated_mm = 10,
     .stated_unloaded = true,
     .payload_kg = 100,
     .deck_x_m = 0,
     .deck_z_m = 0.1635},
    {.name = "scout",
     .answers = "motor_voltage_v: 24, no_load_radps: 10.9, stall_nm: 263, peak_nm: 87.8, "
                "friction_nm: 0.55, "
                "max_speed_mps: 1.5, cruise_mps: 0.75, hotel_load_w: 15, sprung_share: 1, "
                "spring_travel_m: 0.03",
     .top_mps = 1.0,
     .mass_kg = 68,
     .battery_wh = 720,
     .stated_mm = 150,
     .stated_unloaded = true,
     .payload_kg = 50,
     .deck_x_m = 0,
     .deck_z_m = 0.349},
    {.name = "scout_mini",
     .answers = "motor_voltage_v: 24, no_load_radps: 40.5, stall_nm: 26.7, peak_nm: 8.9, "
                "friction_nm: 0.1, "
                "max_speed_mps: 2.7, cruise_mps: 1.35, hotel_load_w: 15, sprung_share: 1, "
                "spring_travel_m: 0.015",
     .top_mps = 1.0,
     .mass_kg = 26,
     .battery_wh = 360,
     .stated_mm = 70,
     .stated_unloaded = true,
     .payload_kg = 10,
     .deck_x_m = 0,
     .deck_z_m = 0.245},
    {.name = "husky",
     .answers =
         "motor_voltage_v: 24, no_load_radps: 7.27, stall_nm: 198, peak_nm: 66, friction_nm: 0.4, "
         "max_speed_mps: 1, max_yaw_rate_radps: 1.5, cruise_mps: 0.5, hotel_load_w: 20, "
         "sprung_share: 1, spring_travel_m: 0.005",
     .top_mps = 1.0,
     .mass_kg = 50,
     .battery_wh = 480,
     .payload_kg = 75,
     .deck_x_m = 0,
     .deck_z_m = 0.39},
    {.name = "ridgeback",
     .answers = "roller_radius_m: 0.014, motor_voltage_v: 24, no_load_radps: 17.4, stall_nm: 82.8, "
                "peak_nm: 27.6, max_speed_mps: 1.1, max_yaw_rate_radps: 1.5, cruise_mps: 0.55, "
                "hotel_load_w: 60, sprung_share: 1, spring_travel_m: 0.005",
     .top_mps = 1.0,
     .mass_kg = 135,
     .battery_wh = 2400,
     .payload_kg = 100,
     .deck_x_m = 0,
     .deck_z_m = 0.311},
};

std::string TextOf(const RealRobot& robot) {
  std::ifstream in(SourceFile("models/others") / (std::string(robot.name) + ".urdf"));
  return {std::istreambuf_iterator<char>(in), {}};
}

// With a box of 0.3 x 0.3 x 0.2 m that weighs its payload.
std::string LoadedTextOf(const RealRobot& robot) {
  constexpr double kHalfHeight_m = 0.1;
  const std::string load = fmt::format(
      "<link name=\"payload\"><inertial><mass value=\"{0}\"/><inertia ixx=\"{1}\" iyy=\"{1}\" "
      "izz=\"{2}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
      "<joint name=\"payload_joint\" type=\"fixed\"><parent link=\"base_link\"/>"
      "<child link=\"payload\"/><origin xyz=\"{3} 0 {4}\"/></joint>\n",
      robot.payload_kg, robot.payload_kg * 0.13 / 12, robot.payload_kg * 0.18 / 12, robot.deck_x_m,
      robot.deck_z_m + kHalfHeight_m);
  std::string text = TextOf(robot);
  return text.insert(text.rfind("</robot>"), load);
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

std::filesystem::path MjcfFile(const RealRobot& robot, const std::string& more, Load load) {
  return ConvertedFile(load == Load::kRated ? LoadedTextOf(robot) : TextOf(robot),
                       AnswersOf(robot, more));
}

std::filesystem::path GuessedMjcfFile(const RealRobot& robot) {
  return ConvertedFile(TextOf(robot));
}

}  // namespace floorproof
