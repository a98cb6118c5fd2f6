// SPDX-License-Identifier: Apache-2.0
// Somebody takes the robot up and sets it down elsewhere, at rest; nobody tells it. As far on this
// way as it can stand. With a period it happens at the beginning of each.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class Kidnapped final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("forward_m", forward_m_, Between(-1000, 1000), "by how much, in its own axes (m)");
    v("left_m", left_m_, Between(-1000, 1000), "the same (m)");
    v("turn_deg", turn_deg_, Between(-180, 180), "and turned, counter-clockwise (deg)");
  }
  void Start(const FaultContext&) override {}
  void Break(Alterations& alterations) const override {
    alterations.carried =
        alterations.carried.value_or(Pose2{}) * Pose2{forward_m_, left_m_, turn_deg_ * kPi / 180};
  }

 private:
  double forward_m_ = 0, left_m_ = 0.3, turn_deg_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, Kidnapped)

}  // namespace floorproof
