// SPDX-License-Identifier: Apache-2.0
// Hair and string round the rollers of a Mecanum wheel: they turn hard, and blocked ones (1) make
// of it a plain wheel, which does not give way to the side.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class BlockedRollers final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("wheel", wheel_, {}, "name of the driven wheel's joint in the robot's model, or all");
    v("drag", drag_, Between(0, 1), "0: the rollers run freely; 1: they are blocked");
  }
  void Start(const FaultContext& context) override {
    wheels_ = FindWheels(context.robot, wheel_);
    for (const std::size_t wheel : wheels_)
      if (context.robot.wheels[wheel].roller_radius_m == 0)
        throw InputError({}, "wheel", context.robot.wheels[wheel].name, "has no rollers");
  }
  // Blocked twice is blocked.
  void Break(Alterations& alterations) const override {
    for (const std::size_t wheel : wheels_)
      alterations.roller_drag[wheel] = 1 - (1 - alterations.roller_drag[wheel]) * (1 - drag_);
  }

 private:
  std::string wheel_ = kAll;
  double drag_ = 1;
  std::vector<std::size_t> wheels_;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, BlockedRollers)

}  // namespace floorproof
