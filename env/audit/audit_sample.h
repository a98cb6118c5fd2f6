// SPDX-License-Identifier: Apache-2.0
// One sample of the floor, from the tape to what is read from it: the sample audit
// ("audit-sampling", sections 3.1 and 6.1).
#pragma once

#include <cstdint>
#include <string>
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

  // A sample is read where its images allow both, count and score; else what is wrong with them.
  bool read() const { return status() == ImageStatus::kSuccess; }
  ImageStatus status() const {
    return counted.status != ImageStatus::kSuccess ? counted.status : score.status;
  }
  const std::string& message() const {
    return counted.status != ImageStatus::kSuccess ? counted.message : score.message;
  }
};

// Lifts a tape with its middle at X_WT off the field, looks at it before and after, counts and
// scores. What it lifts is gone: of two samples at one place the second is cleaner.
// `lift`: which particles stick; `tape_seed`: the tape and its images.
AuditSample TakeSample(DirtField& field, const Pose2& X_WT, const SamplingParams& params,
                       Stream& lift, std::uint64_t tape_seed);

}  // namespace floorproof
