// SPDX-License-Identifier: Apache-2.0
// Up to which value, and from which value on, the failure rate is shown to be below a limit.
#pragma once

#include <optional>
#include <span>

namespace floorproof {

struct DrawnOutcome {
  double value = 0;
  bool failed = false;
};

struct SafeRangeSettings {
  double max_rate = 0.05, confidence = 0.95;
  // The episodes ended when they had shown enough (a sequential gate): bounds that hold whenever
  // one stops, in place of Clopper-Pearson's.
  bool anytime = false;
};

// A set of values, all those up to or from `edge` on, with its counts.
struct Stretch {
  double edge = 0;
  int n = 0, k = 0;
};

enum class SafeAnswer {
  kTooFew,    // not even `needed` episodes without a failure
  kNotShown,  // neither end's first stretch passes, nor the whole
  kPart,      // `up_to` or `from`, or both
  kWhole,     // all values
};

// What is claimed of a stretch is its mean: the chance of a failure, averaged over the values that
// were driven in it (and over all else that was drawn). Its rate at the edge may be higher, which
// is what the claims of parts are for: the values in at most eight parts of equal counts, of each
// of which by itself the mean is claimed.
//
// With at least `confidence` no stretch of `answer` is claimed whose mean is not below the limit,
// both ends together; and so for the parts, by themselves.
struct SafeRange {
  SafeAnswer answer = SafeAnswer::kTooFew;
  int needed = 0;  // episodes without a failure, the fewest that show anything
  Stretch whole{}, first_low{}, first_high{};  // the first: where each end begins; n = 0: nowhere
  std::optional<Stretch> up_to{}, from{};      // none: that end shows nothing; kPart
  int parts = 0;                               // of equal counts
  std::optional<Stretch> each_up_to{}, each_from{};  // the last of the parts shown
};

// Values finite, ascending. Throws InputError unless the settings are a gate's (stats/gate.h).
SafeRange FindSafeRange(std::span<const DrawnOutcome> ascending, const SafeRangeSettings& settings);

}  // namespace floorproof
