// SPDX-License-Identifier: Apache-2.0
// What a supervised robot does about what its monitors say, without physics.
#include "controllers/supervision/supervisor.h"

#include <gmock/gmock.h>

#include <functional>

#include "tests/controllers/allocation_guard.h"
#include "tests/supervision/watched_robot.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

constexpr const char* kFollow = R"(mission: 1
name: m
primitives:
  follow_plan: {severity: minor, extent: isolated, p1_s: 8}
  wheels: {type: service, monitors: [wheel_speed, wheel_peers], severity: catastrophic, extent: external, occurrence: low}
  lidar: {type: service, monitors: [scan_signal], severity: catastrophic, extent: external, occurrence: low, availability: singular}
  battery: {type: service, monitors: [battery_trend], severity: catastrophic, extent: external, occurrence: low, availability: eminent}
skills:
  drive: {run: [follow_plan], with: [wheels, lidar, battery]}
tasks: {cover: [drive]}
run: [cover]
)";

class SupervisorTest : public ::testing::Test {
 protected:
  void Begin(RobotSpec robot, const std::string& mission = kFollow) {
    robot_.emplace(std::move(robot));
    plan_.mission = ReadMission(ParseYaml(mission, "m.yaml"), RobotPrimitiveTypes());
    for (const std::string& name : MonitorsOf(plan_.mission)) plan_.monitors.push_back({name, {}});
    dut_.emplace(plan_, robot_->robot(), robot_->map);
    robot_->scan.angle_rad.assign(10, 0);
  }
  // Drives as it is let, for so long; `change` alters the readings of each period.
  void Go(double for_s, const std::function<void()>& change = {}) {
    for (const double until_s = robot_->t_s + for_s; robot_->t_s < until_s - 1e-9; robot_->Pass()) {
      robot_->Tell({0.25 * dut_->speed_share(), 0, 0});
      robot_->Scan(1);
      if (change) change();
      dut_->Update(robot_->Readings(), {});
    }
  }
  bool Said(const std::string& what) const {
    return std::ranges::any_of(dut_->rows(), [&](const SafetyRow& row) {
      return row.reason.find(what) != std::string::npos;
    });
  }

  SafetyPlan plan_;
  std::optional<WatchedRobot> robot_;
  std::optional<Supervisor> dut_;
};

TEST_F(SupervisorTest, ASoundRobotIsLetDrive) {
  Begin(TwoWheels());
  Go(60);
  EXPECT_EQ(dut_->speed_share(), 1);
  EXPECT_EQ(dut_->machine(), DecisionState::kNormal);
  EXPECT_TRUE(dut_->rows().empty());
  EXPECT_TRUE(dut_->alarms().empty());
}

// Nor where an alarm stands, and all wheels are asked about in each period.
TEST_F(SupervisorTest, AllocatesNothingWhereNothingChanges) {
  for (const bool react : {true, false}) {
    plan_ = {};
    plan_.reaction.react = react;
    Begin(EightWheels());
    Go(5);
    const auto period = [&](bool broken) {
      robot_->Tell({0.25 * dut_->speed_share(), 0, 0});
      robot_->Scan(1);
      if (broken) robot_->wheel_rad[3] = 0;
      dut_->Update(robot_->Readings(), {});
      robot_->Pass();
    };
    for (const bool broken : {false, true}) {
      for (int i = 0; i < 50; ++i) period(broken);
      const std::int64_t before = AllocationCount();
      for (int i = 0; i < 50; ++i) period(broken);
      EXPECT_EQ(AllocationCount(), before) << react << broken;
    }
  }
}

// 12 x (2 + 1 x 2) = 48: serious. It waits and tries again; what is still there after ten seconds
// is permanent, 12 x (2 + 2 x 2) = 72: fatal.
TEST_F(SupervisorTest, OfTwoWheelsNoneCanBeSpared) {
  Begin(TwoWheels());
  Go(5);
  const auto dead = [&] { robot_->wheel_rad[0] = 0; };
  Go(0.5, dead);
  EXPECT_EQ(dut_->speed_share(), 0) << "safety waiting";
  EXPECT_EQ(dut_->level(), SafetyLevel::kSerious);
  EXPECT_EQ(dut_->machine(), DecisionState::kFaultMode);
  EXPECT_TRUE(Said("the other wheels alone cannot drive it"));
  Go(5, dead);
  EXPECT_EQ(dut_->speed_share(), 0.5) << "it tries again, with care";
  Go(0.5, dead);
  EXPECT_EQ(dut_->speed_share(), 0);
  Go(6, dead);
  EXPECT_EQ(dut_->machine(), DecisionState::kAbort);
  EXPECT_THAT(dut_->stopped(), HasSubstr("definitive_stop: cover.drive reached Zcrit: 72 >= 61"));
  EXPECT_THAT(dut_->stopped(), HasSubstr("wheel_speed of left"));
  EXPECT_EQ(dut_->alarms().size(), 1u) << "it is one fault that is tried thrice";
  EXPECT_EQ(
      std::ranges::count(dut_->rows(), "cover.drive could not be reconfigured", &SafetyRow::reason),
      1);
  EXPECT_EQ(dut_->cut()[0] + dut_->cut()[1], 0) << "its drivers brake it first";
  Go(2, dead);
  EXPECT_EQ(dut_->cut()[0] + dut_->cut()[1], 2);
}

