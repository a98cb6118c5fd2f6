// SPDX-License-Identifier: Apache-2.0
// A piece of adhesive tape that is pressed on the floor and lifts the dirt below it.
#pragma once

#include <vector>

#include "base/params.h"
#include "base/streams.h"
#include "env/audit/dirt_field.h"

namespace floorproof {

struct TapeParams {
  double side_m = 0.02;  // of its square: 4 cm2
  // Of each particle. Loose dry particles of half a millimetre and more stick: nothing is left that
  // a second tape could lift.
  double lift = 1;
  void Visit(ParamVisitor& v);
};

// On the tape, in its frame T: origin in its middle, axes along its sides.
struct LiftedParticle {
  Vec2 p_T = Vec2::Zero();  // m
  double diameter_m = 0;
};

// Presses a tape on the floor with its middle at X_WT, and takes from the field what it lifts: of
// the particles whose middle lies within its square (its border counts), each with the chance
// `lift`. Bin by bin, in the field's order. O(particles in the bins around the tape).
std::vector<LiftedParticle> LiftTape(DirtField& field, const Pose2& X_WT, const TapeParams& params,
                                     Stream& random);

}  // namespace floorproof
