// SPDX-License-Identifier: Apache-2.0
// A sensor that tells nothing any more: a torn cable, a driver that hangs. What the robot still
// hears of it is what the sensor's own Silence() says.
#include <algorithm>

#include "env/faults/fault.h"

namespace floorproof {
namespace {

class SilentSensor final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("sensor", sensor_, {}, "name of one that the robot carries, or all");
  }
  void Start(const FaultContext& context) override {
    silent_.assign(context.sensors.begin(), context.sensors.end());
    if (sensor_ == kAll) return;
    if (std::ranges::find(silent_, sensor_) == silent_.end()) {
      std::string known;
      for (const std::string& name : silent_) known += " " + name;
      throw InputError({}, "sensor", sensor_,
                       "the robot carries no such sensor (all, or one of:" + known + ")");
    }
    silent_ = {sensor_};
  }
  void Break(Alterations& alterations) const override {
    auto& all = alterations.silent_sensors;
    all.insert(all.end(), silent_.begin(), silent_.end());
  }

 private:
  std::string sensor_ = kAll;
  std::vector<std::string> silent_;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, SilentSensor)

}  // namespace floorproof