TEST_F(SupervisorTest, AfterAFaultThatWentItDrivesOn) {
  Begin(TwoWheels());
  Go(5);
  Go(0.5, [&] { robot_->wheel_rad[0] = 0; });
  Go(4.5);
  EXPECT_EQ(dut_->speed_share(), 0) << "a wheel that stands shows nothing";
  Go(1.4);
  EXPECT_EQ(dut_->speed_share(), 0.5);
  EXPECT_EQ(dut_->machine(), DecisionState::kFaultMode) << "a trial is no all-clear";
  Go(7);
  EXPECT_EQ(dut_->speed_share(), 1);
  EXPECT_EQ(dut_->machine(), DecisionState::kNormal);
  EXPECT_TRUE(dut_->stopped().empty());
}

TEST_F(SupervisorTest, AnEyeThatOpensAgainIsSeenWhileItWaits) {
  Begin(TwoWheels());
  Go(5);
  Go(1, [&] { robot_->scan.fresh = false; });
  EXPECT_EQ(dut_->speed_share(), 0);
  Go(1);
  EXPECT_EQ(dut_->speed_share(), 0.5) << "it need not wait for the rest of the five seconds";
  EXPECT_TRUE(Said("all is well again"));
}

TEST_F(SupervisorTest, WhoWaitsInVainHandsOver) {
  const auto blind = [&] { robot_->scan.fresh = false; };
  Begin(TwoWheels());
  Go(5);
  Go(58, blind);
  EXPECT_TRUE(dut_->stopped().empty()) << "it sees that it does not see, and is patient";
  Go(5, blind);
  EXPECT_THAT(dut_->stopped(), HasSubstr("it handed over, and nobody comes"));
  EXPECT_EQ(dut_->machine(), DecisionState::kFaultMode) << "that is no abort";
}

TEST_F(SupervisorTest, WhoComesSetsItRight) {
  const auto blind = [&] { robot_->scan.fresh = false; };
  plan_.helped = true;
  Begin(TwoWheels());
  Go(5);
  Go(80, blind);
  EXPECT_TRUE(dut_->asks_for_help());
  EXPECT_EQ(dut_->speed_share(), 0);
  dut_->SetDown(robot_->t_s);
  Go(0.1);
  EXPECT_EQ(dut_->speed_share(), 0.5);
  Go(10);
  EXPECT_EQ(dut_->speed_share(), 1);
}

TEST_F(SupervisorTest, WeakIsSlower) {
  Begin(TwoWheels());
  Go(5);
  Go(5, [&] { robot_->power.battery_v = 9; });
  EXPECT_EQ(dut_->level(), SafetyLevel::kWeak);
  EXPECT_EQ(dut_->speed_share(), 0.5);
  Go(5, [&] { robot_->power.battery_v = 12; });
  EXPECT_EQ(dut_->speed_share(), 1);
}

// 12 x (0 + 2) = 24; once the wheel is out of use it is no risk.
TEST_F(SupervisorTest, OfEightWheelsOneIsSpared) {
  Begin(EightWheels());
  Go(5);
  Go(0.5, [&] { robot_->wheel_rad[3] = 20 * WatchedRobot::kControl_s; });
  ASSERT_EQ(dut_->reconfigurations(), 1);
  for (std::size_t w = 0; w < 8; ++w) EXPECT_EQ(dut_->wheels_out()[w], w == 3) << w;
  EXPECT_EQ(dut_->cut()[3], 1) << "a driver that has gone wrong gets no power";
  Go(20, [&] { robot_->wheel_rad[3] = 20 * WatchedRobot::kControl_s; });
  EXPECT_EQ(dut_->machine(), DecisionState::kNormal);
  EXPECT_EQ(dut_->speed_share(), 1);
  EXPECT_EQ(dut_->alarms().size(), 1u);
}

