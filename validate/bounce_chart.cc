// SPDX-License-Identifier: Apache-2.0
#include "validate/bounce_chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "env/failures/detector.h"
#include "validate/parallel.h"
#include "validate/rig.h"

namespace floorproof {
namespace {

void Meet(BounceRow& row) {
  constexpr double kNearest_m = 0.4, kBefore_m = 0.04, kWatch_s = 1.5;
  const RobotSpec robot = ReadRobot(FindRobotFile(row.robot, {})).spec;
  const double pane_m = std::max(kNearest_m, robot.circumscribed_radius_m + kBefore_m);
  RigOptions options;
  options.changes.mass_kg = row.mass_kg;
  options.hazards = {
      Prism("pane", {{pane_m, -2}, {pane_m + 0.01, -2}, {pane_m + 0.01, 2}, {pane_m, 2}}, {}, 1)};
  options.hazards.front().material.restitution = row.restitution;
  Rig rig(row.robot, std::move(options));
  const auto detector = MakePlugin(Detectors(), "bounce_back", "detector");
  detector->Start({rig.map(), rig.robot(), rig.sim().model()->opt.timestep});
  const BodyTwist ahead{row.speed_mps, 0, 0};
  rig.Command(ahead);
  Sample sample;
  sample.command.twist = ahead;
  double met_s = -1;
  bool back = false, over = false;
  while (met_s < 0 || rig.truth().t_s < met_s + kWatch_s) {
    const double before_mps = rig.truth().V_WB_B.vx_mps;
    rig.Step();
    static_cast<Truth&>(sample) = rig.truth();
    row.bounce_back = detector->Update(sample) || row.bounce_back;
    if (met_s < 0 && rig.truth().num_contacts > 0) {
      met_s = rig.truth().t_s;
      row.closing_mps = before_mps;
    }
    if (met_s < 0 || over) continue;
    const double away_mps = -rig.truth().V_WB_B.vx_mps;
    over = back && away_mps < 0;
    back = back || away_mps > 0;
    row.rebound_mps = std::max(row.rebound_mps, away_mps);
  }
}

}  // namespace

std::vector<BounceRow> BounceChart(int jobs) {
  std::vector<BounceRow> rows;
  for (const RobotEntry& entry : Robots()) {
    const std::string robot(entry.name);
    const double mass_kg = ReadRobot(FindRobotFile(robot, {})).spec.mass_kg;
    for (const double restitution : {0.0, 0.1, 0.3, 0.5, 0.7})
      for (const double speed_mps : {0.1, 0.2, 0.3, 0.4})
        for (const double share : {0.5, 1.0, 2.0}) {
          BounceRow row;
          row.robot = robot;
          row.restitution = restitution;
          row.speed_mps = speed_mps;
          row.mass_kg = share * mass_kg;
          rows.push_back(std::move(row));
        }
  }
  RunParallel(static_cast<int>(rows.size()), jobs,
              [&](int i) { Meet(rows[static_cast<std::size_t>(i)]); });
  return rows;
}

std::string BounceCsv(std::span<const BounceRow> rows) {
  std::string out = "robot,restitution,speed_mps,mass_kg,closing_mps,rebound_mps,bounce_back\n";
  for (const BounceRow& row : rows)
    out +=
        fmt::format("{},{},{},{:.4g},{:.3f},{:.3f},{}\n", row.robot, row.restitution, row.speed_mps,
                    row.mass_kg, row.closing_mps, row.rebound_mps, row.bounce_back ? 1 : 0);
  return out;
}

}  // namespace floorproof
