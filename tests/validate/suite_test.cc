// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "run/scenario/scenario_file.h"
#include "stats/binomial.h"
#include "validate/suite/bench_floor.h"
#include "validate/suite/method_search.h"
#include "validate/suite/robot_suite.h"

namespace floorproof {
namespace {

// Two runs without a failure.
SuiteOptions Quick(std::vector<Override> overrides = {}) {
  return {.reliability = 0.5, .confidence = 0.75, .jobs = 2, .overrides = std::move(overrides)};
}

MethodResult Tested(std::string_view method, const SuiteOptions& options,
                    const std::string& robot = "beluga") {
  const auto entry = std::ranges::find(Methods(), method, &PluginEntry<Method>::name);
  auto result = RunMethod(*entry, ReadRobot(FindRobotFile(robot, {})), robot, options, {});
  EXPECT_TRUE(result.has_value());
  return std::move(*result);
}

RobotModel Beluga() { return ReadRobot(FindRobotFile("beluga", {})); }

TEST(SuitePopulation, IsWithinWhatItSaysAndTheSameAgain) {
  std::set<double> frictions;
  for (int run = 0; run < 300; ++run) {
    const SuiteDraw draw = DrawRun(7, "step", run);
    EXPECT_GE(draw.friction, 0.6);
    EXPECT_LT(draw.friction, 1.0);
    EXPECT_GE(draw.mass_share, 0.9);
    EXPECT_LT(draw.mass_share, 1.1);
    EXPECT_LT(std::abs(draw.angle_rad), 3 * kPi / 180 + 1e-12);
    EXPECT_LE(std::abs(draw.offset_m), 0.03);
    EXPECT_GE(draw.speed_share, 0.8);
    EXPECT_LT(draw.speed_share, 1.0);
    EXPECT_EQ(draw.friction, DrawRun(7, "step", run).friction);
    EXPECT_NE(draw.friction, DrawRun(8, "step", run).friction);
    EXPECT_NE(draw.friction, DrawRun(7, "gap", run).friction);
    frictions.insert(draw.friction);
  }
  EXPECT_EQ(frictions.size(), 300u);
}

TEST(Methods, SayWhatTheyAreAndClimbFromEasyToHard) {
  const RobotModel robot = Beluga();
  std::set<std::string_view> names;
  for (const auto& entry : Methods()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    const auto method = entry.make();
    EXPECT_THAT(std::string(method->task()), ::testing::HasSubstr("Passed:")) << entry.name;
    EXPECT_FALSE(method->shaped_after().empty()) << entry.name;
    const auto sizes = method->sizes(robot);
    if (!sizes) continue;
    EXPECT_LT(sizes->rungs.first, sizes->rungs.last) << entry.name;
    const double easy = sizes->Size(sizes->rungs.first), hard = sizes->Size(sizes->rungs.last);
    EXPECT_GT(std::min(easy, hard), 0) << entry.name;
    EXPECT_TRUE(sizes->Reaches(hard, easy)) << entry.name;
    EXPECT_FALSE(sizes->Reaches(easy, hard)) << entry.name;
  }
}

// Each states a scenario that reads, at both ends of its ladder, for robots of either kind.
TEST(Methods, LayOutScenariosThatCanBeRead) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "Methods.LayOutScenarios";
  for (const RobotEntry& listed : Robots()) {
    const std::string name(listed.name);
    const RobotModel robot = ReadRobot(FindRobotFile(name, {}));
    for (const auto& entry : Methods()) {
      if (!entry.make()->WhyNot(robot).empty()) continue;
      const auto sizes = entry.make()->sizes(robot);
      for (const bool hard : {false, true}) {
        SuiteRun run{.run = 3, .draw = DrawRun(0, entry.name, 3)};
        if (sizes) run.size = sizes->Size(hard ? sizes->rungs.last : sizes->rungs.first);
        WriteRun(entry, robot, name, run, Quick(), folder);
        const Scenario scenario = ReadScenario(folder / kRunFile);
        EXPECT_EQ(scenario.world.site.map.floor_friction, run.draw.friction) << entry.name;
        EXPECT_NEAR(scenario.world.robot.spec.mass_kg, run.draw.mass_share * robot.spec.mass_kg,
                    1e-9);
        EXPECT_TRUE(scenario.world.site.warnings.empty())
            << entry.name << " " << scenario.world.site.warnings[0];
      }
    }
  }
  std::filesystem::remove_all(folder);
}

// What is set for every run stands in the scenario that a film's folder has.
TEST(Methods, ARunsScenarioHasWhatWasSet) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "Methods.HasWhatWasSet";
  SuiteOptions options = Quick();
  options.overrides = {{"site.floor.friction", "0.05"}, {"robot.mass_kg", "30"}};
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  const auto& entry = *std::ranges::find(Methods(), "step", &PluginEntry<Method>::name);
  const SuiteRun run{.run = 1, .size = 3, .draw = DrawRun(0, "step", 1)};
  WriteRun(entry, robot, "beluga", run, options, folder);
  const Scenario dut = ReadScenario(folder / kRunFile);
  EXPECT_EQ(dut.world.site.map.floor_friction, 0.05);
  EXPECT_NEAR(dut.world.robot.spec.mass_kg, 30, 1e-9);
  std::filesystem::remove_all(folder);
}

