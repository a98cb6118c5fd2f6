// SPDX-License-Identifier: Apache-2.0
#include "env/audit/audit_sample.h"

namespace floorproof {

void SamplingParams::Visit(ParamVisitor& v) {
  v.Group(
      "tape", [this](ParamVisitor& g) { tape.Visit(g); }, "what lifts the dirt");
  v.Group(
      "microscope", [this](ParamVisitor& g) { microscope.Visit(g); }, "how its image comes out");
  v.Group(
      "count", [this](ParamVisitor& g) { count.Visit(g); }, "what counts as a particle");
}

AuditSample TakeSample(DirtField& field, const Pose2& X_WT, const SamplingParams& params,
                       Stream& lift, std::uint64_t tape_seed) {
  AuditSample sample;
  sample.lifted = LiftTape(field, X_WT, params.tape, lift);
  sample.tape_seed = tape_seed;
  const TapeImages images =
      PhotographTape(sample.lifted, params.tape, params.microscope, sample.tape_seed);
  sample.counted = CountDirt(images.after, params.microscope.pixels_per_mm, params.count);
  sample.score = ScoreSample(images.before, images.after);
  return sample;
}

}  // namespace floorproof
