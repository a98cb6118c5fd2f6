// SPDX-License-Identifier: Apache-2.0
#include "env/sim/fine_steps.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

namespace {

// Its softness was found for whole steps (restitution.h), and no tyre is in it.
bool Bounces(const mjContact& c) { return c.solref[0] > 0 && c.solref[1] < 1; }

}  // namespace

FineSteps::FineSteps(const Scene& scene, const RobotSpec& robot)
    : scene_(scene), reach_m_(robot.circumscribed_radius_m) {}

int FineSteps::Parts(const mjModel* m, const mjData* d, const Truth& truth) const {
  constexpr double kUpright = 0.966;  // cosine of 15 degrees
  const double speed_mps = truth.v_WB_W.norm() + std::abs(truth.V_WB_B.wz_radps) * reach_m_;
  const double ahead_m = 2 * m->opt.timestep * speed_mps;
  const auto is_foot = [this](int geom) {
    return scene_.roles[static_cast<std::size_t>(geom)].kind == GeomRole::Kind::kWheel;
  };
  for (const mjContact* c = d->contact; c < d->contact + d->ncon; ++c)
    if (!Bounces(*c) && std::abs(c->frame[2]) < kUpright && c->dist < c->includemargin + ahead_m &&
        (is_foot(c->geom[0]) || is_foot(c->geom[1])))
      return scene_.edge_steps;
  return OnFloor(m);
}

int FineSteps::OnFloor(const mjModel* m) const {
  // That takes contacts as they are at the step's begin, and so must follow tyres everywhere.
  return m->opt.integrator == mjINT_IMPLICITFAST ? scene_.edge_steps : 1;
}

}  // namespace floorproof
