// SPDX-License-Identifier: Apache-2.0
// A gap in the floor, deeper than what counts as fallen.
#include <fmt/format.h>

#include "validate/suite/crossing_method.h"

namespace floorproof {
namespace {

constexpr double kDepth_m = 0.1;

class Gap final : public CrossingMethod {
 public:
  std::string_view shaped_after() const override { return "ASTM E54, gaps"; }
  std::string_view task() const override {
    return "It drives straight over a gap 100 mm deep at its cruising speed. Passed: the whole "
           "robot is beyond, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"width", "mm", {.per_unit = 1, .first = 2, .spacing = 16, .last = 402}};
  }

 protected:
  double Length(double size_mm) const override { return size_mm / 1000; }
  std::string HazardKeys(double size_mm, double) const override {
    return fmt::format("type: groove, id: gap, width_m: {}, depth_m: {}", size_mm / 1000, kDepth_m);
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, Gap)

}  // namespace floorproof
