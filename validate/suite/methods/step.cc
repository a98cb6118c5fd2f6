// SPDX-License-Identifier: Apache-2.0
// One step up onto a floor that goes on, its edge upright.
#include <fmt/format.h>

#include "validate/suite/crossing_method.h"

namespace floorproof {
namespace {

class SingleStep final : public CrossingMethod {
 public:
  std::string_view shaped_after() const override {
    return "ASTM E54, hurdles; IEC 62849, transition";
  }
  std::string_view task() const override {
    return "It drives straight up a step at its cruising speed. Passed: the whole robot is on "
           "it, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"height", "mm", {.per_unit = 1, .first = 1, .spacing = 8, .last = 249}};
  }

 protected:
  double Length(double) const override { return 0; }
  std::string HazardKeys(double size_mm, double) const override {
    return fmt::format("type: step, id: step, height_m: {}", size_mm / 1000);
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, SingleStep)

}  // namespace floorproof