TEST_F(SupervisorTest, WhoDoesNotReactDecidesAllTheSame) {
  plan_.reaction.react = false;
  Begin(TwoWheels());
  Go(5);
  Go(20, [&] { robot_->wheel_rad[0] = 0; });
  EXPECT_EQ(dut_->speed_share(), 1);
  EXPECT_TRUE(dut_->stopped().empty());
  EXPECT_EQ(dut_->machine(), DecisionState::kAbort);
}

TEST_F(SupervisorTest, WhoDoesNotStandWhenToldIsCutOff) {
  Begin(TwoWheels());
  Go(5);
  Go(4, [&] {
    robot_->wheel_rad[0] = 20 * WatchedRobot::kControl_s;
    robot_->estimate.V_WB_B = {0.5, 0, -1};
  });
  EXPECT_THAT(dut_->stopped(), HasSubstr("it does not stand when it is told to"));
  EXPECT_EQ(dut_->cut()[0] + dut_->cut()[1], 2);
}

// That it stands where it was, and nobody knows why, for P1.
TEST_F(SupervisorTest, AFaultThatNoMonitorSeesIsATimeOut) {
  Begin(TwoWheels());
  Go(5);
  Go(8.5, [&] { robot_->estimate.V_WB_B = {}; });
  const double r = 2 * (2 + 1 * 2);
  EXPECT_THAT(dut_->rows(), ::testing::Contains(::testing::Field(&SafetyRow::safety_state, r)));
  EXPECT_TRUE(Said("it has not come away from where it is in P1"));
}

constexpr const char* kGoTo = R"(mission: 1
name: go
primitives:
  rotation: {severity: minor, extent: external, occurrence: low, availability: eminent}
  line: {severity: catastrophic, extent: external, occurrence: very_low, availability: singular}
  acceleration_control: {severity: catastrophic, extent: external, occurrence: high, availability: singular}
skills:
  go_to: {run: [rotation, line, rotation], with: [acceleration_control], x_m: 0, y_m: 1, yaw_deg: 180, tolerance_m: 0.02, tolerance_deg: 1, speed_mps: 0.2, p1_s: 3, p2_s: 0.5, timeout_s: 20}
tasks: {there: [go_to]}
run: [there]
)";

class GoToTest : public SupervisorTest {
 protected:
  // Does as it is asked, for so long at most; false: `held`, it does nothing.
  void Obey(double for_s, bool held = false) {
    for (const double until_s = robot_->t_s + for_s; robot_->t_s < until_s - 1e-9; robot_->Pass()) {
      dut_->Update(robot_->Readings(), {});
      if (dut_->done()) return;
      const MotionWish& wish = dut_->wish();
      if (kinds_.empty() || kinds_.back() != wish.kind) kinds_.push_back(wish.kind);
      Pose2& at = robot_->estimate.X_WB;
      robot_->Tell({});
      if (held) continue;
      if (wish.kind == MotionWish::Kind::kTurn) {
        const double left = WrapAngle(wish.yaw_rad - at.yaw_rad);
        robot_->Tell({0, 0, std::abs(left) < 0.01 ? 0 : std::copysign(0.8, left)});
      } else if (wish.kind == MotionWish::Kind::kLine) {
        EXPECT_EQ(wish.line.speed_mps, 0.2);
        robot_->Tell({std::min(0.2, (wish.line.to_W - at.p()).norm() / 0.1), 0, 0});
      }
    }
  }
  std::vector<MotionWish::Kind> kinds_;
};

TEST_F(GoToTest, IsRotationLineRotation) {
  Begin(TwoWheels(), kGoTo);
  Obey(30);
  EXPECT_TRUE(dut_->done());
  using K = MotionWish::Kind;
  EXPECT_EQ(kinds_, (std::vector<K>{K::kTurn, K::kLine, K::kTurn}));
  EXPECT_NEAR(robot_->estimate.X_WB.x_m, 0, 0.03);
  EXPECT_NEAR(robot_->estimate.X_WB.y_m, 1, 0.03);
  EXPECT_NEAR(std::abs(robot_->estimate.X_WB.yaw_rad), kPi, 0.02);
  EXPECT_TRUE(dut_->rows().empty());
}