// It would touch nothing if it stood still.
TEST(Methods, WhoDoesNotDriveHasNotPassedAnObstacle) {
  SuiteOptions options = Quick();
  options.overrides = {{"time_limit_s", "1"}};
  EXPECT_GT(Tested("obstacle", options).failures, 0);
}

// Whatever finished first, the same runs in the same order; and the claim is what was driven.
TEST(Suite, AnyNumberOfJobsGivesTheSame) {
  SuiteOptions options = Quick();
  options.reliability = 0.7;  // four runs
  const MethodResult two = Tested("sill", options);
  options.jobs = 1;
  const MethodResult one = Tested("sill", options);
  ASSERT_EQ(one.runs.size(), two.runs.size());
  for (std::size_t i = 0; i < one.runs.size(); ++i) {
    EXPECT_EQ(one.runs[i].run, two.runs[i].run);
    EXPECT_EQ(one.runs[i].size, two.runs[i].size);
    EXPECT_EQ(one.runs[i].verdict.why, two.runs[i].verdict.why);
    EXPECT_EQ(one.runs[i].duration_s, two.runs[i].duration_s);
  }
  ASSERT_TRUE(one.size.has_value());
  EXPECT_EQ(one.size, two.size);
  EXPECT_EQ(one.n, 4);
  EXPECT_EQ(one.failures, 0);
  EXPECT_EQ(one.reliability_lower, ClopperPearsonLower(4, 4, options.confidence));
  // All four passed there, and one failed the next rung.
  const auto at = [&](double size, bool passed) {
    return std::ranges::count_if(one.runs, [&](const SuiteRun& run) {
      return run.size == size && run.verdict.passed == passed;
    });
  };
  EXPECT_EQ(at(*one.size, true), 4);
  EXPECT_EQ(at(*one.size, false), 0);
  EXPECT_EQ(at(*one.size + 1, false), 1);
  EXPECT_FALSE(one.runs[one.shown].verdict.passed);
  EXPECT_EQ(one.runs[one.shown].size, *one.size + 1);
}

// Who passes a size need not pass an easier one: a belly may hang on a low sill between two wheels
// that carry it over a high one. Here a verdict stands for that, behind drives of a moment.
class WithAWindow final : public Method {
 public:
  std::string_view shaped_after() const override { return ""; }
  std::string_view task() const override { return ""; }
  // Rungs at 1, 41 and 81: the climb steps over the window.
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"height", "mm", {.per_unit = 1, .first = 1, .spacing = 40, .last = 97}};
  }
  MethodDrive LayOut(const MethodRun& run) const override {
    return {BenchFloor(2, 2).Keys(run, {1, 1, 0}) + "time_limit_s: 0.02\n",
            StraightPlan({1, 1}, {1.5, 1}, 0.1)};
  }
  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord&) const override {
    if (run.size >= window.first && run.size <= window.second) return {false, "hangs"};
    if (run.size > 80) return {false, "stands before it"};
    return {true};
  }
  static std::pair<double, double> window;  // mm
};
std::pair<double, double> WithAWindow::window;

