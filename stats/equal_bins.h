// SPDX-License-Identifier: Apache-2.0
// Values parted into bins that hold nearly as many each.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace floorproof {

// Where the bins of ascending values end: bin i holds what lies before ends[i] and in no bin before
// it; the last end is the number of values. Equal values are never parted, so that there may be
// fewer than `most` bins; no more distinct values than that: a bin each. None is empty. Throws
// InputError unless most >= 1.
std::vector<std::size_t> EqualBins(std::span<const double> ascending, int most);

// Where the run of values equal to that at `at` begins. at < size.
std::size_t BeginOfTies(std::span<const double> ascending, std::size_t at);
// Where the run of values equal to the one before `end` ends. 1 <= end <= size.
std::size_t EndOfTies(std::span<const double> ascending, std::size_t end);

}  // namespace floorproof
