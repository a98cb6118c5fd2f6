// SPDX-License-Identifier: Apache-2.0
// Whether failures go with a value: tests of the episodes that failed against those that did not,
// over groups of values.
#pragma once

#include <cstddef>
#include <span>

namespace floorproof {

struct GroupCounts {
  int n = 0, k = 0;  // episodes, those that failed
};

enum class InfluenceShape { kNone, kLower, kHigher, kEnds, kMiddle };

// p: two-sided. z: by how many standard deviations failures lie there rather than where chance puts
// them; it orders what has the same p.
struct OrderedInfluence {
  double p = 1, z = 0;
  InfluenceShape shape = InfluenceShape::kNone;  // where failures are more frequent
};
struct ChoiceInfluence {
  double p = 1, z = 0;
  std::size_t choice = 0;  // the group that differs most from the others
};

// Groups in the order of their values. Two tests, each of whose p is doubled: a trend over the
// groups, and one over their distance from the middle. The first alone where there are two groups.
// p is 1 where nobody failed, all did, or there are fewer than two groups. Throws InputError unless
// 0 <= k <= n in each group.
OrderedInfluence TestOrdered(std::span<const GroupCounts> groups);

// Groups without an order: each against all others; p is the least, times their number.
ChoiceInfluence TestChoices(std::span<const GroupCounts> groups);

}  // namespace floorproof
