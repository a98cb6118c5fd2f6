// SPDX-License-Identifier: Apache-2.0
// A scenario's gate of `mode: rare`: judged on an estimate of rare failures.
#pragma once

#include <optional>
#include <string>

#include "run/campaign/campaign_gate.h"
#include "stats/rare/rare_estimate.h"

namespace floorproof {

struct RareVerdict {
  GateVerdict verdict = GateVerdict::kUndecided;
  bool rests_on_sampler = false;  // it knows the ways to fail that were found
  std::string text;               // one sentence
};

class RareGate {
 public:
  // `node`: the scenario's key `gate`. None where that is null or of another mode. Throws
  // InputError where it is about another failure than `mode` (--mode), or makes no sense.
  static std::optional<RareGate> Read(const ConfigNode& node, const std::string& mode);

  // Passed (failed) where a bound of the estimate, or one that rests on no sampler, lies below
  // (above) the limit; undecided where neither does, where they contradict each other, and where
  // drives had no outcome (`errors`).
  RareVerdict Judge(const RareEstimate& estimate, std::uint64_t errors = 0) const;

 private:
  GateParams params_;
};

}  // namespace floorproof
