// SPDX-License-Identifier: Apache-2.0
// Risk models whose rates are known: of getting stuck alone, by one covariate or none.
#pragma once

#include <string>

#include "env/geometry/geometry.h"
#include "planners/risk/rate_model.h"
#include "tests/planners/planted_modes.h"

namespace floorproof::testing {

// The rate at any meeting of this kind.
inline KindRates PlantedKind(const std::string& type, Passage passage, double rate) {
  KindRates kind;
  kind.type = type;
  kind.passage = passage;
  kind.encounters = kind.cleared = 1000;
  PlantRates({0, rate, 0, 0}, kind);
  return kind;
}

// Of which eta falls or grows in a straight line with this covariate, or key of the hazard.
inline KindRates PlantedBy(const std::string& axis_name, bool of_hazard, double lower, double upper,
                           double rate_at_lower, double rate_at_upper,
                           const std::string& type = "cable_cover") {
  const double low = EtaOf(rate_at_lower), high = EtaOf(rate_at_upper);
  KindRates kind = PlantedKind(type, Passage::kOver, 1);
  RateAxis axis;
  axis.name = axis_name;
  axis.of_hazard = of_hazard;
  axis.lower = lower, axis.upper = upper;
  axis.knots = {lower, (lower + upper) / 2, upper};
  axis.functions = {{-1, 0, 1}};
  kind.axes = {axis};
  kind.any = Point({(low + high) / 2, (high - low) / 2});
  kind.any.blocks = {{{{0, 0, 1}}}};
  return kind;
}

// By the side that leads: the one rate with front or back, the other with a side.
inline KindRates PlantedByLead(double forward, double sideways) {
  KindRates kind = PlantedBy("lead_rad", false, -kPi, kPi, forward, sideways);
  RateAxis& axis = kind.axes[0];
  axis.period = 2 * kPi;
  axis.knots = {-kPi, -kPi / 2, 0, kPi / 2, kPi};
  axis.functions = {{-1, 1, -1, 1, -1}};
  return kind;
}

}  // namespace floorproof::testing
