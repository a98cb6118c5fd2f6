// SPDX-License-Identifier: Apache-2.0
// The value up to which something holds.
#pragma once

namespace floorproof {

// Between `low`, at which holds(value) is taken to be true, and `high`, at which it is taken to be
// false, found by halving until they are at most `resolution` apart: the middle.
template <class Holds>
double Bisect(double low, double high, double resolution, const Holds& holds) {
  while (high - low > resolution) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace floorproof
