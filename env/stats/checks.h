// SPDX-License-Identifier: Apache-2.0
// The rules that all statistics ask of their arguments; each throws InputError with key and value.
#pragma once

namespace floorproof {

void CheckConfidence(double confidence);       // in (0, 1)
void CheckRate(const char* key, double rate);  // in (0, 1)
void CheckCount(const char* key, int count);   // >= 0
void CheckCounts(int k, int n);                // 0 <= k <= n

}  // namespace floorproof
