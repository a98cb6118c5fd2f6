// SPDX-License-Identifier: Apache-2.0
#include "validate/climb.h"

#include <algorithm>

#include "env/scene/wheel_collider.h"

namespace floorproof {

ClimbPlace PlaceEdge(Rig& rig, bool sideways, double run_up_m) {
  const mjModel* m = rig.scene().model.get();
  double wheel_m = 0, rim_m = 0;
  for (int g = 0; g < m->ngeom; ++g) {
    if (rig.scene().roles[static_cast<std::size_t>(g)].kind != GeomRole::Kind::kWheel ||
        m->geom_type[g] != mjGEOM_CYLINDER)
      continue;
    const double rollers_m = RollersOf(m, g).radius_m;
    const double at_m = rig.data()->geom_xpos[3 * g + (sideways ? 1 : 0)];
    wheel_m = std::max(wheel_m, at_m);
    rim_m = std::max(rim_m, at_m + m->geom_size[3 * g + (sideways ? 1 : 0)] + rollers_m);
  }
  return {rim_m + run_up_m, rim_m + run_up_m + wheel_m};
}

Hazard Ledge(double height_m, double edge_m, bool sideways) {
  constexpr double kFar_m = 8;
  return Prism("ledge",
               sideways ? Rectangle({-kFar_m, edge_m}, {kFar_m, kFar_m})
                        : Rectangle({edge_m, -kFar_m}, {kFar_m, kFar_m}),
               {}, height_m);
}

bool Climbs(Rig& rig, double end_m, bool sideways, double speed_mps) {
  constexpr double kProgress_m = 0.001, kPatience_m = 0.06;
  double way_m = 0, last_s = rig.truth().t_s;
  while (way_m < end_m) {
    rig.Step();
    const double now_m = sideways ? rig.truth().p_WB.y() : rig.truth().p_WB.x();
    if (now_m > way_m + kProgress_m) {
      way_m = now_m;
      last_s = rig.truth().t_s;
    }
    if (rig.truth().t_s - last_s > kPatience_m / speed_mps) return false;
  }
  return true;
}

double HighestStep(const std::string& robot, double speed_mps, const PhysicsParams& physics,
                   const WrongModel& wrong) {
  constexpr double kMost = 1.2, kResolution = 0.0025;  // of the wheels' radius
  constexpr double kRunUp_m = 0.05;
  Rig truth(robot);
  const ClimbPlace place = PlaceEdge(truth, false, kRunUp_m + speed_mps * speed_mps / 4);
  const double radius_m = truth.robot().wheels.front().radius_m;
  return HighestClimbed(0, kMost * radius_m, kResolution * radius_m, place, false, speed_mps,
                        [&](RigOptions options) {
                          options.physics = physics;
                          options.wrong = wrong;
                          Rig rig(robot, std::move(options));
                          rig.Command({speed_mps, 0, 0});
                          return rig;
                        });
}

}  // namespace floorproof
