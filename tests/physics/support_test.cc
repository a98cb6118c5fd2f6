// SPDX-License-Identifier: Apache-2.0
// What stands, rocks or leans has not tipped; what turns over an edge was not thrown back.
#include <gmock/gmock.h>

#include "run/scenario/override.h"
#include "tests/physics/one_caster.h"
#include "tests/run/scenario_text.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Field;
using ::testing::IsEmpty;

class Support : public ScenarioTest {
 protected:
  Support() { Save("one_caster.xml", kOneCaster); }

  EpisodeRecord DriveAlong(const std::string& robot, const std::string& hazards, double to_m,
                           double speed_mps, std::vector<Override> more = {}) const {
    Save("plan.csv", "x_m,y_m,speed_mps\n1.5,2.5," + std::to_string(speed_mps) + "\n" +
                         std::to_string(to_m) + ",2.5," + std::to_string(speed_mps) + "\n");
    more.push_back({"robot", robot});
    return Drive(Read(RoomScenario(hazards), more));
  }
};

// Its nose rises, for the wall pushes above the floor and the wheels at it, until the body's rear
// edge carries it: its mass is ahead of that edge and its wheels, and the wall holds it there.
TEST_F(Support, LeaningBackFromAWallIsNoTip) {
  for (const double speed_mps : {0.1, 0.2, 0.3}) {
    const EpisodeRecord dut = DriveAlong("one_caster.xml", "", 8.4, speed_mps);
    SCOPED_TRACE(speed_mps);
    ASSERT_EQ(dut.events.size(), 1u);
    EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
    EXPECT_EQ(dut.events[0].hazard, "wall");
  }
}

// Its wheels hang in two holes; it stands on its caster and the rear edge of its body.
TEST_F(Support, StandingOnTwoPointsIsHighCentred) {
  const auto hole = [](double y_m) {
    const std::string low = std::to_string(y_m - 0.05), high = std::to_string(y_m + 0.05);
    return "{type: step, known: false, height_m: -0.06, polygon_m: [[2.9, " + low + "], [3.1, " +
           low + "], [3.1, " + high + "], [2.9, " + high + "]]}";
  };
  const EpisodeRecord dut =
      DriveAlong("one_caster.xml", hole(2.63) + ", " + hole(2.37), 6, 0.1,
                 {{"failures.roll_over.fall_m", "0.1"}});  // the wheels hang lower than that
  ASSERT_FALSE(dut.events.empty());
  EXPECT_EQ(dut.events[0].mode, FailureMode::kStuck);
  EXPECT_EQ(dut.events[0].kind, "high_centred");
  EXPECT_THAT(dut.events, Each(Field(&Event::mode, FailureMode::kStuck)));
}

// BELUGA's casters swing from one end to the other while its wheels are on the cover.
TEST_F(Support, RockingOverACoverIsNoTip) {
  const std::string cover =
      "{type: cable_cover, line_m: [[3, 0.7], [3, 4.3]], width_m: 0.136, top_width_m: 0.05, "
      "height_m: 0.02}";
  for (const double speed_mps : {0.06, 0.08, 0.09, 0.1, 0.11, 0.13, 0.2}) {
    const EpisodeRecord dut = DriveAlong("beluga", cover, 4.5, speed_mps);
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << speed_mps;
    EXPECT_THAT(dut.events, IsEmpty()) << speed_mps;
  }
}

// As it turns where it stands a caster meets the edge and swings over it, and the robot drifts by
// millimetres.
TEST_F(Support, TurningOverAnEdgeIsNoRebound) {
  const std::string sill =
      "{type: step, height_m: 0.006, polygon_m: [[3, 0.7], [3.1, 0.7], [3.1, 4.3], [3, 4.3]]}";
  for (int mm = 3060; mm <= 3160; mm += 10) {
    const std::string x_m = std::to_string(mm / 1000.0);
    Save("plan.csv",
         "x_m,y_m,speed_mps\n1.5,2.5,0.25\n" + x_m + ",2.5,0.25\n" + x_m + ",1.2,0.25\n");
    const EpisodeRecord dut = Drive(Read(RoomScenario(sill)));
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << x_m;
    EXPECT_THAT(dut.events, IsEmpty()) << x_m;
  }
}

// A slope is no obstacle, however much the wheels scrub on it.
TEST_F(Support, TurningOnASlopeMeetsNoObstacle) {
  constexpr double kSlope_rad = 3 * kPi / 180, kHalf_m = 3;
  const double rise_m = kHalf_m * std::tan(kSlope_rad);
  for (const char* robot : {"beluga", "htetro", "rover"}) {
    RigOptions options;
    Hazard slope =
        Prism("slope", Rectangle({-kHalf_m, -kHalf_m}, {kHalf_m, kHalf_m}), {}, 2 * rise_m);
    slope.solids.front().gradient = {std::tan(kSlope_rad), 0};
    options.hazards = {slope};
    Rig dut(robot, std::move(options));
    dut.SetBase({0, 0, rise_m + 0.002},
                Eigen::Quaterniond(Eigen::AngleAxisd(-kSlope_rad, Vec3::UnitY())), Vec3::Zero());
    for (const double turn_radps : {0.9, -0.5, 0.9}) {
      dut.Command({0, 0, turn_radps});
      for (const double until_s = dut.truth().t_s + 8; dut.truth().t_s < until_s;) {
        dut.Step();
        ASSERT_EQ(dut.truth().num_contacts, 0) << robot << " after " << dut.truth().t_s << " s";
      }
    }
  }
}

}  // namespace
}  // namespace floorproof
