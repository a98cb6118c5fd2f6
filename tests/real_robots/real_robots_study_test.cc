// SPDX-License-Identifier: Apache-2.0
// The figures of docs/real-robots.md, found again to the last digit that it prints.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/places.h"
#include "tests/real_robots/measured_figures.h"
#include "tests/real_robots/real_robots.h"
#include "validate/robot_check.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

const std::string& Page() {
  static const std::string page = [] {
    std::ifstream in(SourceFile("docs/real-robots.md"));
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return page;
}

std::string Text(const FoundLimit& limit) {
  return fmt::format("{}{}", limit.size, limit.above_all ? " or more" : "");
}

class RealRobotStudy : public ::testing::TestWithParam<RealRobot> {
 protected:
  const RealRobot& robot() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Robots, RealRobotStudy, ::testing::ValuesIn(RealRobots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

TEST_P(RealRobotStudy, ThePageHasItsFigures) {
  const auto file = MjcfFile(robot());
  const RobotCheck check = CheckRobot(file.string());
  const double cruise_mps = check.spec.cruise_mps;
  const auto limit = [&](const char* hazard, double speed_mps) {
    return LimitOf(file, hazard, {.speed_mps = speed_mps});
  };
  const double power_w = DrivingPower(file, {cruise_mps, 0, 0});
  EXPECT_THAT(
      Page(),
      HasSubstr(fmt::format(
          "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1f} | {} |\n", robot().name,
          robot().top_mps, Text(limit("step", kCreep_mps)), Text(limit("step", robot().top_mps)),
          Text(limit("threshold", kCreep_mps)), Text(limit("threshold", robot().top_mps)),
          Text(limit("groove", cruise_mps)), Text(limit("ramp", kSlow * robot().top_mps)),
          robot().motor_data ? fmt::format("{:.2f}", check.top_speed_mps) : "-", power_w,
          robot().battery_wh > 0 ? fmt::format("{:.1f}", robot().battery_wh / power_w) : "-")));
}

// How far the step that is climbed moves with one thing changed.
TEST_P(RealRobotStudy, ThePageSaysWhatMovesIt) {
  const auto both = [&](const Approach& approach, const std::string& more) {
    const auto file = MjcfFile(robot(), more);
    Approach creeping = approach, fast = approach;
    creeping.speed_mps = kCreep_mps;
    fast.speed_mps = robot().top_mps;
    return fmt::format("{}, {}", Text(LimitOf(file, "step", creeping)),
                       Text(LimitOf(file, "step", fast)));
  };
  const double travel_m = AnswersOf(robot()).spring_travel_m.value_or(0);
  const auto sprung = [&](double factor) {
    if (travel_m == 0) return std::string("-");
    return both({}, factor == 0 ? std::string("sprung_share: 0")
                                : fmt::format("spring_travel_m: {}", factor * travel_m));
  };
  EXPECT_THAT(Page(), HasSubstr(fmt::format(
                          "| {} | {} | {} | {} | {} | {} | {} |\n", robot().name,
                          both({.friction = 0.6}, ""), both({.friction = 1.0}, ""),
                          both({.oblique_deg = 3}, ""), sprung(0), sprung(0.5), sprung(2))));
}

// What was measured to find why figures differ from what the makers state.
TEST(RealRobotReasons, ThePageHasThem) {
  const auto file = [](std::string_view name) {
    return MjcfFile(*std::ranges::find(RealRobots(), name, &RealRobot::name));
  };
  for (const char* name : {"kobuki", "turtlebot3_burger", "turtlebot3_waffle_pi"})
    EXPECT_THAT(Page(),
                HasSubstr(fmt::format("{} {} mm", name,
                                      Text(LimitOf(file(name), "cable_cover_height", {})))));
  EXPECT_THAT(Page(), HasSubstr(fmt::format("on friction 1.0: {} deg",
                                            Text(LimitOf(file("husky"), "ramp",
                                                         {.speed_mps = 0.3, .friction = 1.0})))));
  const auto turning = [&](std::string_view name) {
    return fmt::format("{} {:.0f} W", name, DrivingPower(file(name), {0, 0, 1.5}));
  };
  for (const char* name : {"scout", "scout_mini", "husky"})
    EXPECT_THAT(Page(), HasSubstr(turning(name)));
  const RealRobot& kobuki = RealRobots().front();
  const std::string guess = "friction_nm: 0.0041";  // 0.01 of its weight at the rims
  EXPECT_THAT(Page(), HasSubstr(fmt::format("would make it {:.1f} W",
                                            DrivingPower(MjcfFile(kobuki, guess), {0.35, 0, 0}))));
}

// Of the steps that makers state the order is that of what physics climbs at speed.
TEST(RealRobotReasons, StatedStepsAreInPhysicsOrder) {
  double below_mm = 0;
  for (const char* name : {"turtlebot3_burger", "kobuki", "scout_mini", "scout"}) {
    const RealRobot& robot = *std::ranges::find(RealRobots(), name, &RealRobot::name);
    const double step_mm = LimitOf(MjcfFile(robot), "step", {.speed_mps = robot.top_mps}).size;
    EXPECT_GT(step_mm, below_mm) << name;
    below_mm = step_mm;
  }
}

}  // namespace
}  // namespace floorproof
