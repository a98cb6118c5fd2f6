// SPDX-License-Identifier: Apache-2.0
// How robots stand and stop on a slope: held, within a millimetre a minute; or let go, by
// their weight.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

// Where the robot was in a dwell, from a moment after it began.
class DwellPlaces final : public EpisodeObserver {
 public:
  bool OnControl(const EpisodeView& now) override {
    constexpr double kSettles_s = 2;
    if (!now.sample.command.dwelling) return true;
    if (since_s < 0) since_s = now.sample.t_s;
    if (now.sample.t_s - since_s < kSettles_s) return true;
    if (first_W.hasNaN()) first_W = now.sample.p_WB;
    last_W = now.sample.p_WB;
    until_s = now.sample.t_s;
    return true;
  }
  double moved_m() const { return (last_W - first_W).norm(); }
  double minutes() const { return (until_s - since_s - 2) / 60; }
  double since_s = -1, until_s = 0;
  Vec3 first_W = Vec3::Constant(std::nan("")), last_W = Vec3::Zero();
};

class Standing : public ScenarioTest, public ::testing::WithParamInterface<const char*> {
 protected:
  EpisodeRecord OnARamp(double slope_deg, const std::string& waypoints,
                        EpisodeObserver* observer = nullptr) const {
    Save("plan.csv", "x_m,y_m,dwell_s\n1.5,2.5,0\n" + waypoints);
    const std::string ramp = fmt::format(
        "{{type: ramp, id: up, slope_deg: {}, toward_deg: 0, polygon_m: [[2.5, 0.5], "
        "[7.5, 0.5], [7.5, 4.5], [2.5, 4.5]]}}",
        slope_deg);
    return Drive(Read(RoomScenario(ramp, "on_failure: ignore\n"), {{"robot", GetParam()}}),
                 observer);
  }
};

const char* const kRobots[] = {"beluga", "htetro", "rover", "scrubber"};
INSTANTIATE_TEST_SUITE_P(Robots, Standing, ::testing::ValuesIn(kRobots),
                         [](const auto& robot) { return std::string(robot.param); });

TEST_P(Standing, OnARampARobotHardlyMoves) {
  DwellPlaces dut;
  OnARamp(4.76, "4.5,2.5,30\n4.6,2.5,0\n", &dut);  // 1:12, for 30 s
  ASSERT_GT(dut.minutes(), 0.4);
  EXPECT_LT(dut.moved_m(), 0.001 * dut.minutes());
}

// Motors that the slope holds back reach the place all the same.
TEST_P(Standing, APlanEndsOnARamp) {
  for (const double slope_deg : {4.76, 6.0}) {
    const EpisodeRecord dut = OnARamp(slope_deg, "4.5,2.5,0\n");
    EXPECT_EQ(dut.outcome, Outcome::kSuccess) << slope_deg << " deg: " << dut.message;
  }
}

}  // namespace
}  // namespace floorproof
