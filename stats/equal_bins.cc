// SPDX-License-Identifier: Apache-2.0
#include "stats/equal_bins.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace floorproof {
namespace {

using Place = std::span<const double>::iterator;

// The ends of the runs of equal values; empty where there are more than `most` of them.
std::vector<std::size_t> DistinctEnds(std::span<const double> values, std::size_t most) {
  std::vector<std::size_t> ends;
  for (std::size_t end = 0; end < values.size();) {
    if (ends.size() == most) return {};
    end = EndOfTies(values, end + 1);
    ends.push_back(end);
  }
  return ends;
}

}  // namespace

std::size_t BeginOfTies(std::span<const double> values, std::size_t at) {
  const Place first = std::lower_bound(values.begin(), values.end(), values[at]);
  return static_cast<std::size_t>(first - values.begin());
}

std::size_t EndOfTies(std::span<const double> values, std::size_t end) {
  const Place last = std::upper_bound(values.begin(), values.end(), values[end - 1]);
  return static_cast<std::size_t>(last - values.begin());
}

std::vector<std::size_t> EqualBins(std::span<const double> values, int most) {
  if (most < 1) throw InputError({}, "most", std::to_string(most), "must be >= 1");
  const auto bins = static_cast<std::size_t>(most);
  std::vector<std::size_t> ends = DistinctEnds(values, bins);
  if (!ends.empty() || values.empty()) return ends;
  for (std::size_t i = 1; i < bins; ++i) {
    const std::size_t cut = i * values.size() / bins;
    if (cut == 0) continue;
    // Between the run of equal values that the cut parts and what lies nearer of its two sides.
    const std::size_t before = BeginOfTies(values, cut), behind = EndOfTies(values, cut + 1);
    const std::size_t end = cut - before <= behind - cut ? before : behind;
    if (end > (ends.empty() ? 0 : ends.back()) && end < values.size()) ends.push_back(end);
  }
  ends.push_back(values.size());
  return ends;
}

}  // namespace floorproof
