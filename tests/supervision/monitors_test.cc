// SPDX-License-Identifier: Apache-2.0
// What each monitor notices, and what it does not mistake for it.
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <set>

#include "tests/supervision/watched_robot.h"

namespace floorproof {
namespace {

class MonitorTest : public ::testing::Test {
 protected:
  // Takes the robot's parts as they are from then on.
  void Watch(const char* monitor, RobotSpec robot = TwoWheels(), const std::string& keys = "{}") {
    robot_.emplace(std::move(robot));
    dut_ = MakePlugin(Monitors(), monitor, "monitor");
    ReadParams(ParseYaml(keys, "keys"), "", *dut_);
    for (int i = 0; i < 90; ++i) robot_->scan.angle_rad.push_back(WrapAngle(i * kPi / 45));
    robot_->Scan(1);
  }
  // Goes on for so long; `change`, if any, alters the readings before each period.
  void Go(double for_s, const std::function<void()>& change = {}) {
    if (!started_) dut_->Start({robot_->robot(), robot_->drive(), robot_->map});
    started_ = true;
    for (const double until_s = robot_->t_s + for_s; robot_->t_s < until_s - 1e-9; robot_->Pass()) {
      if (change) change();
      dut_->Update(robot_->Readings());
    }
  }
  bool raised(std::size_t alarm = 0) const { return dut_->alarms()[alarm].raised(); }

