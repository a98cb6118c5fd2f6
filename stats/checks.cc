// SPDX-License-Identifier: Apache-2.0
#include "stats/checks.h"

#include <string>

#include "base/error.h"
#include "base/params.h"

namespace floorproof {

void CheckConfidence(double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw InputError({}, "confidence", FormatDouble(confidence),
                     "must be greater than 0 and less than 1");
}

void CheckLimit(const char* key, double limit) {
  if (!(limit >= kLeastLimit && limit <= 1 - kLeastLimit))
    throw InputError({}, key, FormatDouble(limit), "must be at least 1e-9 and at most 1 - 1e-9");
}

void CheckCount(const char* key, int count) {
  if (count < 0) throw InputError({}, key, std::to_string(count), "must be >= 0");
}

void CheckCounts(int k, int n) {
  CheckCount("k", k);
  if (k > n) throw InputError({}, "k", std::to_string(k), "must be <= n = " + std::to_string(n));
}

}  // namespace floorproof
