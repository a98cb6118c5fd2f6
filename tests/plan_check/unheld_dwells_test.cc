// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/unheld_dwells.h"

#include <gtest/gtest.h>

#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class UnheldDwells : public ScenarioTest {
 protected:
  UnheldDwells() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }

  // The slope of the dwell at x = 4 that does not hold, deg; 0: all do.
  double Unheld(double slope_deg, Standstill standstill, double dwell_s = 5,
                double torque_factor = 1) {
    const std::string ramp =
        "{type: ramp, polygon_m: [[3, 0.5], [5, 0.5], [5, 4.5], [3, 4.5]], slope_deg: " +
        std::to_string(slope_deg) + ", toward_deg: 0}";
    Scenario s = ScenarioFile(Save("scenario.yaml", RoomScenario(ramp, ""))).Read(std::nullopt);
    s.world.robot.spec.standstill = standstill;
    for (WheelSpec& wheel : s.world.robot.spec.wheels) wheel.max_torque_nm *= torque_factor;
    PlanResult plan;
    for (const double x : {1.5, 4.0, 7.0}) {
      Waypoint& w = plan.path.emplace_back();
      w.p_W = {x, 2.5};
      w.dwell_s = dwell_s;
    }
    const auto dwell = FindUnheldDwell(s.world, plan);
    if (dwell) {
      EXPECT_EQ(dwell->p_W.x(), 4);
      EXPECT_GT(dwell->pulls_n, dwell->holds_n);
    }
    return dwell ? dwell->slope_rad * 180 / kPi : 0;
  }
};

TEST_F(UnheldDwells, AreThoseOfFreeWheelsOnAnySlope) {
  EXPECT_NEAR(Unheld(4.8, Standstill::kFree), 4.8, 1e-6);
  EXPECT_EQ(Unheld(4.8, Standstill::kFree, 0), 0) << "who does not stop does not stand";
  EXPECT_EQ(Unheld(0.1, Standstill::kFree), 0) << "its bearings hold it";
}

// BELUGA's motors push with a multiple of what it weighs on a slope that it can climb.
TEST_F(UnheldDwells, AreNoneWhereMotorsOrABrakeHold) {
  EXPECT_EQ(Unheld(4.8, Standstill::kHold), 0);
  EXPECT_EQ(Unheld(4.8, Standstill::kBrake), 0);
  EXPECT_EQ(Unheld(20, Standstill::kBrake), 0);
  EXPECT_NEAR(Unheld(4.8, Standstill::kHold, 5, 0.01), 4.8, 1e-6) << "too weak";
}

}  // namespace
}  // namespace floorproof