MethodResult TestedWithAWindow(double from_mm, double to_mm, int jobs = 2) {
  WithAWindow::window = {from_mm, to_mm};
  const PluginEntry<Method> entry{
      "window", "", [] { return std::unique_ptr<Method>(std::make_unique<WithAWindow>()); }};
  const SuiteOptions options{.reliability = 0.8, .confidence = 0.95, .jobs = jobs};
  return *RunMethod(entry, Beluga(), "beluga", options, {});
}

TEST(Suite, AFailureAtAnEasierSizeTakesTheClaimBack) {
  const MethodResult dut = TestedWithAWindow(26, 40);
  EXPECT_EQ(dut.size, 25);
  EXPECT_EQ(dut.withdrawn, 80);
  EXPECT_EQ(FailsAt(dut), 26);
  EXPECT_EQ(dut.failures, 0);
  EXPECT_EQ(dut.n, 14);
  EXPECT_FALSE(dut.above_all);
  EXPECT_GT(dut.easier, 0);
  EXPECT_EQ(dut.runs[dut.shown].verdict.why, "hangs");
  EXPECT_THAT(ResultSentence(dut, Quick()),
              ::testing::HasSubstr("It also fails at an easier size: 26 mm; so 80 mm, which all "
                                   "runs pass, does not count."));
  EXPECT_THAT(WhyMissed(dut, std::vector<SuiteRequirement>{{"window", 60}}),
              ::testing::HasSubstr("25 mm, 60 mm is required; also fails at an easier size: 26"));
  EXPECT_EQ(WhyMissed(dut, std::vector<SuiteRequirement>{{"window", 25}}), "");
  const MethodResult one = TestedWithAWindow(26, 40, 1);
  ASSERT_EQ(one.runs.size(), dut.runs.size());
  for (std::size_t i = 0; i < one.runs.size(); ++i)
    EXPECT_EQ(std::pair(one.runs[i].run, one.runs[i].size),
              std::pair(dut.runs[i].run, dut.runs[i].size));
}

// Down to the easiest of all, where nothing is left to claim.
TEST(Suite, AWindowAtTheEasiestSizeLeavesNothing) {
  const MethodResult dut = TestedWithAWindow(1, 30);
  EXPECT_FALSE(dut.size.has_value());
  EXPECT_EQ(dut.failures, dut.n);
  EXPECT_FALSE(dut.passed());
}

TEST(Suite, WithoutAWindowNothingIsTakenBack) {
  const MethodResult dut = TestedWithAWindow(0, 0);
  EXPECT_EQ(dut.size, 80);
  EXPECT_FALSE(dut.withdrawn.has_value());
  EXPECT_EQ(WithdrawnText(dut), "");
  EXPECT_EQ(FailsAt(dut), 81);
}

// No tenth of what is easier is left out, the slipperiest is among those asked, and none is asked
// twice.
TEST(Suite, EasierTriesAreSpreadOverWhatIsEasier) {
  std::vector<int> order(59);
  std::iota(order.rbegin(), order.rend(), 0);
  for (const int rung : {2, 7, 25, 101, 402}) {
    constexpr int kFirst = 1;
    const std::vector<Try> dut = EasierTries(kFirst, rung, order);
    EXPECT_EQ(dut.front().run, order.front());
    std::set<int> rungs = {kFirst - 1, rung}, runs;
    for (const Try& one : dut) {
      EXPECT_GE(one.rung, kFirst);
      EXPECT_LT(one.rung, rung);
      EXPECT_TRUE(runs.insert(one.run).second);
      rungs.insert(one.rung);
    }
    for (auto at = rungs.begin(); std::next(at) != rungs.end(); ++at)
      EXPECT_LE(*std::next(at) - *at, std::max(1.0, 0.1 * (rung - kFirst) + 1)) << rung;
  }
  EXPECT_TRUE(EasierTries(3, 3, order).empty());
  EXPECT_TRUE(EasierTries(3, 0, order).empty());
}

TEST(Suite, SaysAfterEachRunHowFarItIs) {
  int told = 0;
  const auto& entry = *std::ranges::find(Methods(), "step", &PluginEntry<Method>::name);
  const auto dut = RunMethod(entry, Beluga(), "beluga", Quick(), [&](const SuiteProgress& now) {
    EXPECT_EQ(now.driven_in_all, ++told);
    EXPECT_LE(now.driven, now.asked);
  });
  ASSERT_TRUE(dut.has_value());
  EXPECT_EQ(told, static_cast<int>(dut->runs.size()));
}

