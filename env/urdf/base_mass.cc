// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/base_mass.h"

#include "base/quantity.h"
#include "env/urdf/link_mass.h"

namespace floorproof {

std::string WhyTooLight(std::span<const UrdfLink* const> links, double base_kg, double wheels_kg) {
  constexpr double kLeast_kgpm3 = 20, kLitre_m3 = 1e-3;  // robots have 50 and more
  double largest_m3 = 0;
  const UrdfLink* largest = nullptr;
  std::string massless;
  for (const UrdfLink* link : links) {
    for (const UrdfShape& shape : link->shapes) {
      if (BoxVolume(shape) <= largest_m3) continue;
      largest_m3 = BoxVolume(shape);
      largest = link;
    }
    if (link->mass.mass_kg == 0 && !link->shapes.empty())
      massless += (massless.empty() ? "" : ", ") + link->name;
  }
  const bool body_weighs = largest == nullptr || largest->mass.mass_kg > 0;
  if (base_kg >= kLeast_kgpm3 * largest_m3 && (body_weighs || base_kg > wheels_kg)) return "";
  return "the base weighs " + NumberText(base_kg) + " kg, its wheels " + NumberText(wheels_kg) +
         " kg, and its largest shape's box holds " + NumberText(largest_m3 / kLitre_m3) +
         " litres: no robot's base is as light. " +
         (massless.empty() ? "Mend its masses, or its shapes' sizes"
                           : "Without a mass: " + massless + "; state it in the link's <inertial>");
}

}  // namespace floorproof
