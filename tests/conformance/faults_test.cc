// SPDX-License-Identifier: Apache-2.0
// What every registered fault promises, on every registered robot that can have it.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "controllers/drive.h"
#include "env/faults/schedule.h"
#include "env/sim/physics_plant.h"
#include "tests/robots.h"

namespace floorproof {

void PrintTo(const PluginEntry<Fault>& entry, std::ostream* os) { *os << entry.name; }

namespace {

constexpr double kControl_s = 0.02;
constexpr double kOnset_s = 0.4, kDuration_s = 0.4, kEnd_s = 1;
constexpr int kStepsAControl = 5;

// What could be noticed of a drive, a control period each.
struct Moment {
  Vec3 p_WB;
  double yaw_rad, battery_v, power_w;
  std::vector<double> wheel_rad;
  bool has_imu, pressed;
  bool operator==(const Moment&) const = default;
};

class FaultConformance
    : public testing::TestWithParam<std::tuple<PluginEntry<Fault>, std::string>> {
 protected:
  FaultConformance()
      : robot_(ReadRobot(FindRobotFile(std::get<1>(GetParam()), {}))),
        scene_(BuildScene(map_, robot_, {}, {})) {
    for (const char* name : {"encoders", "imu", "bumper"})
      sensors_.push_back({name, MakePlugin(Sensors(), name, "sensor")});
  }

  static HazardMap Floor() {
    HazardMap map;
    map.frame = {40, 40, 0.5, {-10, -10, 0}};
    map.occupancy = Grid<CellState>(40, 40);
    return map;
  }

  // Empty where the robot cannot have the fault.
  std::vector<ScheduledFault> Made(const FaultTiming& timing = {}) {
    std::vector<ScheduledFault> faults;
    faults.push_back(
        {std::string(std::get<0>(GetParam()).name), "", std::get<0>(GetParam()).make(), timing});
    try {
      faults[0].fault->Start({robot_.spec, SensorNames(sensors_)});
    } catch (const InputError& e) {
      refused_ = e.what();
      faults.clear();
    }
    return faults;
  }

  PhysicsPlant Plant(std::span<const ScheduledFault> faults) {
    return {scene_, map_, robot_.spec, sensors_, faults, kControl_s, [](const std::string& name) {
              return Stream(7, 0, name);
            }};
  }

  // An episode: askew where the robot can, so that all that turns turns.
  std::vector<Moment> Drive(PhysicsPlant& plant) {
    const auto drive = MakePlugin(Drives(), robot_.spec.drive, "drive");
    drive->Configure(robot_.spec);
    std::vector<double> wheels(robot_.spec.wheels.size());
    const BodyTwist askew{0.15, drive->holonomic() ? 0.1 : 0, 0.2};
    Observation sensed;
    plant.Reset({}, sensed);
    std::vector<Moment> moments;
    while (plant.truth().t_s < kEnd_s - kControl_s / 2) {
      plant.Sense(sensed);
      const Truth& t = plant.truth();
      moments.push_back({t.p_WB, t.yaw_rad, t.battery_v, t.power_w, sensed.wheel_rad,
                         sensed.has_imu, sensed.bump.pressed});
      HingeState forks;
      forks.TakeSteering(plant.truth().hinges);
      // And back: less friction shows in wheels that must turn round.
      const bool back = plant.truth().t_s > kEnd_s / 2;
      drive->ToWheels(back ? BodyTwist{-askew.vx_mps, -askew.vy_mps, -askew.wz_radps} : askew,
                      forks, wheels);
      plant.Apply({.twist = {}, .wheel_radps = wheels, .hinges = forks});
      for (int i = 0; i < kStepsAControl; ++i) EXPECT_TRUE(plant.Step());
    }
    return moments;
  }
  std::vector<Moment> Drive(std::span<const ScheduledFault> faults) {
    PhysicsPlant plant = Plant(faults);
    return Drive(plant);
  }

  const HazardMap map_ = Floor();
  const RobotModel robot_;
  const Scene scene_;
  std::vector<NamedSensor> sensors_;
  std::string refused_;
};

TEST_P(FaultConformance, ParametersAreDocumentedAndAreNotTheSchedules) {
  const auto dut = std::get<0>(GetParam()).make();
  struct Timing final : Configurable {
    void Visit(ParamVisitor& v) override { keys.Visit(v); }
    FaultTiming keys;
  } timing;
  std::vector<std::string> taken = {"type", "id"};
  for (const ParamDoc& doc : DocumentParams(timing)) taken.push_back(doc.name);
  for (const ParamDoc& doc : DocumentParams(*dut)) {
    EXPECT_FALSE(doc.help.empty()) << doc.name;
    EXPECT_EQ(std::ranges::count(taken, doc.name), 0) << doc.name;
  }
}

TEST_P(FaultConformance, IsNoticedFromItsOnsetAndNotBefore) {
  const auto faults = Made({.onset_s = kOnset_s, .duration_s = {}, .period_s = {}});
  if (faults.empty()) GTEST_SKIP() << refused_;
  const auto sound = Drive({}), broken = Drive(faults);
  ASSERT_EQ(sound.size(), broken.size());
  const auto onset = static_cast<std::size_t>(std::lround(kOnset_s / kControl_s));
  for (std::size_t i = 0; i < onset; ++i) EXPECT_EQ(sound[i], broken[i]) << "period " << i;
  EXPECT_NE(sound.back(), broken.back());
}

TEST_P(FaultConformance, ThatNeverComesChangesNoBit) {
  const auto faults = Made({.onset_s = 1e6, .duration_s = {}, .period_s = {}});
  if (faults.empty()) GTEST_SKIP() << refused_;
  EXPECT_EQ(Drive(faults), Drive({}));
}

// Whether it had ended or not.
TEST_P(FaultConformance, TheNextEpisodeBeginsSound) {
  for (const std::optional<double> duration_s : {std::optional<double>(), {kDuration_s}}) {
    const auto faults = Made({.onset_s = kOnset_s, .duration_s = duration_s, .period_s = {}});
    if (faults.empty()) GTEST_SKIP() << refused_;
    PhysicsPlant plant = Plant(faults);
    const auto once = Drive(plant);
    EXPECT_EQ(Drive(plant), once);
  }
}

// A fault that sets a value would undo what another one broke.
TEST_P(FaultConformance, BreaksOnTopOfWhatIsBroken) {
  const auto faults = Made();
  if (faults.empty()) GTEST_SKIP() << refused_;
  const std::size_t n = robot_.spec.wheels.size();
  Alterations built, broken;
  built.wheel_torque.assign(n, 1);
  built.wheel_stuck_radps.assign(n, {});
  built.wheel_friction.assign(n, {});
  built.roller_drag.assign(n, 0);
  broken = built;
  broken.wheel_torque.assign(n, 0.5);
  broken.roller_drag.assign(n, 0.5);
  broken.floor_friction = broken.battery_voltage = 0.5;
  broken.motor_resistance = broken.hotel_load = 2;
  broken.payload_kg = 3;
  broken.silent_sensors = {"another"};
  Alterations from_built = built, from_broken = broken;
  faults[0].fault->Break(from_built);
  faults[0].fault->Break(from_broken);
  EXPECT_NE(from_built, built);
  // What it changed is less, or more, than it was by the same share; the rest stays.
  const auto scales = [](double was, double is, double from, double to, const char* what) {
    EXPECT_NEAR(to, from * is / was, 1e-12) << what;
  };
  for (std::size_t i = 0; i < n; ++i) {
    scales(1, from_built.wheel_torque[i], 0.5, from_broken.wheel_torque[i], "wheel_torque");
    scales(1, 1 - from_built.roller_drag[i], 0.5, 1 - from_broken.roller_drag[i], "roller_drag");
  }
  scales(1, from_built.floor_friction, 0.5, from_broken.floor_friction, "floor_friction");
  scales(1, from_built.battery_voltage, 0.5, from_broken.battery_voltage, "battery_voltage");
  scales(1, from_built.motor_resistance, 2, from_broken.motor_resistance, "motor_resistance");
  scales(1, from_built.hotel_load, 2, from_broken.hotel_load, "hotel_load");
  EXPECT_NEAR(from_broken.payload_kg, from_built.payload_kg + 3, 1e-12);
  EXPECT_EQ(from_broken.silent_sensors.size(), from_built.silent_sensors.size() + 1);
  Alterations again = built;
  faults[0].fault->Break(again);
  EXPECT_EQ(again, from_built) << "it does not depend on how often it was asked";
}

INSTANTIATE_TEST_SUITE_P(All, FaultConformance,
                         testing::Combine(testing::ValuesIn(Faults()),
                                          testing::ValuesIn(RobotNames())),
                         [](const auto& suite) {
                           return std::string(std::get<0>(suite.param).name) + "_" +
                                  std::get<1>(suite.param);
                         });

}  // namespace
}  // namespace floorproof
