// SPDX-License-Identifier: Apache-2.0
// A failure with its evidence.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace floorproof {

// Failure modes F1-F4 of the hTetro FMEA paper.
enum class FailureMode { kVeerOff, kStuck, kRollOver, kBounceBack };
inline constexpr int kNumFailureModes = 4;

constexpr std::string_view Name(FailureMode mode) {
  switch (mode) {
    case FailureMode::kVeerOff:
      return "veer_off";
    case FailureMode::kStuck:
      return "stuck";
    case FailureMode::kRollOver:
      return "roll_over";
    case FailureMode::kBounceBack:
      return "bounce_back";
  }
  return "?";
}

struct Event {
  FailureMode mode = FailureMode::kVeerOff;
  std::string
      kind;  // finer name within the mode, as `fell`, `tipped`, `high_centred`; may be empty
  double t_s = 0;
  double x_m = 0, y_m = 0, yaw_rad = 0;  // of the robot, world frame
  std::string hazard;  // id of the hazard met; "wall" for the map's own; empty: none near
  double value = 0, threshold = 0;  // the inequality's two sides, in the mode's unit
  std::string effect;               // E1..E5 of the FMEA paper, Table 2
  // What else was measured, by name with unit suffix (closing_mps, travel_back_m), in order.
  std::vector<std::pair<std::string, double>> evidence;
};

}  // namespace floorproof
