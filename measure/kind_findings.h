// SPDX-License-Identifier: Apache-2.0
// What a robot's meetings came to, kind by kind, beside what its rates say of the same meetings;
// and how large a hazard may be.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/rate_model.h"
#include "run/campaign/dependence.h"

namespace floorproof {

// Meetings of neighbouring values of a covariate, nearly as many in each group.
struct AxisGroup {
  double low = 0, high = 0, mean = 0;  // of the covariate
  FailureRate counted{};
  double expected = 0;  // the share that fails, by the rates
};

struct AxisFinding {
  std::string name;        // of the RateAxis
  bool of_hazard = false;  // one of its keys
  double spread = 0;       // standard deviation over the meetings of their group's `expected`
  std::vector<AxisGroup> groups;  // ascending; two at least
};

// The failure of a mode that the rates held for the least likely.
struct UnlikelyFailure {
  const Encounter* met = nullptr;  // none: nothing failed so
  double p = 1;                    // that it would fail so
};

// One kind of meeting with a hazard. Meetings without an outcome are counted apart; what the rates
// expect of them is in `expected` by half, as the rates were fitted (AmountOf).
struct KindFinding {
  const KindRates* kind = nullptr;
  int n = 0, censored = 0;
  std::array<int, kNumFailureModes> failed{};
  double expected = 0;  // failures, by the rates
  // What the rates tell apart most stands first; what they tell apart no more than chance would is
  // left out.
  std::vector<AxisFinding> axes;
  std::array<UnlikelyFailure, kNumFailureModes> unlikeliest{};
  int failures() const;
};

// By the model's kinds that are met, not driven along (exposures). `first`: first meetings
// (measure/shared_frailty.h), as rates are fitted to; they and the model outlive what is returned.
// Throws InputError naming an axis that a meeting's hazard does not state.
std::vector<KindFinding> FindKinds(const RiskModel& model, const std::vector<Encounter>& first);

// A key of a hazard that plans lead over.
struct SizeFinding {
  std::string type, key;
  // Of keys that go up and down, one of both: then `of`'s values are how far.
  enum class Way { kOnly, kUp, kDown } way = Way::kOnly;
  ValueDependence of{};
  // Where a part from the mildest on is safe: of the 50 meetings or more that are nearest to its
  // end.
  FailureRate at_edge{};
};

struct SafeSizes {
  int looked_at = 0;  // sizes and directions
  std::vector<SizeFinding> shown;
};

// Of robots that knew their place to a centimetre, by type of hazard in alphabetical order: the
// keys that failures go with and of which a part is safe, in each direction, the most telling
// first; where there is none, the most telling key. All else is as it was drawn: straight ways and
// turns, the edge met askew, all frictions.
SafeSizes FindSafeSizes(const std::vector<Encounter>& first, const SafeRangeSettings& limit);

}  // namespace floorproof
