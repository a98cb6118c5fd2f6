// SPDX-License-Identifier: Apache-2.0
#include "env/stats/checks.h"

#include <string>

#include "env/core/error.h"
#include "env/core/params.h"

namespace floorproof {

void CheckConfidence(double confidence) { CheckRate("confidence", confidence); }

void CheckRate(const char* key, double rate) {
  if (!(rate > 0 && rate < 1))
    throw InputError({}, key, FormatDouble(rate), "must be greater than 0 and less than 1");
}

void CheckCount(const char* key, int count) {
  if (count < 0) throw InputError({}, key, std::to_string(count), "must be >= 0");
}

void CheckCounts(int k, int n) {
  CheckCount("k", k);
  if (k > n) throw InputError({}, "k", std::to_string(k), "must be <= n = " + std::to_string(n));
}

}  // namespace floorproof
