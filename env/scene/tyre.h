// SPDX-License-Identifier: Apache-2.0
// A tyre's spring and damper, from its material, size and load.
//
// Rubber of Shore A hardness S has Young's modulus (Gent 1958, "On the relation between indentation
// hardness and Young's modulus")
//   E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)) MPa.
// A wheel of radius R has a tread of width w and thickness t on a rigid core. It is an elastic
// foundation (Johnson 1985, "Contact Mechanics", 4.3): under a load F it sinks by s,
//   F = 4/3 (E / t) w s sqrt(2 R s).
// A ball of radius R is solid (Hertz, Poisson's ratio 0.5): F = 4/3 E / 0.75 sqrt(R) s^1.5.
// The contact is linear: K = F / s at the load at rest. So the sink at rest is right, and under
// twice the load the tyre is too soft by a fifth.
#pragma once

#include <optional>
#include <string_view>

namespace floorproof {

enum class TyreMaterial { kSoftRubber, kHardRubber, kPolyurethane };
std::string_view Name(TyreMaterial material);
inline constexpr TyreMaterial kUsualTyre = TyreMaterial::kHardRubber,
                              kUsualCaster = TyreMaterial::kPolyurethane;

// What a robot states of its tyres (docs/adding-a-robot.md).
struct TyreSpec {
  TyreMaterial material = kUsualTyre;
  std::optional<double> stiffness_npm = {}, damping_ratio = {};
};

struct Tyre {
  double stiffness_npm = 0, damping_nspm = 0;
};

// Young's modulus, Pa, for a Shore A hardness of 20 to 95.
double RubberModulus(double shore_a);
double ShoreHardness(TyreMaterial material);

// What touches the ground.
struct Tread {
  double radius_m = 0, width_m = 0;  // of a ball the width is 0
};
// How far it sinks under this load, m.
double SinkOf(const Tread& tread, TyreMaterial material, double load_n);

// The tyre under this load of a robot of this mass. A stiffness that the robot states counts
// instead of the material's. The damping is 2 z sqrt(K M / 2): while a robot climbs, two of its
// wheels carry most of it. z is what the robot states, or 0.2 (docs/physics.md, "Tyres").
Tyre TyreUnder(double load_n, const Tread& tread, const TyreSpec& spec, double mass_kg);

}  // namespace floorproof
