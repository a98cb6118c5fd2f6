// SPDX-License-Identifier: Apache-2.0
// A wheel whose tread, or whose rollers', is worn, wet or oily: it finds no more friction than this
// on floors and hazards. Of two on one wheel the slipperier counts.
#include <algorithm>

#include "env/faults/fault.h"

namespace floorproof {
namespace {

class SlipperyWheel final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("wheel", wheel_, {}, "name of the driven wheel's joint in the robot's model, or all");
    v("friction", friction_, Between(0.001, 2), "the most that it finds, a friction coefficient");
  }
  void Start(const FaultContext& context) override { wheels_ = FindWheels(context.robot, wheel_); }
  void Break(Alterations& alterations) const override {
    for (const std::size_t wheel : wheels_) {
      std::optional<double>& most = alterations.wheel_friction[wheel];
      most = std::min(most.value_or(friction_), friction_);
    }
  }

 private:
  std::string wheel_ = kAll;
  double friction_ = 0.1;
  std::vector<std::size_t> wheels_;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, SlipperyWheel)

}  // namespace floorproof
