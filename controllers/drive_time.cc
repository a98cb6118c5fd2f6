// SPDX-License-Identifier: Apache-2.0
#include "controllers/drive_time.h"

#include <algorithm>
#include <cmath>

#include "controllers/follower_params.h"

namespace floorproof {
namespace {

// A way (m, or rad) along which a robot gathers speed at `accel`, keeps to `top`, and slows down as
// StoppingSpeed does; it is over where `rest` is left of it.
struct Profile {
  double accel = 0, decel = 0, lag_s = 0, top = 0, rest = 0;

  // The speed from which it slows down to `then` within the way.
  double Before(double then, double way) const {
    const double b = decel * lag_s;
    return std::sqrt((then + b) * (then + b) + 2 * decel * std::max(0.0, way)) - b;
  }

  // The time, and the speed at the end. It begins with at most `from` and ends with at most `to`.
  double Time(double way, double from, double to, double& at_end) const {
    to = std::max(to, Before(0, rest));  // nobody creeps to the very end
    from = std::min({from, top, Before(to, way)});
    const auto reached = [&](double x) { return std::sqrt(from * from + 2 * accel * x); };
    double low = 0, high = way;  // how far the robot gathers speed
    if (reached(way) <= std::min(to, top)) low = way;
    for (int i = 0; i < 40 && low < way; ++i) {
      const double x = 0.5 * (low + high);
      (reached(x) < std::min(top, Before(to, way - x)) ? low : high) = x;
    }
    const double peak = std::max(reached(low), 1e-9), end = std::min(to, peak);
    // From the peak down: v dv/ds = -decel v / (v + b), so t = (peak - end) / decel + lag ln(...).
    const double b = decel * lag_s;
    const double slowing = ((peak + b) * (peak + b) - (end + b) * (end + b)) / (2 * decel);
    at_end = end;
    return (peak - from) / accel + std::max(0.0, way - low - slowing) / peak +
           (peak - end) / decel + lag_s * std::log(peak / end);
  }
};

double Heading(const ReferenceVertex& leg) {
  return leg.yaw_rad.value_or(std::atan2(leg.direction_W.y(), leg.direction_W.x()));
}

}  // namespace

double DriveTime(const ReferencePath& path, const DriveTimeLimits& limits, const RobotSpec& robot) {
  const ReferenceLimits& reference = limits.reference;
  Profile along{robot.max_accel_mps2, reference.decel_mps2, reference.lag_s, 0, limits.tolerance_m};
  const Profile about{robot.max_yaw_accel_radps2, kPlannedShare * robot.max_yaw_accel_radps2,
                      reference.lag_s, robot.max_yaw_rate_radps, limits.tolerance_rad};
  double time_s = 0, speed_mps = 0;
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    const ReferenceVertex& vertex = path.vertices[i];
    const auto turn = [&](double turn_rad) {
      double at_end = 0;
      time_s += about.Time(turn_rad, 0, 0, at_end) + reference.lag_s;
    };
    double facing_rad = i == 0 ? Heading(vertex) : Heading(path.vertices[i - 1]);
    for (const ReferenceDwell& dwell : vertex.dwells) {
      time_s += dwell.time_s;
      if (!dwell.face_rad) continue;
      const double turn_rad = std::abs(WrapAngle(*dwell.face_rad - facing_rad));
      if (turn_rad > limits.tolerance_rad) turn(turn_rad);
      facing_rad = *dwell.face_rad;
    }
    if (i + 1 == path.vertices.size()) break;
    const double turn_rad = std::abs(WrapAngle(Heading(vertex) - facing_rad));
    if ((vertex.stop && turn_rad > limits.tolerance_rad) || turn_rad > limits.turn_above_rad) {
      turn(turn_rad);
      speed_mps = 0;
    }
    if (vertex.stop) {
      speed_mps = 0;
      time_s += reference.lag_s;  // the wheels follow late
    }
    const ReferenceVertex& next = path.vertices[i + 1];
    along.top = vertex.speed_mps;
    time_s += along.Time(next.s_m - vertex.s_m, speed_mps, next.passing_mps, speed_mps);
  }
  return time_s;
}

}  // namespace floorproof
