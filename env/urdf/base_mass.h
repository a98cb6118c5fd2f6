// SPDX-License-Identifier: Apache-2.0
// Whether a URDF's base weighs what a robot's base does.
#pragma once

#include <span>
#include <string>

#include "env/urdf/urdf_model.h"

namespace floorproof {

// Why no robot's base, of these links, is as light as `base_kg`; empty: one may be. Where the
// body's own mass is missing, a caster's or a sensor's stands for all of the base.
std::string WhyTooLight(std::span<const UrdfLink* const> links, double base_kg, double wheels_kg);

}  // namespace floorproof
