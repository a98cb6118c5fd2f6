// SPDX-License-Identifier: Apache-2.0
// Several tests at once: what each p-value is worth when so many were looked at.
#pragma once

#include <span>
#include <vector>

namespace floorproof {

// Holm's adjusted p-values, in the order given: whoever calls a finding what lies at or below alpha
// is wrong about any of them with chance alpha at most, however the tests depend on each other.
// (0.01, 0.04, 0.03) gives (0.03, 0.06, 0.06). Throws InputError unless all lie in [0, 1].
std::vector<double> HolmAdjusted(std::span<const double> p_values);

}  // namespace floorproof
