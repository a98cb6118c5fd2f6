// SPDX-License-Identifier: Apache-2.0
// From plan to record, and the loop on a plant that is not MuJoCo's.
#include "run/episode/execute.h"

#include <gmock/gmock.h>

#include "run/scenario/agents.h"
#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ExecuteTest : public ScenarioTest {
 protected:
  ExecuteTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n"); }
};

class Witness : public EpisodeObserver {
 public:
  void OnPlan(const PlanResult& plan) override {
    seen.push_back("plan " + std::string(Name(plan.status)));
  }
  void OnScene(const Scene& scene) override {
    seen.push_back(scene.model != nullptr ? "scene" : "no scene");
  }
  bool OnControl(const EpisodeView& now) override {
    if (seen.empty() || seen.back() != "control") seen.push_back("control");
    EXPECT_NE(now.simulation, nullptr);
    return true;
  }
  std::vector<std::string> seen;
};

TEST_F(ExecuteTest, PlansThenBuildsThenDrives) {
  Scenario scenario = Read(RoomScenario(""));
  Witness witness;
  const Execution dut = Execute(scenario, &witness);
  EXPECT_THAT(witness.seen, ElementsAre("plan success", "scene", "control"));
  EXPECT_EQ(dut.record.outcome, Outcome::kSuccess);
  EXPECT_TRUE(dut.scene.has_value());
}

TEST_F(ExecuteTest, WithoutDrivingThereIsNoScene) {
  Scenario scenario = Read(RoomScenario("", "drive: none\n"));
  Witness witness;
  const Execution dut = Execute(scenario, &witness);
  EXPECT_THAT(witness.seen, ElementsAre("plan success"));
  EXPECT_EQ(dut.record.outcome, Outcome::kSuccess);
  EXPECT_FALSE(dut.scene.has_value());
  EXPECT_THAT(dut.record.trace, IsEmpty());
}

TEST_F(ExecuteTest, TheSameScenarioTwiceGivesTheSameTrace) {
  Scenario scenario = Read(RoomScenario(""));
  const Execution once = Execute(scenario), twice = Execute(scenario);
  ASSERT_EQ(once.record.trace.size(), twice.record.trace.size());
  EXPECT_EQ(once.record.trace.back().x_m, twice.record.trace.back().x_m);
}

// A robot that does at once and exactly what it is told, on a floor without physics.
class IdealPlant final : public Plant {
 public:
  explicit IdealPlant(double step_s) : step_s_(step_s) {}
  void Reset(const Pose2& X_WB, Observation& sensed) override {
    truth_ = {};
    Put(X_WB);
    Sense(sensed);
  }
  void SetDown(const Pose2& X_WB) override { Put(X_WB); }
  void Apply(const Actuation& actuation) override { truth_.V_WB_B = actuation.twist; }
  void Sense(Observation& sensed) override {
    sensed.t_s = truth_.t_s;
    sensed.truth = TruePose{truth_.X_WB(), truth_.V_WB_B, {}};
  }
  bool Step() override {
    const BodyTwist& v = truth_.V_WB_B;
    const double c = std::cos(truth_.yaw_rad), s = std::sin(truth_.yaw_rad);
    truth_.v_WB_W = {c * v.vx_mps - s * v.vy_mps, s * v.vx_mps + c * v.vy_mps, 0};
    truth_.p_WB += step_s_ * truth_.v_WB_W;
    truth_.yaw_rad = WrapAngle(truth_.yaw_rad + step_s_ * v.wz_radps);
    truth_.t_s += step_s_;
    truth_.battery_v = 12;
    truth_.support_margin_m = 0.1;
    return truth_.t_s < breaks_s;
  }
  std::string WhyBroken() const override { return "its belt broke"; }
  const Truth& truth() const override { return truth_; }
  std::optional<double> battery_left() const override { return std::nullopt; }

  double breaks_s = 1e9;

 private:
  void Put(const Pose2& X_WB) {
    truth_.p_WB = {X_WB.x_m, X_WB.y_m, 0};
    truth_.yaw_rad = X_WB.yaw_rad;
  }
  double step_s_;
  Truth truth_;
};

TEST_F(ExecuteTest, TheLoopRunsOnAnyPlant) {
  Scenario scenario = Read(RoomScenario(""));
  const PlanResult plan = MakePlan(scenario);
  IdealPlant plant(scenario.world.physics.timestep_s);
  Agents agents = MakeAgents(scenario.spec);
  const EpisodeRecord ideal = RunEpisode(scenario, agents, plant, nullptr, plan, nullptr);
  EXPECT_EQ(ideal.outcome, Outcome::kSuccess) << ideal.message;
  EXPECT_THAT(ideal.events, IsEmpty());
  EXPECT_NEAR(ideal.metrics.path_length_m, Length(plan.path), 0.05 * Length(plan.path));
  const Execution physics = Execute(scenario);
  EXPECT_NEAR(ideal.metrics.coverage, physics.record.metrics.coverage, 0.02);
  EXPECT_LT(ideal.metrics.max_cross_track_m, 0.1);
}

TEST_F(ExecuteTest, APlantThatBreaksIsAnError) {
  Scenario scenario = Read(RoomScenario(""));
  const PlanResult plan = MakePlan(scenario);
  IdealPlant plant(scenario.world.physics.timestep_s);
  plant.breaks_s = 1;
  Agents agents = MakeAgents(scenario.spec);
  const EpisodeRecord dut = RunEpisode(scenario, agents, plant, nullptr, plan, nullptr);
  EXPECT_EQ(dut.outcome, Outcome::kError);
  EXPECT_EQ(dut.message, "its belt broke");
  EXPECT_NEAR(dut.metrics.duration_s, 1, 0.01);
}

TEST_F(ExecuteTest, AScenarioIsReadFromMemoryAsFromAFile) {
  const std::string text = RoomScenario("");
  const floorproof::ScenarioFile dut =
      floorproof::ScenarioFile::FromText(text, folder_ / "never_written.yaml", {{"seed", "3"}});
  const Scenario from_memory = dut.Read(0);
  EXPECT_EQ(from_memory.spec.episode.seed, 3);
  EXPECT_EQ(from_memory.spec.name, "never_written");
  EXPECT_EQ(from_memory.spec.user_plan.size(), Read(text).spec.user_plan.size())
      << "beside that file";
  try {
    floorproof::ScenarioFile::FromText(text + "nonsense: 1\n", folder_ / "never_written.yaml");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("never_written.yaml"));
    EXPECT_THAT(e.what(), HasSubstr("nonsense"));
  }
}

}  // namespace
}  // namespace floorproof
