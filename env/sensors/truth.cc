// SPDX-License-Identifier: Apache-2.0
// Truth as a sensor: where the robot really is, for the estimator `truth`, and for whoever wants to
// see what a perfect sensor would change. No robot carries it.
#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

class TruthSensor final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kTruth; }
  bool draws() const override { return false; }
  void Visit(ParamVisitor&) override {}
  void Start(const SensorContext&, const mjData*, const Truth& truth, const Stream&,
             Observation& out) override {
    out.truth = TruePose{truth.X_WB(), truth.V_WB_B, truth.hinges};
  }
  void Sense(mjData*, const Truth& truth, Observation& out) override {
    out.truth = TruePose{truth.X_WB(), truth.V_WB_B, truth.hinges};
  }
  void Silence(Observation& out) const override { out.truth.reset(); }
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, TruthSensor)

}  // namespace floorproof
