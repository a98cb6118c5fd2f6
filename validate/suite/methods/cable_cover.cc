// SPDX-License-Identifier: Apache-2.0
// A cable cover with flanks of 30 degrees and a top of 50 mm, met square and at two angles. One
// wheel after the other goes up an edge that is met at an angle, and it turns the robot aside.
#include <fmt/format.h>

#include <cmath>

#include "validate/suite/crossing_method.h"

namespace floorproof {
namespace {

constexpr double kTop_m = 0.05, kFlank_deg = 30;

class CableCover : public CrossingMethod {
 public:
  std::string_view shaped_after() const override {
    return "IEC 62849, transition; ASTM E54, crossing ramps";
  }
  std::string_view task() const override {
    return "It drives straight over a cable cover with flanks of 30 degrees at its cruising "
           "speed. Passed: the whole robot is beyond, and no detector fired.";
  }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"height", "mm", {.per_unit = 1, .first = 1, .spacing = 8, .last = 153}};
  }

 protected:
  double Length(double size_mm) const override {
    return kTop_m + 2 * size_mm / 1000 / std::tan(kFlank_deg * kPi / 180);
  }
  std::string HazardKeys(double size_mm, double) const override {
    return fmt::format("type: cable_cover, id: cover, height_m: {}, width_m: {}, top_width_m: {}",
                       size_mm / 1000, Length(size_mm), kTop_m);
  }
};

class CoverSquare final : public CableCover {};
class CoverAt60 final : public CableCover {
  double angle_deg() const override { return 60; }
};
class CoverAt45 final : public CableCover {
  double angle_deg() const override { return 45; }
};

}  // namespace

FP_DEFINE_PLUGIN(Method, CoverSquare)
FP_DEFINE_PLUGIN(Method, CoverAt60)
FP_DEFINE_PLUGIN(Method, CoverAt45)

}  // namespace floorproof
