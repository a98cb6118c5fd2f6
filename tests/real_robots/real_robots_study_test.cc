// SPDX-License-Identifier: Apache-2.0
// The figures of docs/real-robots.md, found again to the last digit that it prints.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/real_robots/measured_figures.h"
#include "tests/real_robots/real_robots.h"
#include "validate/robot_check.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

const std::string& Page() {
  static const std::string page = [] {
    std::ifstream in(FP_SOURCE_DIR "/docs/real-robots.md");
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  return page;
}

std::string Text(const MeasuredLimit& limit) {
  return fmt::format("{}{}", limit.size, limit.above_all ? " or more" : "");
}

class RealRobotStudy : public ::testing::TestWithParam<RealRobot> {
 protected:
  const RealRobot& robot() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(Robots, RealRobotStudy, ::testing::ValuesIn(RealRobots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

// A step that the body meets before any wheel is none that it climbs; what a fast robot's soft
// contact lifts it over does not count (the page says why).
TEST_P(RealRobotStudy, ThePageHasItsFigures) {
  const auto file = MjcfFile(robot());
  const RobotCheck check = CheckRobot(file.string());
  const double cruise_mps = check.spec.cruise_mps;
  const auto limit = [&](const char* hazard, double speed_mps) {
    return LimitOf(file, hazard, {.speed_mps = speed_mps});
  };
  const MeasuredLimit step = limit("step", robot().top_mps);
  const double edge_mm = 1000 * robot().leading_edge_m;
  const double predicted = edge_mm > 0 ? std::min(edge_mm, step.size) : step.size;
  const double power_w = DrivingPower(file, cruise_mps);
  EXPECT_THAT(
      Page(),
      HasSubstr(fmt::format(
          "| {} | {} | {} | {} | **{}** | {} | {} | {} | {} | {} | {:.1f} | {} |\n", robot().name,
          robot().top_mps, Text(limit("step", kCreep_mps)), Text(step), predicted,
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

}  // namespace
}  // namespace floorproof