  std::optional<WatchedRobot> robot_;
  std::unique_ptr<Monitor> dut_;
  bool started_ = false;
};

constexpr BodyTwist kAhead = {0.25, 0, 0};

TEST(Monitors, SayTheirKindAndAllFiveKindsAreThere) {
  std::set<MonitorKind> kinds;
  for (const auto& entry : Monitors()) {
    const auto dut = entry.make();
    kinds.insert(dut->kind());
    EXPECT_TRUE(entry.help.starts_with(std::string(Name(dut->kind())) + ": ")) << entry.name;
    for (const ParamDoc& doc : DocumentParams(*dut)) EXPECT_FALSE(doc.help.empty()) << doc.name;
  }
  EXPECT_EQ(kinds.size(), 5u);
}

// A sound robot that drives, turns, brakes and stands.
TEST_F(MonitorTest, NoneOfThemCriesOverASoundRobot) {
  for (const auto& entry : Monitors())
    for (const RobotSpec& robot : {TwoWheels(), EightWheels()}) {
      started_ = false;
      Watch(std::string(entry.name).c_str(), robot);
      for (const BodyTwist& twist : {BodyTwist{}, BodyTwist{0.25, 0, 0}, BodyTwist{0.1, 0, 0.5},
                                     BodyTwist{0, 0, -1}, BodyTwist{-0.1, 0, 0}, BodyTwist{}}) {
        robot_->Tell(twist);
        Go(3, [&] { robot_->scan.fresh = robot_->periods % 5 == 0; });
      }
      for (const Alarm& alarm : dut_->alarms())
        EXPECT_FALSE(alarm.raised()) << entry.name << " " << alarm.value();
    }
}

TEST_F(MonitorTest, WheelSpeedNoticesTheWheelThatDoesNotTurnAsItIsTold) {
  Watch("wheel_speed");
  robot_->Tell(kAhead);
  Go(2);
  robot_->wheel_rad[1] *= 0.8;
  Go(2);
  EXPECT_FALSE(raised(1)) << "a load slows a wheel";
  robot_->wheel_rad[1] = 0;
  Go(0.4);
  EXPECT_TRUE(raised(1));
  EXPECT_FALSE(raised(0));
  robot_->Tell({});
  Go(20);
  EXPECT_TRUE(raised(1)) << "told to stand it proves nothing";
  robot_->Tell(kAhead);
  Go(2.2);
  EXPECT_FALSE(raised(1));
}

TEST_F(MonitorTest, WheelSpeedNoticesTheWheelThatTurnsUntold) {
  Watch("wheel_speed");
  robot_->Tell({});
  Go(1);
  robot_->wheel_rad[0] = 5 * WatchedRobot::kControl_s;
  Go(0.4);
  EXPECT_TRUE(raised(0));
}

TEST_F(MonitorTest, MotorCurrentKnowsTheDriversLaw) {
  Watch("motor_current");
  robot_->Tell(kAhead, 8);
  Go(3);
  EXPECT_FALSE(raised(0)) << "a heavy load is no fault: the wheel lags as the law says";
  robot_->power.motor_a[0] = 0.3 * 8;
  Go(0.5);
  EXPECT_TRUE(raised(0)) << "a motor that gives a third of what it should";
  EXPECT_FALSE(raised(1));
}

TEST_F(MonitorTest, MotorCurrentTakesTheBatterysVoltageIntoTheLaw) {
  Watch("motor_current", TwoWheels(), "{limit_share: 0.1, encoder_share: 0}");
  robot_->Tell(kAhead);
  // Held fast: at 12 V the driver's 1 N m/rad/s would drive 10 A, 9 V give 7.5 A.
  const auto held = [&] {
    robot_->wheel_rad[0] = 0;
    robot_->power.battery_v = 9;
    robot_->power.motor_a[0] = 7.5;
  };
  Go(3, held);
  EXPECT_FALSE(raised(0));
  robot_->power.battery_v = 12;
  Go(1, [&] { robot_->power.battery_v = 12; });
  EXPECT_TRUE(raised(0));
}

TEST_F(MonitorTest, MotorCurrentSaysNothingOfAWheelThatChatters) {
  Watch("motor_current");
  robot_->Tell(kAhead);
  int period = 0;
  Go(3, [&] {
    robot_->wheel_rad[0] = (period++ % 2 == 0 ? 3 : 7) * WatchedRobot::kControl_s;
    robot_->power.motor_a[0] = 8;
  });
  EXPECT_FALSE(raised(0));
}

TEST_F(MonitorTest, WheelPeersFindTheWheelThatDrawsNothing) {
  Watch("wheel_peers", EightWheels());
  robot_->Tell({0.2, 0.1, 0});
  Go(3);
  robot_->power.motor_a[2] = 0;
  Go(4);
  for (std::size_t w = 0; w < 8; ++w) EXPECT_EQ(raised(w), w == 2) << w;
}

TEST_F(MonitorTest, WheelPeersDoNotGuessWhereManyDisagree) {
  for (const char* name : {"wheel_peers", "wheel_spread"}) {
    started_ = false;
    Watch(name, EightWheels());
    robot_->Tell(kAhead);
    robot_->power.motor_a[0] = 0;
    robot_->power.motor_a[3] = 0.4;
    robot_->power.motor_a[6] = 0.5;
    Go(5);
    EXPECT_EQ(raised(0), std::string(name) == "wheel_spread") << name;
  }
}

// In a bend a skid-steer's inner wheels brake what its outer ones drive: nothing is broken.
// Straight ahead, and on the spot, a dead motor is found.
TEST_F(MonitorTest, WheelPeersSayNothingInASkidSteersBend) {
  for (const char* name : {"wheel_peers", "wheel_spread"})
    for (const BodyTwist& twist : {kAhead, BodyTwist{0, 0, 0.8}, BodyTwist{0.2, 0, 0.15}}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(twist.wz_radps));
      started_ = false;
      Watch(name, FourWheels());
      robot_->Tell(twist);
      Go(3);
      const bool bend = twist.vx_mps > 0 && twist.wz_radps > 0;
      if (bend) robot_->power.motor_a = {-0.5, 1, -0.5, 1};
      if (!bend) robot_->power.motor_a[2] = 0;
      Go(5);
      const bool peers = std::string(name) == "wheel_peers";
      EXPECT_EQ(raised(peers ? 2 : 0), peers && !bend);
    }
}

TEST_F(MonitorTest, YawRateNoticesATurnThatTheWheelsDidNotMake) {
  Watch("yaw_rate");
  robot_->Tell({0.2, 0, 0.5});
  robot_->gyro_radps.z() = 0.4;
  Go(3);
  EXPECT_FALSE(raised());
  robot_->gyro_radps.z() = 0.1;
  Go(1.5);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, SlipNoticesWheelsThatTurnInVain) {
  Watch("slip");
  robot_->Tell(kAhead);
  Go(5);
  EXPECT_FALSE(raised());
  robot_->estimate.V_WB_B = {0.05, 0, 0};
  Go(3);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, SlipNoticesThatItWasCarried) {
  Watch("slip");
  robot_->Tell(kAhead);
  Go(3);
  robot_->estimate.X_WB.y_m += 0.5;
  Go(1);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, TiltIsNoBraking) {
  Watch("tilt");
  const double lean_rad = 20 * kPi / 180;
  Go(1);
  robot_->accel_mps2 = {3, 0, 9.81};
  Go(0.3);
  EXPECT_FALSE(raised()) << "a jolt of 17 deg, for a moment";
  robot_->accel_mps2 = Vec3(0, -std::sin(lean_rad), std::cos(lean_rad)) * 9.81;
  Go(3);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, LeanIsAChangeThatLasts) {
  Watch("lean");
  const auto leans = [&](double deg) {
    const double rad = deg * kPi / 180;
    robot_->accel_mps2 = Vec3(std::sin(rad), 0, std::cos(rad)) * 9.81;
  };
  leans(5);
  Go(20);
  EXPECT_FALSE(raised()) << "it always leaned so";
  leans(12);
  Go(0.5);
  leans(5);
  Go(10);
  EXPECT_FALSE(raised()) << "it crossed something";
  leans(8);
  Go(10);
  EXPECT_TRUE(raised());
}

// A floor's lean keeps its direction in the world; a load's keeps its own in the body.
class LeanTest : public MonitorTest {
 protected:
  LeanTest() {
    Watch("lean");
    robot_->Tell(kAhead);
    Go(20);
  }
  static Vec3 Up(double deg, double toward_rad) {
    const double rad = deg * kPi / 180;
    return Vec3(std::sin(rad) * std::cos(toward_rad), std::sin(rad) * std::sin(toward_rad),
                std::cos(rad)) *
           9.81;
  }
  // Drives so, on a slope that the map does not know.
  void OnASlope(const BodyTwist& twist, double for_s, double deg = 4.76) {
    robot_->Tell(twist);
    Go(for_s, [&] {
      robot_->accel_mps2 = Up(deg, -robot_->estimate.X_WB.yaw_rad);
      EXPECT_FALSE(raised()) << robot_->t_s;
    });
  }
};

TEST_F(LeanTest, ARampThatNoMapKnowsIsNoLoad) {
  OnASlope(kAhead, 36);  // 9 m
  OnASlope({0, 0, 1}, kPi);
  OnASlope(kAhead, 30);
  OnASlope({0, 0, 0.3}, 12 * kPi);
  OnASlope({}, 30);
  OnASlope({0, 0, 1}, kPi / 2);
  OnASlope({}, 30);
}

TEST_F(LeanTest, ALoadThatHasShiftedIsSeenAtTheNextTurn) {
  robot_->accel_mps2 = Up(3, 0.4);
  Go(20);
  EXPECT_FALSE(raised()) << "5 m, straight on: it may be a ramp";
  robot_->Tell({0, 0, 1});
  Go(kPi / 2);
  robot_->Tell(kAhead);
  Go(2);
  EXPECT_TRUE(raised());
}

TEST_F(LeanTest, ALoadThatHasShiftedIsSeenAfterALongWay) {
  robot_->accel_mps2 = Up(3, 0.4);
  Go(50);
  EXPECT_TRUE(raised());
}

TEST_F(LeanTest, UnderAStandingRobotNoFloorChanges) {
  robot_->Tell({});
  Go(5);
  robot_->accel_mps2 = Up(3, 0.4);
  Go(6);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, CovarianceIsAnEstimateThatHasBecomeUnsure) {
  Watch("covariance");
  robot_->estimate.position_std_m = 0.5;
  Go(10);
  EXPECT_FALSE(raised()) << "it need not know at once";
  robot_->estimate.position_std_m = 0.05;
  Go(1);
  robot_->estimate.position_std_m = 0.4;
  Go(1);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, ScanSignalNoticesScansThatDoNotComeAndThoseThatAreEmpty) {
  for (const bool comes : {false, true}) {
    started_ = false;
    Watch("scan_signal");
    Go(2);
    const auto scans = [&] { robot_->scan.fresh = robot_->periods % 5 == 0; };
    if (comes) robot_->Scan(std::numeric_limits<double>::infinity());
    robot_->scan.fresh = false;
    Go(1, comes ? std::function<void()>(scans) : nullptr);
    EXPECT_TRUE(raised()) << comes;
    robot_->Scan(1);
    Go(1, scans);
    EXPECT_FALSE(raised());
  }
}

// In a round room of 2 m radius.
TEST_F(MonitorTest, ScanFitNoticesThatTheMapNoLongerFits) {
  Watch("scan_fit");
  HazardMap& map = robot_->map;
  map.frame = {120, 120, 0.05, {}};
  map.occupancy = Grid<CellState>(120, 120, CellState::kFree);
  for (int ix = 0; ix < 120; ++ix)
    for (int iy = 0; iy < 120; ++iy)
      if ((map.frame.Center(ix, iy) - Vec2(3, 3)).norm() > 2)
        map.occupancy(ix, iy) = CellState::kOccupied;
  robot_->estimate.X_WB = {3, 3, 0};
  robot_->Scan(2.02);
  Go(5);
  EXPECT_FALSE(raised());
  robot_->estimate.X_WB = {3.05, 3, 1};
  Go(5);
  EXPECT_FALSE(raised()) << "no estimate is better than that";
  robot_->estimate.X_WB = {3.4, 3.2, 0};
  Go(2);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, ABumperThatStaysPressedIsNoTouch) {
  Watch("bumper_signal");
  for (int i = 0; i < 5; ++i) {
    robot_->bump.pressed = true;
    Go(1.5);
    robot_->bump.pressed = false;
    Go(1);
  }
  EXPECT_FALSE(raised());
  robot_->bump.pressed = true;
  Go(3.2);
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, ABatteryThatSagsIsNoBatteryThatIsUsed) {
  Watch("battery_trend");
  Go(600, [&] { robot_->power.battery_v = 12 - 0.5 * robot_->t_s / 600; });
  EXPECT_FALSE(raised());
  Go(3, [&] { robot_->power.battery_v = 9.6; });
  EXPECT_TRUE(raised());
}

TEST_F(MonitorTest, AnImuMayNotFreeze) {
  Watch("imu_signal");
  Go(5);
  EXPECT_FALSE(raised());
  Go(0.5, [&] { robot_->gyro_radps.x() = 0.5; });
  EXPECT_TRUE(raised());
}

}  // namespace
}  // namespace floorproof
