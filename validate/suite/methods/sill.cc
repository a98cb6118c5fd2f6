// SPDX-License-Identifier: Apache-2.0
// A door sill: upright up to 6.4 mm, from there bevelled 1:2, 50 mm wide on top.
#include <fmt/format.h>

#include <algorithm>

#include "validate/suite/crossing_method.h"

namespace floorproof {
namespace {

constexpr double kTop_m = 0.05, kUpright_m = 0.0064, kBevel = 2;

class Sill final : public CrossingMethod {
 public:
  std::string_view shaped_after() const override {
    return "ISO 18646-1, mobility over the sill; IEC 62849, threshold";
  }
  std::string_view task() const override {
    return "It drives straight over a sill at its cruising speed. Passed: the whole robot is "
           "beyond, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"height", "mm", {.per_unit = 1, .first = 1, .spacing = 4, .last = 97}};
  }

 protected:
  double Length(double size_mm) const override {
    return kTop_m + 2 * kBevel * std::max(0.0, size_mm / 1000 - kUpright_m);
  }
  std::string HazardKeys(double size_mm, double) const override {
    return fmt::format("type: threshold, id: sill, height_m: {}, width_m: {}", size_mm / 1000,
                       Length(size_mm));
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, Sill)

}  // namespace floorproof
