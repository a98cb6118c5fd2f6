// SPDX-License-Identifier: Apache-2.0
// When faults are there, and what those that are there at once come to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "env/faults/schedule.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RobotSpec TwoWheels(double roller_radius_m = 0) {
  RobotSpec robot;
  for (const char* name : {"left", "right"}) {
    robot.wheels.emplace_back();
    robot.wheels.back().name = name;
    robot.wheels.back().roller_radius_m = roller_radius_m;
  }
  return robot;
}

ScheduledFault Make(const std::string& type, const std::string& keys, FaultTiming timing = {}) {
  ScheduledFault made{type, "", MakePlugin(Faults(), type, "type"), timing};
  ReadParams(ParseYaml(keys, "keys"), "", *made.fault);
  return made;
}

class FaultsTest : public ::testing::Test {
 protected:
  void Add(const std::string& type, const std::string& keys, FaultTiming timing = {}) {
    faults_.push_back(Make(type, keys, timing));
  }
  // All that is broken at this time.
  Alterations At(double t_s, const RobotSpec& robot = TwoWheels()) {
    FaultSchedule dut(faults_);
    dut.Start({robot, sensors_});
    const Alterations* now = dut.Update(t_s);
    return now ? *now : Alterations{};
  }
  std::string WhyNot(const RobotSpec& robot = TwoWheels()) {
    try {
      At(0, robot);
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  }
  std::vector<ScheduledFault> faults_;
  std::vector<std::string> sensors_ = {"imu", "lidar"};
};

TEST_F(FaultsTest, AreThereFromOnsetForTheirDuration) {
  const FaultTiming dut{.onset_s = 2, .duration_s = 3, .period_s = {}};
  EXPECT_FALSE(dut.Holds(0));
  EXPECT_FALSE(dut.Holds(1.999));
  EXPECT_TRUE(dut.Holds(2));
  EXPECT_TRUE(dut.Holds(4.999));
  EXPECT_FALSE(dut.Holds(5));
}

TEST_F(FaultsTest, ComeAndGoInTheShareOfThePeriodThatTheDutySays) {
  const FaultTiming dut{.onset_s = 1, .duration_s = {}, .period_s = 2, .duty = 0.25};
  int holds = 0;
  for (int i = 0; i < 1000; ++i) holds += dut.Holds(1 + 0.01 * i);
  EXPECT_EQ(holds, 250);
  EXPECT_TRUE(dut.Holds(3.49));
  EXPECT_FALSE(dut.Holds(3.5));
}

// A step's time is a sum: 50 steps of 4 ms are 0.19999999999999998 s.
TEST_F(FaultsTest, RoundingOfTheTimeDelaysNothing) {
  double t_s = 0;
  for (int i = 0; i < 50; ++i) t_s += 0.004;
  EXPECT_TRUE((FaultTiming{.onset_s = 0.2, .duration_s = {}, .period_s = {}}.Holds(t_s)));
  EXPECT_TRUE((FaultTiming{.onset_s = 0.2, .duration_s = {}, .period_s = {}}.Holds(0.2)));
  while (t_s < 3600 - 0.002) t_s += 0.004;
  ASSERT_LT(t_s, 3600) << "by 6e-8 s";
  EXPECT_TRUE((FaultTiming{.onset_s = 3600, .duration_s = {}, .period_s = {}}.Holds(t_s)));
  EXPECT_FALSE((FaultTiming{.onset_s = 3600, .duration_s = {}, .period_s = {}}.Holds(t_s - 0.004)));
}

TEST_F(FaultsTest, AnUpdateAnswersOnlyWhenSomethingComesOrGoes) {
  Add("battery_sag", "{voltage_share: 0.5}", {.onset_s = 1, .duration_s = 1, .period_s = {}});
  const RobotSpec robot = TwoWheels();
  FaultSchedule dut(faults_);
  for (int episode = 0; episode < 2; ++episode) {  // each begins as built
    dut.Start({robot, sensors_});
    int answers = 0;
    for (int i = 0; i < 300; ++i) {
      const double t_s = 0.01 * i;
      const Alterations* now = dut.Update(t_s);
      if (now == nullptr) continue;
      ++answers;
      EXPECT_EQ(now->battery_voltage, t_s > 0.9 && t_s < 1.9 ? 0.5 : 1) << t_s;
    }
    EXPECT_EQ(answers, 3) << "the begin, the onset and the end";
  }
}

TEST_F(FaultsTest, WithoutAnyNothingIsEverAltered) {
  const RobotSpec robot = TwoWheels();
  FaultSchedule dut({});
  dut.Start({robot, sensors_});
  EXPECT_EQ(dut.Update(0), nullptr);
}

TEST_F(FaultsTest, WeakenTheWheelThatIsNamed) {
  Add("weak_motor", "{wheel: right, torque_share: 0.4}");
  EXPECT_THAT(At(0).wheel_torque, ElementsAre(1, 0.4));
}

TEST_F(FaultsTest, OfTheSameKindMultiply) {
  Add("weak_motor", "{wheel: all, torque_share: 0.5}");
  Add("weak_motor", "{wheel: left, torque_share: 0.5}");
  Add("battery_sag", "{voltage_share: 0.5}");
  Add("battery_sag", "{voltage_share: 0.9}");
  EXPECT_THAT(At(0).wheel_torque, ElementsAre(0.25, 0.5));
  EXPECT_DOUBLE_EQ(At(0).battery_voltage, 0.45);
}

TEST_F(FaultsTest, TwoLoadsLieAtTheirCommonCentre) {
  Add("shifted_load", "{mass_kg: 1, x_m: 0.3}");
  Add("shifted_load", "{mass_kg: 3, x_m: -0.1, z_m: 0.4}");
  EXPECT_DOUBLE_EQ(At(0).payload_kg, 4);
  EXPECT_NEAR(At(0).payload_p_B.x(), 0, 1e-12);
  EXPECT_NEAR(At(0).payload_p_B.z(), 0.35, 1e-12);
}

TEST_F(FaultsTest, RollersThatAreBlockedStayBlocked) {
  Add("blocked_rollers", "{wheel: left, drag: 0.5}");
  Add("blocked_rollers", "{wheel: left, drag: 0.5}");
  Add("blocked_rollers", "{wheel: right}");
  Add("blocked_rollers", "{wheel: right}");
  EXPECT_THAT(At(0, TwoWheels(0.01)).roller_drag, ElementsAre(0.75, 1));
  EXPECT_THAT(WhyNot(), HasSubstr("no rollers"));
}

TEST_F(FaultsTest, AStuckMotorRunsAtAShareOfItsSpeedWithoutLoad) {
  RobotSpec robot = TwoWheels();
  for (WheelSpec& wheel : robot.wheels) wheel.max_speed_radps = 10;
  Add("stuck_motor", "{}");
  Add("stuck_motor", "{wheel: left, speed_share: -0.5}");
  EXPECT_THAT(At(0, robot).wheel_stuck_radps, ElementsAre(-5, 10)) << "the later one counts";
  faults_.clear();
  Add("stuck_motor", "{wheel: right, speed_share: 0}");
  EXPECT_THAT(At(0, robot).wheel_stuck_radps, ElementsAre(std::nullopt, 0)) << "0 is no none";
}

TEST_F(FaultsTest, OfTwoSlipperyTreadsTheSlipperierCounts) {
  Add("slippery_wheel", "{wheel: left, friction: 0.05}");
  Add("slippery_wheel", "{}");
  EXPECT_THAT(At(0).wheel_friction, ElementsAre(0.05, 0.1));
}

// Also where other faults come and go meanwhile.
TEST_F(FaultsTest, ARobotIsKidnappedOnceEachTime) {
  Add("kidnapped", "{forward_m: 1, left_m: 0, turn_deg: 90}",
      {.onset_s = 1, .duration_s = {}, .period_s = 4});
  Add("battery_sag", "{}", {.onset_s = 2, .duration_s = {}, .period_s = 0.5});
  const RobotSpec robot = TwoWheels();
  FaultSchedule dut(faults_);
  dut.Start({robot, sensors_});
  int carried = 0;
  for (int i = 0; i < 1000; ++i)
    if (const Alterations* now = dut.Update(0.01 * i)) carried += now->carried ? 1 : 0;
  EXPECT_EQ(carried, 3) << "after 1, 5 and 9 s";
}

TEST_F(FaultsTest, WhoIsKidnappedTwiceAtOnceIsCarriedOnFromThere) {
  Add("kidnapped", "{forward_m: 1, left_m: 0, turn_deg: 90}");
  Add("kidnapped", "{forward_m: 1, left_m: 0, turn_deg: 0}");
  const Pose2 carried = At(0).carried.value();
  EXPECT_NEAR(carried.x_m, 1, 1e-12);
  EXPECT_NEAR(carried.y_m, 1, 1e-12);
}

TEST_F(FaultsTest, AStuckBumperSaysWhere) {
  Add("stuck_bumper", "{bearing_deg: 90}");
  EXPECT_THAT(WhyNot(), HasSubstr("sensor = bumper: the robot carries no such sensor"));
  sensors_.push_back("bumper");
  EXPECT_NEAR(At(0).bump_stuck_rad.value(), kPi / 2, 1e-12);
}

TEST_F(FaultsTest, SilenceTheSensorThatIsNamed) {
  Add("silent_sensor", "{sensor: lidar}");
  EXPECT_THAT(At(0).silent_sensors, ElementsAre("lidar"));
  faults_.clear();
  Add("silent_sensor", "{sensor: all}");
  EXPECT_THAT(At(0).silent_sensors, ElementsAre("imu", "lidar"));
}

TEST_F(FaultsTest, RefuseWhatTheRobotDoesNotHave) {
  Add("weak_motor", "{wheel: middle}");
  EXPECT_THAT(WhyNot(), HasSubstr("wheel = middle: is no driven wheel"));
  EXPECT_THAT(WhyNot(), HasSubstr("left right"));
  faults_.clear();
  Add("silent_sensor", "{sensor: sonar}");
  EXPECT_THAT(WhyNot(), HasSubstr("sensor = sonar: the robot carries no such sensor"));
}

}  // namespace
}  // namespace floorproof
