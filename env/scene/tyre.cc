// SPDX-License-Identifier: Apache-2.0
#include "env/scene/tyre.h"

#include <cmath>

namespace floorproof {
namespace {

constexpr double kTreadShare = 0.1;  // of the radius: what solid tyres of floor robots have
constexpr double kDampingRatio = 0.2;

struct Material {
  std::string_view name;
  double shore_a;
};

// Typical of solid tyres, and of the treads of casters.
Material Of(TyreMaterial material) {
  switch (material) {
    case TyreMaterial::kSoftRubber:
      return {"soft_rubber", 60};
    case TyreMaterial::kHardRubber:
      return {"hard_rubber", 80};
    case TyreMaterial::kPolyurethane:
      return {"polyurethane", 92};
  }
  return {"", 0};
}

}  // namespace

double RubberModulus(double shore_a) {
  return 1e6 * 0.0981 * (56 + 7.62336 * shore_a) / (0.137505 * (254 - 2.54 * shore_a));
}

std::string_view Name(TyreMaterial material) { return Of(material).name; }

double ShoreHardness(TyreMaterial material) { return Of(material).shore_a; }

double SinkOf(const Tread& tread, TyreMaterial material, double load_n) {
  const double modulus_pa = RubberModulus(ShoreHardness(material)), radius_m = tread.radius_m;
  const double per_sink = tread.width_m > 0 ? 4.0 / 3 * modulus_pa / (kTreadShare * radius_m) *
                                                  tread.width_m * std::sqrt(2 * radius_m)
                                            : 4.0 / 3 * modulus_pa / 0.75 * std::sqrt(radius_m);
  return std::pow(load_n / per_sink, 2.0 / 3);
}

Tyre TyreUnder(double load_n, const Tread& tread, const TyreSpec& spec, double mass_kg) {
  const double stiffness_npm =
      spec.stiffness_npm ? *spec.stiffness_npm : load_n / SinkOf(tread, spec.material, load_n);
  const double ratio = spec.damping_ratio.value_or(kDampingRatio);
  return {stiffness_npm, 2 * ratio * std::sqrt(stiffness_npm * mass_kg / 2)};
}

}  // namespace floorproof
