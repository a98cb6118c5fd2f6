// SPDX-License-Identifier: Apache-2.0
// A motor that runs whatever it is told: a transistor of its driver has fused. At full voltage it
// would hold its speed without load. Of two on one wheel the later in the list counts.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class StuckMotor final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("wheel", wheel_, {}, "name of the driven wheel's joint in the robot's model, or all");
    v("speed_share", speed_share_, Between(-1, 1),
      "of its motor's speed without load; negative: backwards; 0: it holds still");
  }
  void Start(const FaultContext& context) override {
    wheels_ = FindWheels(context.robot, wheel_);
    radps_.clear();
    for (const std::size_t wheel : wheels_)
      radps_.push_back(speed_share_ * context.robot.wheels[wheel].max_speed_radps);
  }
  void Break(Alterations& alterations) const override {
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      alterations.wheel_stuck_radps[wheels_[i]] = radps_[i];
  }

 private:
  std::string wheel_ = kAll;
  double speed_share_ = 1;
  std::vector<std::size_t> wheels_;
  std::vector<double> radps_;  // of these
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, StuckMotor)

}  // namespace floorproof
