// SPDX-License-Identifier: Apache-2.0
// One sample of the floor, from the tape to what is read from it: the sample audit
// ("audit-sampling", sections 3.1 and 6.1).
#pragma once

#include <cstdint>
#include <vector>

#include "base/params.h"
#include "base/streams.h"
#include "env/audit/dirt_count.h"
#include "env/audit/tape.h"
#include "env/audit/tape_image.h"

namespace floorproof {

struct SamplingParams {
  TapeParams tape;
  MicroscopeParams microscope;
  CountParams count;
  void Visit(ParamVisitor& v);
};

struct AuditSample {
  std::vector<LiftedParticle> lifted;  // the truth
  std::uint64_t tape_seed = 0;         // PhotographTape(lifted, ..., tape_seed) is what was seen
  DirtCount counted;
  SampleScore score;
};

// Lifts a tape with its middle at X_WT off the field, looks at it before and after, counts and
// scores. What it lifts is gone: of two samples at one place the second is cleaner.
// Draws from `random`: the lift, then the tape's seed.
AuditSample TakeSample(DirtField& field, const Pose2& X_WT, const SamplingParams& params,
                       Stream& random);

}  // namespace floorproof
