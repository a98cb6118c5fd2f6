// SPDX-License-Identifier: Apache-2.0
// The figures of docs/real-robots.md, found again to the last digit that it prints.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "tests/places.h"
#include "tests/real_robots/measured_figures.h"
#include "tests/real_robots/real_robots.h"
#include "validate/climb.h"
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

// Loaded robots are driven no faster.
constexpr double kLoaded_mps = 0.3;

std::string Text(const FoundLimit& limit) {
  return fmt::format("{}{}", limit.size, limit.above_all ? " or more" : "");
}

const RealRobot& RobotCalled(std::string_view name) {
  return *std::ranges::find(RealRobots(), name, &RealRobot::name);
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
    return both({}, factor == 0 ? std::string("sprung_share: 0, spring_travel_m: none")
                                : fmt::format("spring_travel_m: {}", factor * travel_m));
  };
  EXPECT_THAT(Page(), HasSubstr(fmt::format(
                          "| {} | {} | {} | {} | {} | {} | {} |\n", robot().name,
                          both({.friction = 0.6}, ""), both({.friction = 1.0}, ""),
                          both({.oblique_deg = 3}, ""), sprung(0), sprung(0.5), sprung(2))));
}

// An assumption about what makers do not publish. Springs of driven wheels between casters: as the
// answers say, with half and twice the travel, with nearly constant force, and, loaded, those made
// for the robot without its load. Motors: as the answers say, and twice as strong.
struct Assumption {
  const char* name;
  double travel_factor = 1, preload = 0;
  bool springs_for_load = true;
  double motors = 1;
};
constexpr Assumption kAsAssumed = {"as assumed"};
constexpr Assumption kSprings[] = {{"half the travel", 0.5},
                                   {"twice the travel", 2},
                                   {"constant force", 1, 0.9},
                                   {"springs of the empty robot", 1, 0, false}};
constexpr Assumption kStrongMotors = {"motors twice as strong", 1, 0, true, 2};

std::vector<Assumption> AssumptionsFor(const RealRobot& robot) {
  std::vector<Assumption> all = {kAsAssumed};
  const double share = AnswersOf(robot).sprung_share;
  if (share > 0 && share < 1) all.insert(all.end(), std::begin(kSprings), std::end(kSprings));
  if (!robot.motor_data) all.push_back(kStrongMotors);
  return all;
}

std::filesystem::path FileOf(const RealRobot& robot, const Assumption& assumed, Load load) {
  const UrdfAnswers answers = AnswersOf(robot);
  // Neither a payload nor a stronger motor changes rotors and bearings.
  const ModelPtr empty_robot = CompileAlone(ReadRobot(MjcfFile(robot)));
  const int dof = empty_robot->jnt_dofadr[empty_robot->actuator_trnid[0]];
  std::string more =
      fmt::format("armature_kgm2: {}, friction_nm: {}", empty_robot->dof_armature[dof],
                  empty_robot->dof_frictionloss[dof]);
  if (answers.sprung_share > 0) {
    const double empty = robot.mass_kg / (robot.mass_kg + robot.payload_kg);
    const double share =
        answers.sprung_share * (load == Load::kRated && !assumed.springs_for_load ? empty : 1);
    more += fmt::format(", sprung_share: {}, spring_travel_m: {}, spring_preload: {}", share,
                        assumed.travel_factor * *answers.spring_travel_m, assumed.preload);
  }
  if (assumed.motors != 1)
    more += fmt::format(", stall_nm: {}, peak_nm: {}", assumed.motors * *answers.stall_nm,
                        assumed.motors * answers.peak_nm.value_or(*answers.stall_nm));
  return MjcfFile(robot, more, load);
}

// Which loads the maker's limit holds for.
bool StatedLimitCovers(const RealRobot& robot, Load load) {
  return load == Load::kNone || !robot.stated_unloaded;
}

