// SPDX-License-Identifier: Apache-2.0
// The gate: is a failure rate below a limit? Passed and failed are each a claim made with
// `confidence`; where the episodes allow neither, the gate is undecided and says so.
#pragma once

#include <string>

#include "stats/interval.h"

namespace floorproof {

enum class GateMode { kFixed, kSequential };
enum class GateVerdict { kPassed, kFailed, kUndecided };
const char* GateVerdictName(GateVerdict verdict);  // "passed", "failed", "undecided"

struct GateSettings {
  GateMode mode = GateMode::kFixed;
  double max_rate = 0.05;    // the limit that the rate must lie below
  double confidence = 0.95;  // of either claim, one-sided
  int min_n = 1;             // sequential: the fewest episodes that a verdict stands on
  int max_n = 59;  // fixed: the episodes judged; sequential: undecided for good after these
};

// Throws InputError unless 1e-9 <= max_rate <= 1 - 1e-9, 0.5 <= confidence < 1, 1 <= min_n <=
// max_n <= 1e9, and max_n episodes without a failure pass (59 at 5 %, 299 at 1 %, 2995 at 0.1 % of
// a fixed gate at 95 %).
void CheckGate(const GateSettings& settings);

// The least max_n of a gate that can pass. `settings.max_n` is not read.
int FewestEpisodesToPass(const GateSettings& settings);

struct GateReport {
  GateVerdict verdict = GateVerdict::kUndecided;
  bool final = false;  // no further episode can change the verdict
  int n = 0;           // episodes of the prefix that the verdict stands on
  int k = 0;           // failures among them
  // One-sided bounds on the rate, each at the gate's confidence. Fixed: Clopper-Pearson's at max_n;
  // before, the least and the greatest that they can still become. Sequential: AnytimeBounds.
  Interval rate{0, 1};
  // Sequential: natural logarithms of the e-values; the gate's threshold is -ln(1 - confidence).
  double log_e_pass = 0;
  double log_e_fail = 0;
  std::string text;  // one sentence, without the name of what is counted
};

// Takes outcomes in order of episode id, from 0 and without gaps: in order of arrival short
// episodes come first, which biases the rate. After final() further outcomes are ignored.
//
// Fixed: judged at max_n. Passed when the one-sided upper Clopper-Pearson bound of (k, max_n) is
// < max_rate; failed when the lower one is > max_rate; else undecided. It ends earlier only where
// the verdict at max_n is certain whatever the rest brings: k has already reached what fails (k
// never falls), the rest could all fail and it would pass, or both are out of reach.
// Sequential: from min_n on decided by JudgeSequentially after each episode; undecided at max_n.
class Gate {
 public:
  explicit Gate(const GateSettings& settings);  // throws as CheckGate

  void Add(bool failure);
  // There will be no further episode. Fixed: judged at those there are, where some of the max_n did
  // not count.
  void End();
  GateVerdict verdict() const { return verdict_; }
  bool final() const { return final_; }
  GateReport Report() const;

 private:
  void PlanFixed();
  void JudgeFixed();
  void JudgeSequential();

  GateSettings settings_;
  int most_that_pass_ = 0;  // fixed: counts of failures among max_n
  int least_that_fail_ = 0;
  int n_ = 0, k_ = 0;
  bool final_ = false;
  GateVerdict verdict_ = GateVerdict::kUndecided;
};

}  // namespace floorproof
