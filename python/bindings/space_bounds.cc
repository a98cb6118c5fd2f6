// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/space_bounds.h"

#include <cmath>
#include <memory>

#include "base/error.h"
#include "controllers/drive.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

const char* ActionOf(const SpaceBounds& b) {
  return b.holonomic ? "vx_mps, vy_mps, wz_radps" : "vx_mps, wz_radps";
}

}  // namespace

SpaceBounds SpaceBoundsOf(const Scenario& s, const LidarScan& scan) {
  const RobotSpec& robot = s.world.robot.spec;
  SpaceBounds b;
  b.robot = s.spec.robot_name;
  const std::unique_ptr<Drive> drive = MakePlugin(Drives(), robot.drive, "drive");
  drive->Configure(robot);
  b.holonomic = drive->holonomic();
  b.max_speed_mps = static_cast<float>(robot.max_speed_mps);
  b.max_yaw_rate_radps = static_cast<float>(robot.max_yaw_rate_radps);
  // A robot that is pushed, or falls, is faster than it can drive.
  constexpr float kPushed = 2;
  b.fastest = {kPushed * b.max_speed_mps, kPushed * b.max_speed_mps,
               kPushed * b.max_yaw_rate_radps};

  b.beams = scan.range_m.size();
  if (b.beams == 0)
    throw InputError({s.spec.file.string(), 0}, "sensors.lidar", "", "is missing: it is observed");
  b.lidar_m = static_cast<float>(scan.most_m);

  const GridFrame& frame = s.world.site.map.frame;
  const double w_m = frame.width * frame.cell_m, h_m = frame.height * frame.cell_m;
  Vec2 low_W = frame.X_WG.p(), high_W = low_W;
  for (const Vec2& corner : {Vec2(w_m, 0), Vec2(0, h_m), Vec2(w_m, h_m)}) {
    low_W = low_W.cwiseMin(frame.X_WG * corner);
    high_W = high_W.cwiseMax(frame.X_WG * corner);
  }
  constexpr double kBeyond_m = 1;
  for (int i = 0; i < 2; ++i) {
    b.low[static_cast<std::size_t>(i)] = static_cast<float>(low_W[i] - kBeyond_m);
    b.high[static_cast<std::size_t>(i)] = static_cast<float>(high_W[i] + kBeyond_m);
  }
  b.plan_m = static_cast<float>(std::hypot(w_m, h_m) + 2 * kBeyond_m);
  return b;
}

std::string SpaceBounds::Lacks(const SpaceBounds& own) const {
  std::string text;
  const auto lacks = [&text](const char* name, bool is_beyond) {
    if (is_beyond) text += (text.empty() ? "" : ", ") + std::string(name);
  };
  lacks("lidar", own.lidar_m > lidar_m);
  lacks("pose", own.low[0] < low[0] || own.low[1] < low[1] || own.high[0] > high[0] ||
                    own.high[1] > high[1]);
  lacks("twist", own.fastest[0] > fastest[0] || own.fastest[2] > fastest[2]);
  lacks("plan_ahead", own.plan_m > plan_m);
  return text;
}

void RequireSameShape(const ScenarioSpec& spec, const SpaceBounds& own, const SpaceBounds& spaces) {
  if (own.holonomic != spaces.holonomic)
    throw InputError({spec.file.string(), 0}, "robot", own.robot,
                     std::string("takes ") + ActionOf(own) + ", but the action space is " +
                         spaces.robot + "'s: " + ActionOf(spaces) +
                         "; an environment of its own can drive it");
  if (own.beams != spaces.beams)
    throw InputError({spec.file.string(), 0}, "sensors.lidar.beams", std::to_string(own.beams),
                     "must be " + std::to_string(spaces.beams) +
                         ", as in the observation space: all episodes of an environment have as "
                         "many");
}

}  // namespace floorproof
