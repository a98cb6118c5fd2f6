// SPDX-License-Identifier: Apache-2.0
// What a robot's meetings came to, kind by kind, beside what its rates say of the same meetings;
// and how large a hazard may be.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/rate_model.h"
#include "run/campaign/dependence.h"

namespace floorproof {

// Meetings of neighbouring values of a covariate, nearly as many in each group.
struct AxisGroup {
  double low = 0, high = 0, mean = 0;  // of the covariate
  FailureRate counted{};
  double expected = 0;  // share that fails, by the rates
};

struct AxisFinding {
  std::string name;        // of the RateAxis
  bool of_hazard = false;  // one of its keys
  double spread = 0;       // standard deviation over the meetings of their group's `expected`
  std::vector<AxisGroup> groups;  // ascending; two at least
};

// The failure of a mode that the rates held for the least likely to fail.
struct UnlikelyFailure {
  const Encounter* met = nullptr;  // none: nothing failed so
  double p = 1;                    // that it would fail, in whatever way
};

// One kind of meeting with a hazard. Meetings without an outcome count nowhere.
struct KindFinding {
  const KindRates* kind = nullptr;
  int n = 0;
  std::array<int, kNumFailureModes> failed{};
  double expected = 0;            // failures, by the rates
  std::vector<AxisFinding> axes;  // the largest spread first
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
  // Of keys that go up and down, one of both: then `of.value`s are how far.
  enum class Way { kOnly, kUp, kDown } way = Way::kOnly;
  ValueDependence of{};
};

// Of each type of hazard, in alphabetical order, the keys that failures go with and of which a part
// is safe, the most telling first; where there is none, the most telling key that varied. All else
// is as it was drawn: straight ways and turns, the edge met askew, all frictions.
std::vector<SizeFinding> FindSafeSizes(const std::vector<Encounter>& first,
                                       const SafeRangeSettings& limit);

}  // namespace floorproof
