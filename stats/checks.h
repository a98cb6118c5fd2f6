// SPDX-License-Identifier: Apache-2.0
// The rules that all statistics ask of their arguments; each throws InputError with key and value.
#pragma once

namespace floorproof {

// Limits nearer to 0 or 1 than this no countable number of episodes can test.
inline constexpr double kLeastLimit = 1e-9;

void CheckConfidence(double confidence);         // in (0, 1)
void CheckLimit(const char* key, double limit);  // in [kLeastLimit, 1 - kLeastLimit]
void CheckCount(const char* key, int count);     // >= 0
void CheckCounts(int k, int n);                  // 0 <= k <= n

}  // namespace floorproof