// The prediction of a maker's limit: the range over everything that is not published.
class Prediction {
 public:
  // Found at one speed on one friction; `base`: creeping on friction 0.8.
  void Add(const FoundLimit& limit, Load load, bool base) {
    least_ = std::min(least_, limit.size);
    greatest_ = std::max(greatest_, limit.size);
    if (!base) return;
    auto& [low, high] = base_[static_cast<std::size_t>(load)];
    low = std::min(low, limit.size);
    high = std::max(high, limit.size);
  }
  std::string Row(const RealRobot& robot) const {
    const std::string row =
        fmt::format("| {} | {} {:.0f}{} | {} to {} |", robot.name, robot.stated_as, robot.stated_mm,
                    robot.stated_unloaded ? ", no load" : "", least_, greatest_);
    // Unknown where what is not published moves the limit by more than a half.
    for (const auto& [low, high] : base_)
      if (high > 1.5 * low) return row + " unknown | - |\n";
    const double middle = std::sqrt(least_ * greatest_);
    return row +
           fmt::format(" {:.1f} | {:+.0f} % |\n", middle, 100 * (middle / robot.stated_mm - 1));
  }

 private:
  double least_ = kNone, greatest_ = 0;
  std::array<std::pair<double, double>, 2> base_ = {{{kNone, 0}, {kNone, 0}}};  // by load
  static constexpr double kNone = std::numeric_limits<double>::infinity();
};

// Without a load and with the rated one: creeping and at 0.3 m/s, on friction 0.8 and 1.0 each.
TEST_P(RealRobotStudy, ThePageHasItsStepsWithALoad) {
  Prediction prediction;
  for (const Assumption& assumed : AssumptionsFor(robot())) {
    std::string row = fmt::format("| {} | {} |", robot().name, assumed.name);
    for (const Load load : {Load::kNone, Load::kRated}) {
      if (load == Load::kNone && !assumed.springs_for_load) {
        row += " | |";
        continue;
      }
      const auto file = FileOf(robot(), assumed, load);
      for (const double speed_mps : {kCreep_mps, std::min(kLoaded_mps, robot().top_mps)}) {
        std::string both;
        for (const double friction : {0.8, 1.0}) {
          const FoundLimit limit =
              LimitOf(file, robot().stated_as, {.speed_mps = speed_mps, .friction = friction});
          both += (both.empty() ? " " : ", ") + Text(limit);
          if (StatedLimitCovers(robot(), load))
            prediction.Add(limit, load, speed_mps == kCreep_mps && friction == 0.8);
        }
        row += both + " |";
      }
    }
    EXPECT_THAT(Page(), HasSubstr(row + "\n"));
  }
  if (robot().stated_mm == 0) return;
  EXPECT_THAT(Page(), HasSubstr(prediction.Row(robot())));
}

// What was measured to find why figures differ from what the makers state.
TEST(RealRobotReasons, ThePageHasThem) {
  const auto file = [](std::string_view name) { return MjcfFile(RobotCalled(name)); };
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
    const RealRobot& robot = RobotCalled(name);
    const double step_mm = LimitOf(MjcfFile(robot), "step", {.speed_mps = robot.top_mps}).size;
    EXPECT_GT(step_mm, below_mm) << name;
    below_mm = step_mm;
  }
}

// As the law edge_speed for bundled robots: half the time step moves a limit by 5 % at most.
TEST(RealRobotSteps, DoNotDependOnTheTimeStep) {
  for (const char* name : {"kobuki", "nova_carter", "scout_mini"}) {
    const RealRobot& robot = RobotCalled(name);
    const std::string file = MjcfFile(robot).string();
    for (const double speed_mps : {0.1, 0.3, 0.6, 1.0}) {
      if (speed_mps > robot.top_mps) continue;
      const double fine_m = HighestStep(file, speed_mps, {.timestep_s = 0.002});
      EXPECT_NEAR(HighestStep(file, speed_mps, {}), fine_m, 0.05 * fine_m) << name << speed_mps;
    }
  }
}

}  // namespace
}  // namespace floorproof
