// SPDX-License-Identifier: Apache-2.0
// A load that lies on the robot where it should not: a full tank that sloshed, a box put on top. It
// is a point mass; two of them count as one at the centre of both.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class ShiftedLoad final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("mass_kg", mass_kg_, {0, 1000, true}, "of the load (kg)");
    v("x_m", p_B_.x(), Between(-10, 10), "its place in the frame of the robot's base, forward (m)");
    v("y_m", p_B_.y(), Between(-10, 10), "to the left (m)");
    v("z_m", p_B_.z(), Between(0, 10), "above the floor (m)");
  }
  void Start(const FaultContext&) override {}
  void Break(Alterations& alterations) const override {
    const double mass_kg = alterations.payload_kg + mass_kg_;
    alterations.payload_p_B =
        (alterations.payload_kg * alterations.payload_p_B + mass_kg_ * p_B_) / mass_kg;
    alterations.payload_kg = mass_kg;
  }

 private:
  double mass_kg_ = 1;
  Vec3 p_B_ = {0, 0, 0.2};
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, ShiftedLoad)

}  // namespace floorproof
