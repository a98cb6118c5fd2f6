// SPDX-License-Identifier: Apache-2.0
// A wheel's motor gives a share of its torque at any speed and voltage: worn brushes, a lost phase.
// Of a dead one (0) the wheel is free: it is dragged along and holds nothing.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class WeakMotor final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("wheel", wheel_, {}, "name of the driven wheel's joint in the robot's model, or all");
    v("torque_share", torque_share_, Between(0, 1), "of the torque that it gives as built");
  }
  void Start(const FaultContext& context) override { wheels_ = FindWheels(context.robot, wheel_); }
  void Break(Alterations& alterations) const override {
    for (const std::size_t wheel : wheels_) alterations.wheel_torque[wheel] *= torque_share_;
  }

 private:
  std::string wheel_ = kAll;
  double torque_share_ = 0;
  std::vector<std::size_t> wheels_;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, WeakMotor)

}  // namespace floorproof
