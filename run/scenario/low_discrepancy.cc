// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/low_discrepancy.h"

#include <boost/random/sobol.hpp>

namespace floorproof {

std::vector<std::uint64_t> SobolPoint(std::uint64_t index, std::size_t dimensions) {
  std::vector<std::uint64_t> point(dimensions);
  if (index == 0 || dimensions == 0) return point;
  boost::random::sobol sequence(dimensions);
  sequence.seed(index - 1);  // Boost leaves the first point out, all of whose coordinates are 0
  sequence.generate(point.begin(), point.end());
  return point;
}

double Shifted(std::uint64_t coordinate, std::uint64_t shift) {
  // The middle of one of 2^52 intervals.
  return (static_cast<double>((coordinate ^ shift) >> 12) + 0.5) * 0x1p-52;
}

}  // namespace floorproof
