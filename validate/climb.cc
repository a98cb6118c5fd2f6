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

}  // namespace floorproof
