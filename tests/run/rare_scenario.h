// SPDX-License-Identifier: Apache-2.0
// A robot that takes itself to be beside its line: it drives as far beside it, on the other side,
// and veers off where that is more than it may. How far decides, so the truth is known.
#pragma once

#include <string>
#include <vector>

#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {

class RareScenarioTest : public ScenarioTest {
 protected:
  static constexpr double kAllowed_m = 0.05;

  RareScenarioTest() {
    Save("plan.csv", "x_m,y_m\n1.2,1.25\n1.9,1.25\n");
    SaveScenario(
        "{estimator.start_error_y_m: {normal: [0, 0.02]}, site.floor.friction: {uniform: "
        "[0.6, 0.9]}}");
  }
  void SaveScenario(const std::string& randomise, const std::string& hazards = "[]") const {
    Save("s.yaml", R"(scenario: 1
name: beside its line
seed: 5
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      #########
      #.......#
      #.......#
      #.......#
      #########
  start: {x_m: 1.2, y_m: 1.25, yaw_deg: 0}
  hazards: )" + hazards +
                       R"(
robot: beluga
plan: {file: plan.csv}
failures:
  veer_off: {max_cross_track_m: 0.05, duration_s: 0}
  stuck: {}
estimator: odometry
sensors:
  imu: {gyro_noise_radps: 0, gyro_bias_radps: 0, accel_noise_mps2: 0, accel_bias_mps2: 0}
physics: {timestep_s: 0.005}
control_hz: 20
trace_hz: 10
randomise: )" + randomise +
                       "\n");
  }

  ScenarioFile File(const std::vector<Override>& overrides = {}) const {
    return ScenarioFile(folder_ / "s.yaml", overrides);
  }
  static Drawn Believing(double error_m) {
    return {{"estimator.start_error_y_m", ConfigNode::Scalar(std::to_string(error_m))},
            {"site.floor.friction", ConfigNode::Scalar("0.75")}};
  }
};

}  // namespace floorproof
