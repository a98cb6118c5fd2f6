// SPDX-License-Identifier: Apache-2.0
// Cliff sensors: eight places round the robot's edge that look down along its own axis. One tells a
// drop where it sees no floor within `reach_m` below where the floor should be.
#include <algorithm>
#include <cmath>
#include <optional>

#include "env/sensors/body_frame.h"
#include "env/sensors/rays.h"
#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class Cliff final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kCliffs; }
  bool draws() const override { return false; }
  void Visit(ParamVisitor& v) override {
    v("reach_m", reach_m_, Between(0.005, 1), "a floor lower than this is a drop (m)");
    v("inset_m", inset_m_, Between(0, 0.5), "from the robot's edge inwards to the sensors (m)");
  }

  void Start(const SensorContext& context, const mjData*, const Truth&, const Stream&,
             Observation& out) override {
    rays_.emplace(context.scene);
    base_ = context.scene.base_body;
    height_m_ = std::max(context.robot.clearance_m, 0.005);
    out.cliffs = {};
    out.cliffs.n = CliffRing::kMax;
    for (int i = 0; i < CliffRing::kMax; ++i) {
      const double bearing_rad = 2 * kPi * i / CliffRing::kMax;
      const double r_m = std::max(0.0, EdgeAlong(context.robot.clear, bearing_rad) - inset_m_);
      out.cliffs.p_B[static_cast<std::size_t>(i)] = {r_m * std::cos(bearing_rad),
                                                     r_m * std::sin(bearing_rad)};
    }
  }

  void Sense(mjData* data, const Truth& truth, Observation& out) override {
    const Rotation R_WB = RotationOf(data, base_);
    const Vec3 down_W = -R_WB.col(2);
    for (int i = 0; i < out.cliffs.n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Vec3 p_B(out.cliffs.p_B[at].x(), out.cliffs.p_B[at].y(), height_m_);
      const RayHit hit = rays_->Cast(data, truth.p_WB + R_WB * p_B, down_W, 10);
      out.cliffs.drop[at] = hit.range_m > height_m_ + reach_m_;
    }
  }

  void Silence(Observation& out) const override { out.cliffs.drop = {}; }

 private:
  double reach_m_ = 0.03, inset_m_ = 0.01;
  std::optional<Rays> rays_;
  int base_ = -1;
  double height_m_ = 0.02;
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Cliff)

}  // namespace floorproof
