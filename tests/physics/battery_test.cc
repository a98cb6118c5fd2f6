// SPDX-License-Identifier: Apache-2.0
// The battery is felt: by the top speed, by the voltage under load, and when it is empty.
#include <gmock/gmock.h>

#include "run/episode/records.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

double TopSpeed(std::optional<double> battery_v) {
  Rig rig("beluga", {.changes = {.battery_v = battery_v}});
  return rig.Run({2, 0, 0}, 3).vx_mps;
}

TEST(Battery, ItsVoltageLimitsTheTopSpeed) {
  const double usual = TopSpeed({}), weak = TopSpeed(10);
  EXPECT_EQ(TopSpeed(12), usual) << "12 V is what the model states";
  EXPECT_NEAR(weak / usual, 10.0 / 12, 0.01);
}

class BatteryTest : public ScenarioTest {
 protected:
  BatteryTest() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n3,3.5\n1.5,3.5\n"); }
};

TEST_F(BatteryTest, TheDefaultIsAnIdealOne) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("")));
  EXPECT_EQ(dut.metrics.least_battery_v, 12);
  EXPECT_NEAR(dut.metrics.charge_ah * 3600 * 12, dut.metrics.energy_j, 1e-6);
  EXPECT_FALSE(dut.metrics.battery_left.has_value());
  Scenario stated = Read(RoomScenario("", "battery: {voltage_v: 12, resistance_ohm: 0}\n"));
  EXPECT_EQ(TraceCsv(dut, {}), TraceCsv(Drive(std::move(stated)), {}));
}

TEST_F(BatteryTest, InternalResistanceSagsTheVoltage) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "battery: {resistance_ohm: 0.1}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_LT(dut.metrics.least_battery_v, 12 - 0.1 * 45 / 12);
  EXPECT_GT(dut.metrics.least_battery_v, 11);
  const EpisodeRecord ideal = Drive(Read(RoomScenario("")));
  EXPECT_GT(dut.metrics.charge_ah, ideal.metrics.charge_ah) << "a lower voltage, more current";
  EXPECT_NEAR(dut.metrics.energy_j, ideal.metrics.energy_j, 0.01 * ideal.metrics.energy_j)
      << "energy is counted at the terminals";
}

// Behind 100 ohm a battery of 12 V feeds 0.36 W: not the computer alone.
TEST_F(BatteryTest, OneThatCannotFeedTheLoadStopsTheRobot) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "battery: {resistance_ohm: 100}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  EXPECT_THAT(dut.message, HasSubstr("it cannot feed that load"));
  EXPECT_EQ(dut.metrics.energy_j, 0);
}

TEST_F(BatteryTest, AnEmptyOneStopsTheRobot) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "battery: {capacity_wh: 0.05}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kFailure);
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events.front().mode, FailureMode::kStuck);
  EXPECT_THAT(dut.message, HasSubstr("it was empty"));
  EXPECT_EQ(dut.metrics.battery_left, 0);
  EXPECT_EQ(dut.metrics.least_battery_v, 0);
  EXPECT_NEAR(dut.metrics.energy_j, 0.05 * 3600, 1);
  EXPECT_EQ(dut.trace.back().power_w, 0);
}

TEST_F(BatteryTest, OneThatLastsSaysWhatIsLeft) {
  const EpisodeRecord dut = Drive(Read(RoomScenario("", "battery: {capacity_wh: 10}\n")));
  EXPECT_EQ(dut.outcome, Outcome::kSuccess);
  EXPECT_EQ(dut.message, "");
  EXPECT_NEAR(*dut.metrics.battery_left, 1 - dut.metrics.energy_j / 36000, 1e-9);
}

}  // namespace
}  // namespace floorproof
