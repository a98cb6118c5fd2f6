// SPDX-License-Identifier: Apache-2.0
// What every registered sensor promises, on every registered robot, and on those that fold in
// another shape too.
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "env/core/robot_spec.h"
#include "tests/controllers/allocation_guard.h"
#include "tests/robots.h"
#include "tests/sensors/sensor_rig.h"

namespace floorproof {

void PrintTo(const PluginEntry<Sensor>& entry, std::ostream* os) { *os << entry.name; }

namespace {

struct Carrier {
  std::string robot;
  std::string shape;  // empty: the robot's own
  std::string Name() const { return shape.empty() ? robot : robot + "_" + shape; }
};
void PrintTo(const Carrier& carrier, std::ostream* os) { *os << carrier.Name(); }

// A robot's first shape is the one that it starts in.
std::vector<Carrier> Carriers() {
  std::vector<Carrier> carriers;
  for (const std::string& name : RobotNames()) {
    carriers.push_back({name, ""});
    const std::vector<std::string> shapes = ShapeNames(name);
    if (shapes.size() > 1) carriers.push_back({name, shapes[1]});
  }
  return carriers;
}

constexpr BodyTwist kAhead = {0.2, 0, 0.05};
constexpr int kPeriods = 60;  // the rover reaches less far ahead than the circle around it

// What a robot is told by this reading.
std::vector<double> Told(const Observation& o, Reading reading) {
  std::vector<double> told;
  const auto add = [&told](std::initializer_list<double> values) {
    told.insert(told.end(), values);
  };
  switch (reading) {
    case Reading::kWheels:
      told = o.wheel_rad;
      for (int i = 0; i < o.hinges.n; ++i) add({o.hinges.rad[i], o.hinges.radps[i]});
      break;
    case Reading::kImu:
      add({o.has_imu ? 1.0 : 0.0, o.gyro_radps.x(), o.gyro_radps.y(), o.gyro_radps.z(),
           o.accel_mps2.x(), o.accel_mps2.y(), o.accel_mps2.z()});
      break;
    case Reading::kScan:
      add({o.scan.t_s, o.scan.fresh ? 1.0 : 0.0, o.scan.X_BL.x_m, o.scan.X_BL.y_m,
           o.scan.X_BL.yaw_rad, o.scan.height_m, o.scan.least_m, o.scan.most_m});
      told.insert(told.end(), o.scan.angle_rad.begin(), o.scan.angle_rad.end());
      told.insert(told.end(), o.scan.range_m.begin(), o.scan.range_m.end());
      break;
    case Reading::kBump:
      add({o.bump.pressed ? 1.0 : 0.0, o.bump.bearing_rad});
      break;
    case Reading::kCliffs:
      for (int i = 0; i < o.cliffs.n; ++i)
        add({o.cliffs.p_B[i].x(), o.cliffs.p_B[i].y(), o.cliffs.drop[i] ? 1.0 : 0.0});
      break;
    case Reading::kPower:
      add({o.power.heard ? 1.0 : 0.0, o.power.battery_v});
      told.insert(told.end(), o.power.motor_a.begin(), o.power.motor_a.end());
      break;
    case Reading::kTruth:
      if (o.truth)
        add({o.truth->X_WB.x_m, o.truth->X_WB.y_m, o.truth->X_WB.yaw_rad, o.truth->V_WB_B.vx_mps,
             o.truth->V_WB_B.vy_mps, o.truth->V_WB_B.wz_radps});
      break;
  }
  return told;
}
std::vector<double> Told(const Observation& o) {
  std::vector<double> told;
  for (const Reading reading : kReadings) {
    const std::vector<double> part = Told(o, reading);
    told.insert(told.end(), part.begin(), part.end());
  }
  return told;
}

// Sets every key that says how wrong a sensor is.
class MakeNoisy final : public ParamVisitor {
 public:
  void operator()(const char* name, double& value, const Bounds&, const char*) override {
    if (std::string(name).find("noise") == std::string::npos) return;
    value = 0.1;
    noisy = true;
  }
  void operator()(const char*, int&, const Bounds&, const char*) override {}
  void operator()(const char*, bool&, const char*) override {}
  void operator()(const char*, std::string&, const std::vector<std::string>&,
                  const char*) override {}
  void operator()(const char*, std::optional<double>&, const Bounds&, const char*) override {}
  void Group(const char*, const std::function<void(ParamVisitor&)>& visit, const char*) override {
    visit(*this);
  }
  bool noisy = false;
};

class SensorConformance : public testing::TestWithParam<std::tuple<PluginEntry<Sensor>, Carrier>> {
 protected:
  static std::unique_ptr<Sensor> Make() { return std::get<0>(GetParam()).make(); }
  static RobotChanges Changes() {
    RobotChanges changes;
    changes.shape = std::get<1>(GetParam()).shape;
    return changes;
  }
  static std::string Robot() { return std::get<1>(GetParam()).robot; }

