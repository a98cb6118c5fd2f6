// SPDX-License-Identifier: Apache-2.0
// A bumper all round the shell: pressed when the body met an obstacle with enough force in any
// physics step since the last control period. Where: the middle of what pressed in the hardest of
// these steps, weighed by force, so that a wall met flat is straight ahead.
#include <cmath>

#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class Bumper final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kBump; }
  bool draws() const override { return false; }
  void Visit(ParamVisitor& v) override {
    v("force_n", force_n_, Positive(), "that presses it (N)");
  }

  void Start(const SensorContext& context, const mjData*, const Truth&, const Stream&,
             Observation& out) override {
    timestep_s_ = context.scene.model->opt.timestep;
    hardest_n_ = 0;
    out.bump = {};
  }

  void OnStep(const Truth& truth) override {
    double force_n = 0;
    Vec2 moment_W = Vec2::Zero();
    for (int i = 0; i < truth.num_contacts; ++i) {
      const ObstacleContact& contact = truth.contacts[static_cast<std::size_t>(i)];
      if (contact.wheel) continue;  // the bumper is round the body
      const double pushes_n = contact.impulse_ns / timestep_s_;
      force_n += pushes_n;
      moment_W += pushes_n * contact.p_W;
    }
    if (force_n < force_n_ || force_n <= hardest_n_) return;
    hardest_n_ = force_n;
    const Vec2 p_B = truth.X_WB().Inverse() * Vec2(moment_W / force_n);
    bearing_rad_ = std::atan2(p_B.y(), p_B.x());
  }

  void Sense(mjData*, const Truth&, Observation& out) override {
    out.bump = {hardest_n_ > 0, hardest_n_ > 0 ? bearing_rad_ : 0};
    hardest_n_ = 0;
  }

  void Silence(Observation& out) const override { out.bump = {}; }

 private:
  double force_n_ = 3;  // the spring of a light bumper
  double timestep_s_ = 0.004, hardest_n_ = 0, bearing_rad_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Bumper)

}  // namespace floorproof
