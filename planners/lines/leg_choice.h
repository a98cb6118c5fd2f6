// SPDX-License-Identifier: Apache-2.0
// Which of a plan's legs are driven, how much of each, and by what curves they are joined.
//
// It is the cheapest choice: driven length, and what was to be driven and is not counts kLeftOut
// times. A leg that ends in a dwell is kept to its end, or left out at the cost of kStop_m more. It
// is found by dynamic programming over the legs, a few shortenings of each; a curve is the shortest
// of Dubins' that stays clear. It passes no nearer to a wall than wanted, or than the plan
// does within a radius of where the curve leaves and enters it. One from a start that is nearer to
// a wall leads away from there first.
#pragma once

#include <cstddef>
#include <vector>

#include "planners/lines/dubins.h"
#include "planners/lines/legs.h"

namespace floorproof {

struct TurnRequest;

struct JoinedLeg {
  std::size_t leg = 0;
  DubinsCurve curve;              // to it, from the one before or the start
  double begin_m = 0, end_m = 0;  // along it, what is driven
};

// `legs`: of LegsOf(). In order; empty where no curve leads from the start to any leg.
std::vector<JoinedLeg> ChooseLegs(const std::vector<Leg>& legs, const TurnRequest& request);

}  // namespace floorproof