  // A room of 6 m x 4 m; along the foot of the wall ahead the floor is missing, 5 cm wide. The
  // robot stands just before that.
  static HazardMap SlotBeforeAWall() {
    HazardMap map = Room(6, 4);
    Hazard slot = Block(HazardClass::kLevelChange, {6.95, 1}, {7, 5}, -0.1);
    slot.solids[0] = {Solid::Kind::kCut, slot.footprint[0], {}, -0.1, 0};
    map.hazards = {slot};
    return map;
  }
  Pose2 Before() const {
    const RobotSpec robot = ReadRobot(FindRobotFile(Robot(), {}), Changes()).spec;
    return {6.95 - EdgeAlong(robot.clear, 0) - 0.03, 3, 0};
  }
  // What it tells on its way to the wall.
  static std::vector<std::vector<double>> Drive(SensorRig& rig) {
    std::vector<std::vector<double>> told = {Told(rig.Sense())};
    for (int i = 0; i < kPeriods; ++i) told.push_back(Told(rig.Drive(kAhead)));
    return told;
  }
};

TEST_P(SensorConformance, ParametersAreDocumented) {
  const auto dut = Make();
  for (const ParamDoc& doc : DocumentParams(*dut)) {
    EXPECT_FALSE(doc.help.empty()) << doc.name;
    EXPECT_FALSE(doc.default_text.empty()) << doc.name;
  }
}

TEST_P(SensorConformance, TellsSomethingOfADriveIntoAWall) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  rig.Carry(Make());
  const auto told = Drive(rig);
  EXPECT_GE(std::set(told.begin(), told.end()).size(), 2u);
}

// Two sensors that fill one reading cannot be carried together: what it fills must be true.
TEST_P(SensorConformance, FillsItsReadingAndNoOther) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  const Reading own = Make()->Fills();
  rig.Carry(Make());
  std::set<std::vector<double>> told = {Told(Observation{}, own)};
  for (int i = 0; i < kPeriods; ++i) {
    const Observation& sensed = i == 0 ? rig.Sense() : rig.Drive(kAhead);
    told.insert(Told(sensed, own));
    for (const Reading reading : kReadings) {
      if (reading == own) continue;
      EXPECT_EQ(Told(sensed, reading), Told(Observation{}, reading)) << Name(reading);
    }
  }
  EXPECT_GE(told.size(), 2u);
}

// It has met the wall when the next episode starts, in the middle of a control period.
TEST_P(SensorConformance, StartForgetsTheEpisodeBefore) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  rig.Carry(Make());
  const auto once = Drive(rig);
  rig.StepOn();
  rig.Put(Before());
  rig.Start();
  EXPECT_EQ(Drive(rig), once);
}

TEST_P(SensorConformance, SenseAllocatesNothing) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  rig.Carry(Make());
  rig.Sense();
  const auto before = AllocationCount();
  for (int i = 0; i < kPeriods; ++i) rig.Drive(kAhead);
  EXPECT_EQ(AllocationCount(), before);
}

TEST_P(SensorConformance, TheSameSeedTellsTheSameAnotherOtherNoise) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  auto dut = Make();
  MakeNoisy make;
  dut->Visit(make);
  rig.Carry(std::move(dut));
  const auto told = [&](std::uint64_t seed) {
    rig.Put(Before());
    rig.Start(seed);
    return Drive(rig);
  };
  const auto one = told(1), two = told(2);
  EXPECT_EQ(told(1), one);
  if (make.noisy) {
    EXPECT_NE(two, one);
  } else {
    EXPECT_EQ(two, one) << "without a key for its noise it draws nothing";
  }
}

// A campaign asks it whether its episodes can differ.
TEST_P(SensorConformance, SaysWhetherItDraws) {
  SensorRig rig(SlotBeforeAWall(), Robot(), Before(), Changes());
  auto dut = Make();
  const bool draws = dut->draws();
  rig.Carry(std::move(dut));
  const auto told = [&](std::uint64_t seed) {
    rig.Put(Before());
    rig.Start(seed);
    return Drive(rig);
  };
  EXPECT_EQ(told(1) != told(2), draws);
}

INSTANTIATE_TEST_SUITE_P(All, SensorConformance,
                         testing::Combine(testing::ValuesIn(Sensors()),
                                          testing::ValuesIn(Carriers())),
                         [](const auto& suite) {
                           return std::string(std::get<0>(suite.param).name) + "_" +
                                  std::get<1>(suite.param).Name();
                         });

}  // namespace
}  // namespace floorproof