// Section 4: an error that does not reduce in P1 is an intermittent fault of its primitive, one
// that exceeds the time-out a permanent one. Rotation 4 x (1 + 2) = 12, then 4 x (1 + 4) = 20.
TEST_F(GoToTest, ItsTimeOutsAreItsFaults) {
  Begin(TwoWheels(), kGoTo);
  Obey(3.5, true);
  ASSERT_FALSE(dut_->rows().empty());
  EXPECT_EQ(dut_->rows()[0].node, "there.go_to.rotation");
  EXPECT_EQ(dut_->rows()[0].safety_state, 12);
  Obey(17, true);
  EXPECT_EQ(dut_->rows().back().safety_state, 20);
}

// P2, and the worked example: 12 x (2 + 3) = 60, just below fatal.
TEST_F(GoToTest, JoltsForLongerThanP2AreAFaultOfAccelerationControl) {
  Begin(TwoWheels(), kGoTo);
  robot_->accel_mps2 = {0, 0, 9.81};
  Obey(0.1);
  robot_->accel_mps2 = {4, 0, 9.81};
  Obey(0.4);
  EXPECT_TRUE(dut_->rows().empty());
  Obey(0.4);
  ASSERT_FALSE(dut_->rows().empty());
  EXPECT_EQ(dut_->rows()[0].node, "there.go_to.acceleration_control");
  EXPECT_EQ(dut_->rows()[0].safety_state, 60);
  EXPECT_EQ(dut_->rows()[0].level, SafetyLevel::kSerious);
}

TEST(SafetyPlan, AMissionDrivesThePlanOrFromPlaceToPlace) {
  const auto refusal = [](const std::string& run) -> std::string {
    const ConfigNode root = ParseYaml(
        "mission: 1\nprimitives: {follow_plan: {}, line: {x_m: 1, y_m: 1}, rotation: {}}\n"
        "skills: {a: {run: [" +
            run + "]}}\ntasks: {t: [a]}\nrun: [t]\n",
        "m.yaml");
    try {
      LinesOf(ReadMission(root, RobotPrimitiveTypes()), root);
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal("follow_plan"), "taken");
  EXPECT_EQ(refusal("line, line"), "taken");
  EXPECT_THAT(refusal("rotation"), HasSubstr("m.yaml:5: run: must drive the plan once"));
  for (const char* run : {"follow_plan, line", "follow_plan, follow_plan"})
    EXPECT_THAT(refusal(run), HasSubstr("m.yaml:5: run: must drive the plan once")) << run;
}

TEST(SafetyPlan, ALineWithoutAPlaceIsRefused) {
  const ConfigNode root = ParseYaml(
      "mission: 1\nprimitives: {line: {x_m: 1}}\nskills: {go: {run: [line]}}\n"
      "tasks: {t: [go]}\nrun: [t]\n",
      "m.yaml");
  try {
    LinesOf(ReadMission(root, RobotPrimitiveTypes()), root);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("m.yaml:2: go.line.x_m, y_m: are missing"));
  }
}

TEST(SafetyPlan, NamesMonitorsThatThereAre) {
  const Mission mission = ReadMission(
      ParseYaml("mission: 1\nprimitives: {service: {monitors: [wheel_sped]}, line: {}}\n"
                "skills: {a: {run: [line], with: [service]}}\ntasks: {t: [a]}\nrun: [t]\n",
                "m.yaml"),
      RobotPrimitiveTypes());
  try {
    MonitorsOf(mission);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("m.yaml:2: service.monitors = wheel_sped: unknown; did you "
                                    "mean wheel_speed?"));
  }
}

TEST(WheelRedundancy, IsWhatIsLeftOfTheDrive) {
  const RobotSpec two = TwoWheels(), eight = EightWheels();
  WheelRedundancy differential(two), mecanum(eight);
  EXPECT_EQ(differential.Without(std::vector<char>{0, 1}), Availability::kSingular);
  std::vector<char> out(8, 0);
  out[0] = 1;
  EXPECT_EQ(mecanum.Without(out), Availability::kRedundant);
  // Three rows of a matrix of rank 3 are the fewest: no other may fail.
  for (const std::size_t w : {0u, 1u, 2u, 3u, 4u}) out[w] = 1;
  EXPECT_EQ(mecanum.Without(out), Availability::kEminent);
  EXPECT_TRUE(mecanum.Exclude(out));
  std::vector<char> one_more(8, 0);
  one_more[7] = 1;
  EXPECT_EQ(mecanum.Without(one_more), Availability::kSingular);
  EXPECT_FALSE(mecanum.Exclude(one_more));
  EXPECT_EQ(mecanum.out()[7], 0);
}

}  // namespace
}  // namespace floorproof
