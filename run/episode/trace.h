// SPDX-License-Identifier: Apache-2.0
// trace.csv as one table: a row a column. docs/results.md is held against it. A new column is a
// member, its row below, and the place where it is recorded (recorder.cc).
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "env/core/robot_spec.h"

namespace floorproof {

// The state at a control period; truth unless est_. What each means stands in kTraceColumns.
struct TraceRow {
  double t_s;
  double x_m, y_m, est_x_m, est_y_m;  // a map may lie far from the world's origin
  float z_m, roll_rad, pitch_rad, yaw_rad, vx_mps, vy_mps, wz_radps;
  float cmd_vx_mps, cmd_vy_mps, cmd_wz_radps, est_yaw_rad;
  float cross_track_m, power_w, coverage, revisited;
  int shape;  // as in Sample
  float est_position_std_m;
};

struct TraceColumn {
  using Text = std::string_view (*)(const TraceRow& row, const RobotSpec& robot);
  struct Time {
    double TraceRow::*value;
  };
  struct Place {
    double TraceRow::*value;
  };
  // A time, written to the millisecond; a coordinate, to a hundredth of a millimetre; a number, in
  // as many digits as it has; or a word.
  using Member = std::variant<Time, Place, float TraceRow::*, Text>;

  std::string_view name, unit;
  Member member;
  std::string_view help;  // a line of docs/results.md
};

// The name of the shape that the robot has; empty of a robot with one, and between two.
inline std::string_view ShapeName(const TraceRow& row, const RobotSpec& robot) {
  if (row.shape < 0 || robot.shapes.empty()) return {};
  return robot.shapes[static_cast<std::size_t>(row.shape)].name;
}

inline constexpr auto kTraceColumns = std::to_array<TraceColumn>({
    {"t_s", "s", TraceColumn::Time{&TraceRow::t_s}, "simulated time"},
    {"x_m", "m", TraceColumn::Place{&TraceRow::x_m}, "where the robot is, in the world"},
    {"y_m", "m", TraceColumn::Place{&TraceRow::y_m}, "likewise"},
    {"z_m", "m", &TraceRow::z_m, "height of its origin, which is on the floor below it at rest"},
    {"roll_rad", "rad", &TraceRow::roll_rad, "roll"},
    {"pitch_rad", "rad", &TraceRow::pitch_rad, "pitch"},
    {"yaw_rad", "rad", &TraceRow::yaw_rad, "heading, counter-clockwise from x"},
    {"vx_mps", "m/s", &TraceRow::vx_mps, "speed forward"},
    {"vy_mps", "m/s", &TraceRow::vy_mps, "speed to the left"},
    {"wz_radps", "rad/s", &TraceRow::wz_radps, "rate of turn"},
    {"cmd_vx_mps", "m/s", &TraceRow::cmd_vx_mps, "speed forward that the tracker asked for"},
    {"cmd_vy_mps", "m/s", &TraceRow::cmd_vy_mps, "speed to the left that it asked for"},
    {"cmd_wz_radps", "rad/s", &TraceRow::cmd_wz_radps, "rate of turn that it asked for"},
    {"est_x_m", "m", TraceColumn::Place{&TraceRow::est_x_m}, "where the robot thinks it is"},
    {"est_y_m", "m", TraceColumn::Place{&TraceRow::est_y_m}, "likewise"},
    {"est_yaw_rad", "rad", &TraceRow::est_yaw_rad, "its heading, as it thinks"},
    {"cross_track_m", "m", &TraceRow::cross_track_m, "distance of the true place from the path"},
    {"power_w", "W", &TraceRow::power_w, "electrical power of motors and all else aboard"},
    {"coverage", "", &TraceRow::coverage, "the metric `coverage` so far"},
    {"revisited", "", &TraceRow::revisited, "the metric `revisited` so far"},
    {"shape", "", &ShapeName,
     "name of the robot's shape; empty between two, and of a robot that has one only"},
    {"est_position_std_m", "m", &TraceRow::est_position_std_m,
     "standard deviation of the place, as the estimator believes"},
});

}  // namespace floorproof
