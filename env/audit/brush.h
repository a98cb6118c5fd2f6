// SPDX-License-Identifier: Apache-2.0
// What a cleaning robot's tool does to the dirt that it passes over.
#pragma once

#include <cstdint>
#include <span>

#include "base/params.h"
#include "base/streams.h"
#include "env/audit/dirt_field.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// Assumptions. The audit paper cleans its room five rounds, states neither dirt nor cleaner in
// figures, and then finds 0.43 and 0.54 of an even grid's samples dirty (section 6.1, tables 1 and
// 2). `pick_up` is fitted to the 0.43, given the density of DirtParams, on 20 rooms like that of
// trial 1a (tests/audit/gathering_study_test.cc; docs/audit.md). Denser dirt and a better cleaner
// would do as well.
struct CleaningParams {
  double pick_up = 0.175;  // of a particle, in each pass over it
  // Of those that were not taken up, the share that the brush puts beside its lane, up to so far
  // away. Lane by lane they wander to the walls, where no later lane takes them up.
  double push_aside = 0.3;
  double push_m = 0.1;
  void Visit(ParamVisitor& v);
};

struct CleaningOutcome {
  std::int64_t passed_over = 0;  // particles, each once a pass
  std::int64_t taken_up = 0;
  std::int64_t pushed_aside = 0;
};

// Cleans with a tool that moves straight from pose to pose (X_WB), turning evenly on the way; one
// pose: it stands there. A particle is passed over when the tool passes over its middle (while it
// turns, to within 1 mm at its rim). As for CoverageMeter, a new pass over it begins when the tool
// comes back to it after a way of more than twice the tool's width since it last touched it. Each
// pass takes it up, or not, anew; what was pushed aside may be met again from there on. Walls stop
// what is pushed; they do not stop the tool.
// Throws InputError on a pose that is not finite.
// The same field, poses and stream give the same result, bit for bit. Time is about linear in the
// particles passed over, each counted once for every pose-to-pose piece whose tool covers its bin.
CleaningOutcome CleanAlong(DirtField& field, const Shape2& tool, std::span<const Pose2> poses,
                           const CleaningParams& params, Stream& random);

}  // namespace floorproof
