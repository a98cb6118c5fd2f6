// SPDX-License-Identifier: Apache-2.0
// A ramp that goes on: the whole robot is on it in the end.
#include <fmt/format.h>

#include "validate/suite/crossing_method.h"

namespace floorproof {
namespace {

class RampUp final : public CrossingMethod {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-1, maximum slope angle; IEC 62849, managing a ramp; ASTM E54, inclined "
           "planes";
  }
  std::string_view task() const override {
    return "It drives straight up a ramp, a metre beyond the whole robot's length, from its "
           "cruising speed. Passed: it gets there, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"slope", "deg", {.per_unit = 2, .first = 2, .spacing = 10, .last = 102}};
  }

 protected:
  double Length(double) const override { return 0; }
  double beyond_m() const override { return 1; }
  std::string HazardKeys(double size_deg, double toward_deg) const override {
    return fmt::format("type: ramp, id: ramp, slope_deg: {}, toward_deg: {}", size_deg, toward_deg);
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, RampUp)

}  // namespace floorproof
