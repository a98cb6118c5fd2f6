// SPDX-License-Identifier: Apache-2.0
// Encoders and IMU: their readings against the true motion, with and without slip.
#include <cmath>

#include "tests/robots.h"
#include "tests/sensors/sensor_rig.h"

namespace floorproof {
namespace {

// The way that the wheels say was driven.
double Rolled(SensorRig& rig, const BodyTwist& twist, int periods) {
  const auto drive = MakePlugin(Drives(), rig.robot().drive, "drive");
  drive->Configure(rig.robot());
  std::vector<double> speeds(rig.robot().wheels.size());
  double way_m = 0;
  for (int i = 0; i < periods; ++i) {
    const Observation& sensed = rig.Drive(twist);
    for (std::size_t w = 0; w < speeds.size(); ++w)
      speeds[w] = sensed.wheel_rad[w] / SensorRig::kControl_s;
    const BodyTwist told = drive->ToTwist(speeds);
    way_m += std::hypot(told.vx_mps, told.vy_mps) * SensorRig::kControl_s;
  }
  return way_m;
}

TEST(Encoders, TellTheWayThatWasDriven) {
  for (const std::string& robot : RobotNames()) {
    SensorRig rig(Room(8, 4), robot, {2, 3, 0});
    rig.Carry(MakeSensor("encoders"));
    rig.Sense();
    const double told_m = Rolled(rig, {0.2, 0, 0}, 500);
    const double driven_m = rig.truth().p_WB.x() - 2;
    EXPECT_GT(driven_m, 1.8) << robot;
    EXPECT_NEAR(told_m / driven_m, 1, 0.01) << robot;
  }
}

TEST(Encoders, SlipIsToldAsWayThatWasNotDriven) {
  HazardMap map = Room(4, 4);
  map.hazards = {Block(HazardClass::kBlindObject, {3, 1}, {3.5, 5}, 1)};
  SensorRig rig(map, "beluga", {2.7, 3, 0});
  rig.Carry(MakeSensor("encoders"));
  rig.Sense();
  const double told_m = Rolled(rig, {0.2, 0, 0}, 500);
  const double driven_m = rig.truth().p_WB.x() - 2.7;
  EXPECT_LT(driven_m, 0.15) << "a block stands in the way";
  EXPECT_GT(told_m, 1.0) << "the wheels turn on";
}

TEST(Encoders, CountWholeTicksAndLoseNone) {
  SensorRig rig(Room(8, 4), "beluga", {2, 3, 0});
  rig.Carry(MakeSensor("encoders", "{ticks: 20}"));
  const double tick_rad = 2 * kPi / 20;
  double told_rad = 0;
  const int joint = mj_name2id(rig.scene().model.get(), mjOBJ_JOINT, "wheel_left");
  const int adr = rig.scene().model->jnt_qposadr[joint];
  const double before_rad = rig.sim().data()->qpos[adr];
  for (int i = 0; i < 300; ++i) {
    const double rad = rig.Drive({0.2, 0, 0}).wheel_rad[0];
    EXPECT_NEAR(rad / tick_rad, std::round(rad / tick_rad), 1e-9);
    told_rad += rad;
  }
  EXPECT_NEAR(told_rad, rig.sim().data()->qpos[adr] - before_rad, tick_rad);
}

TEST(Encoders, ABiasedWheelTellsMore) {
  for (const double bias : {-0.1, 0.0, 0.1}) {
    SensorRig rig(Room(8, 4), "beluga", {2, 3, 0});
    rig.Carry(MakeSensor("encoders", "{bias: " + std::to_string(bias) + "}"));
    rig.Sense();
    const double told_m = Rolled(rig, {0.2, 0, 0}, 300);
    EXPECT_NEAR(told_m / (rig.truth().p_WB.x() - 2), 1 + bias, 0.01);
  }
}

constexpr const char* kExactImu =
    "{gyro_noise_radps: 0, gyro_bias_radps: 0, accel_noise_mps2: 0, accel_bias_mps2: 0}";

// Newton's law through the motors: what they drive is what the robot gains, but for losses.
TEST(Power, CurrentsAreTheTorqueThatSpeedsTheRobotUp) {
  SensorRig rig(Room(6, 4), "beluga", {2, 3, 0});
  rig.Carry(MakeSensor("power", "{current_noise_a: 0, voltage_noise_v: 0}"));
  double impulse_ns = 0;
  const WheelSpec& wheel = rig.robot().wheels[0];
  const double constant = wheel.motor.constant;
  for (int i = 1; i <= 40; ++i) {
    const Observation& told = rig.Drive({0.01 * i, 0, 0});
    for (const double a : told.power.motor_a)
      impulse_ns += a * constant / wheel.radius_m * SensorRig::kControl_s;
  }
  const double gained_ns = rig.robot().mass_kg * rig.truth().V_WB_B.vx_mps;
  EXPECT_GT(impulse_ns, gained_ns);
  EXPECT_LT(impulse_ns, 1.6 * gained_ns) << "wheels turn too, and casters rub";
  EXPECT_GT(gained_ns, 2);
}

TEST(Power, TellsTheBatterysVoltageAndWhatIsSilentTellsNone) {
  SensorRig rig(Room(6, 4), "htetro", {2, 3, 0});
  auto sensor = MakeSensor("power", "{voltage_noise_v: 0}");
  const Sensor& dut = *sensor;
  rig.Carry(std::move(sensor));
  Observation told = rig.Drive({0.2, 0, 0});
  EXPECT_TRUE(told.power.heard);
  EXPECT_NEAR(told.power.battery_v, rig.truth().battery_v, 1e-12);
  EXPECT_EQ(told.power.motor_a.size(), 16u);
  dut.Silence(told);
  EXPECT_FALSE(told.power.heard);
  EXPECT_EQ(told.power.battery_v, 0);
}

TEST(Imu, AtRestTellsGravityAlone) {
  SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
  rig.Carry(MakeSensor("imu", kExactImu));
  for (int i = 0; i < 50; ++i) rig.Drive({});
  const Observation& sensed = rig.Drive({});
  EXPECT_LT(sensed.gyro_radps.norm(), 1e-3);
  // BELUGA stands on its casters a little nose up.
  const Vec3 up_B(-std::sin(rig.truth().pitch_rad), 0, std::cos(rig.truth().pitch_rad));
  EXPECT_LT((sensed.accel_mps2 - 9.81 * up_B).norm(), 2e-3);
}

TEST(Imu, AddedUpIsTheTurnAndTheSpeed) {
  SensorRig rig(Room(6, 6), "htetro", {4, 4, 0});
  rig.Carry(MakeSensor("imu", kExactImu));
  rig.Sense();
  double turned_rad = 0, vx_mps = 0, vy_mps = 0;
  const double yaw0_rad = rig.truth().yaw_rad;
  for (int i = 0; i < 100; ++i) {
    const Observation& sensed = rig.Drive({0.1, 0.1, 0.4});
    turned_rad += sensed.gyro_radps.z() * SensorRig::kControl_s;
    // In the turning body's axes.
    const double wz = sensed.gyro_radps.z();
    const double ax = sensed.accel_mps2.x() + wz * vy_mps, ay = sensed.accel_mps2.y() - wz * vx_mps;
    vx_mps += ax * SensorRig::kControl_s;
    vy_mps += ay * SensorRig::kControl_s;
  }
  EXPECT_NEAR(turned_rad, WrapAngle(rig.truth().yaw_rad - yaw0_rad), 0.01);
  EXPECT_NEAR(vx_mps, rig.truth().V_WB_B.vx_mps, 0.01);
  EXPECT_NEAR(vy_mps, rig.truth().V_WB_B.vy_mps, 0.01);
}

TEST(Imu, NoiseAndBiasAreAsStated) {
  double biases = 0;
  constexpr int kEpisodes = 200, kReadings = 60;
  double noise = 0;
  SensorRig rig(Room(4, 4), "beluga", {3, 3, 0});
  for (int i = 0; i < 50; ++i) {
    if (i == 0) rig.Carry(MakeSensor("imu", kExactImu));
    rig.Drive({});
  }
  for (std::uint64_t episode = 0; episode < kEpisodes; ++episode) {
    rig.Carry(MakeSensor("imu", "{gyro_noise_radps: 0.01, gyro_bias_radps: 0.05}"), episode);
    double sum = 0, square = 0;
    for (int i = 0; i < kReadings; ++i) {
      const double z = rig.Sense().gyro_radps.z();
      sum += z;
      square += z * z;
    }
    const double mean = sum / kReadings;
    noise += (square - kReadings * mean * mean) / (kReadings - 1);
    biases += mean * mean;
  }
  EXPECT_NEAR(std::sqrt(noise / kEpisodes), 0.01, 0.001);
  EXPECT_NEAR(std::sqrt(biases / kEpisodes), 0.05, 5 * 0.05 / std::sqrt(2.0 * kEpisodes));
}

}  // namespace
}  // namespace floorproof
