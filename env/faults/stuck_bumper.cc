// SPDX-License-Identifier: Apache-2.0
// A bumper that says it is pressed and goes on saying so: a bent spring, grit behind the shell.
#include <algorithm>

#include "env/faults/fault.h"

namespace floorproof {
namespace {

class StuckBumper final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("sensor", sensor_, {}, "name of the robot's bumper");
    v("bearing_deg", bearing_deg_, Between(-180, 180),
      "from the body's x to where it says it is pressed, counter-clockwise");
  }
  void Start(const FaultContext& context) override {
    if (std::ranges::find(context.sensors, sensor_) == context.sensors.end())
      throw InputError({}, "sensor", sensor_, "the robot carries no such sensor");
  }
  void Break(Alterations& alterations) const override {
    alterations.bump_stuck_rad = bearing_deg_ * kPi / 180;
  }

 private:
  std::string sensor_ = "bumper";
  double bearing_deg_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, StuckBumper)

}  // namespace floorproof