// What lies lower is caught by a lower belly.
TEST(Suite, ALowerBellyPassesNoHigherCover) {
  const MethodResult high = Tested("cable_cover", Quick());
  const MethodResult low = Tested("cable_cover", Quick({{"robot.clearance_m", "0.012"}}));
  ASSERT_TRUE(high.size && low.size);
  EXPECT_LT(*low.size, *high.size);
}

TEST(Suite, MoreFrictionClimbsNoSmallerRamp) {
  const MethodResult slippery = Tested("ramp", Quick({{"site.floor.friction", "0.3"}}));
  const MethodResult grippy = Tested("ramp", Quick({{"site.floor.friction", "0.9"}}));
  ASSERT_TRUE(slippery.size && grippy.size);
  EXPECT_GT(*grippy.size, *slippery.size);
  // It cannot hold where the floor holds nothing.
  EXPECT_LT(*slippery.size, std::atan(0.3) * 180 / kPi + 1);
}

TEST(Suite, ADeadMotorPassesNothing) {
  const std::vector<Override> dead = {
      {"faults", "[{type: weak_motor, wheel: wheel_left, torque_share: 0}]"}};
  const MethodResult sill = Tested("sill", Quick(dead));
  EXPECT_FALSE(sill.size.has_value());
  EXPECT_EQ(sill.failures, 2);
  EXPECT_EQ(sill.reliability_lower, 0);
  EXPECT_FALSE(sill.passed());
  EXPECT_NE(WhyMissed(sill, {}), "");
  // The override stands in place of the stop that it is told.
  const MethodResult stop = Tested("stopping_distance", Quick(dead));
  EXPECT_EQ(stop.failures, 2);
}

// v^2 / 2a is the least with brakes that hold; a control period and the wheels' lag come on top.
TEST(Suite, AStopTakesWhatItsSpeedTakes) {
  const MethodResult result = Tested("stopping_distance", Quick());
  ASSERT_TRUE(result.figure.has_value());
  EXPECT_EQ(result.failures, 0);
  EXPECT_GT(*result.figure, 1);
  EXPECT_LT(*result.figure, 100);
  EXPECT_EQ(result.runs[result.shown].verdict.figure, result.figure);
}

TEST(Suite, ARobotWithoutALidarIsNotAskedToFindItself) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  for (const auto& entry : Methods()) EXPECT_EQ(entry.make()->WhyNot(robot), "") << entry.name;
  mjs_delete(robot.mjcf.get(), mjs_findElement(robot.mjcf.get(), mjOBJ_SITE, "lidar"));
  int not_asked = 0;
  for (const auto& entry : Methods()) not_asked += !entry.make()->WhyNot(robot).empty();
  EXPECT_EQ(not_asked, 3);
}

TEST(SuiteRequirement, IsAMethodWithAValue) {
  const SuiteRequirement dut = ReadRequirement("step=12.5");
  EXPECT_EQ(dut.method, "step");
  EXPECT_EQ(dut.value, 12.5);
  for (const char* bad : {"step", "=3", "step=", "step=x", "step=-1", "stp=3", "obstacle=1"})
    EXPECT_THROW(ReadRequirement(bad), InputError) << bad;
}

TEST(SuiteRequirement, IsMissedBelowIt) {
  MethodResult result;
  result.method = "step";
  result.sizes = SizeLadder{"height", "mm", {}};
  result.n = 59;
  result.size = 12;
  EXPECT_EQ(WhyMissed(result, std::vector<SuiteRequirement>{{"step", 12}}), "");
  EXPECT_EQ(WhyMissed(result, std::vector<SuiteRequirement>{{"gap", 13}}), "");
  EXPECT_EQ(WhyMissed(result, std::vector<SuiteRequirement>{{"step", 13}}),
            "12 mm, 13 mm is required");
  result.sizes->down_from = 500;  // the smaller, the harder
  EXPECT_NE(WhyMissed(result, std::vector<SuiteRequirement>{{"step", 11}}), "");
  EXPECT_EQ(WhyMissed(result, std::vector<SuiteRequirement>{{"step", 13}}), "");
}

}  // namespace
}  // namespace floorproof
