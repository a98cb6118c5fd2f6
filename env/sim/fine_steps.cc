// SPDX-License-Identifier: Apache-2.0
#include "env/sim/fine_steps.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

namespace {

// Its softness was found for whole steps (restitution.h), and no tyre is in it.
bool Bounces(const mjContact& c) { return c.solref[0] > 0 && c.solref[1] < 1; }

// Sets a model's time step for as long as it lives.
class TimestepOf {
 public:
  TimestepOf(mjModel* m, double step_s) : m_(m), whole_s_(m->opt.timestep) {
    m->opt.timestep = step_s;
  }
  ~TimestepOf() { m_->opt.timestep = whole_s_; }
  TimestepOf(const TimestepOf&) = delete;
  TimestepOf& operator=(const TimestepOf&) = delete;

 private:
  mjModel* m_;
  double whole_s_;
};

}  // namespace

FineSteps::FineSteps(const Scene& scene, const RobotSpec& robot)
    : scene_(scene),
      reach_m_(robot.circumscribed_radius_m),
      cvel_(6 * static_cast<std::size_t>(scene.model->nbody)) {}

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

void FineSteps::Walk(mjModel* m, mjData* d, int parts) {
  if (parts == 1) return StepEngine(m, d);
  const double end_s = d->time + m->opt.timestep;
  const TimestepOf part(m, m->opt.timestep / parts);
  for (int k = 0; k < parts; ++k) {
    StepEngine(m, d);
    if (k == 0) std::copy_n(d->cvel, cvel_.size(), cvel_.begin());
  }
  std::ranges::copy(cvel_, d->cvel);
  d->time = end_s;
}

}  // namespace floorproof
