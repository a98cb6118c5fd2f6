// SPDX-License-Identifier: Apache-2.0
// BELUGA drives an audit: where its sensor is while it takes samples.
#include <algorithm>
#include <cmath>

#include "run/episode/make_plan.h"
#include "run/scenario/scenario.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class AuditDrive : public ScenarioTest {};

// In a room of 8 m x 4 m: two places beside walls, one in a corner, one in the open.
TEST_F(AuditDrive, TheSensorStandsOverEachPlaceAndTheRobotTouchesNothing) {
  Save("points.csv", "x_m,y_m\n2.0,0.6\n0.65,0.65\n3.0,2.0\n2.5,4.4\n");
  Scenario s = Read(RoomScenario("", "start: {x_m: 1, y_m: 1}\n"),
                    {{"plan", "{planner: audit, samples: {file: points.csv}}"}});
  const PlanResult plan = MakePlan(s);
  ASSERT_EQ(plan.status, PlanStatus::kSuccess) << plan.message;
  ASSERT_TRUE(std::ranges::all_of(plan.samples, &SamplePlace::reachable));
  const double sensor_x_m = s.world.robot.spec.audit_sensor_x_m;
  const double dwell_s = s.world.robot.spec.audit_dwell_s;
  const EpisodeRecord record = Drive(std::move(s));
  EXPECT_EQ(record.outcome, Outcome::kSuccess) << record.message;
  EXPECT_EQ(record.metrics.contacts, 0);
  for (const SamplePlace& sample : plan.samples) {
    double over_s = 0;
    for (std::size_t i = 1; i < record.trace.size(); ++i) {
      const TraceRow& row = record.trace[i];
      const Pose2 X_WB{row.x_m, row.y_m, row.yaw_rad};
      if ((X_WB * Vec2(sensor_x_m, 0) - sample.p_W).norm() < 0.03)
        over_s += row.t_s - record.trace[i - 1].t_s;
    }
    EXPECT_GT(over_s, 0.9 * dwell_s) << sample.p_W.transpose();
    EXPECT_LT(over_s, 1.5 * dwell_s) << sample.p_W.transpose();
  }
}

}  // namespace
}  // namespace floorproof
