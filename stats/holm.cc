// SPDX-License-Identifier: Apache-2.0
// Holm, Scandinavian Journal of Statistics 6 (1979) 65: of m p-values the i-th smallest, from 0, is
// multiplied by m - i, and none may fall below one that was smaller before.
#include "stats/holm.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/params.h"

namespace floorproof {

std::vector<double> HolmAdjusted(std::span<const double> p_values) {
  for (const double p : p_values)
    if (!(p >= 0 && p <= 1)) throw InputError({}, "p", FormatDouble(p), "must lie in [0, 1]");
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double least = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto still_open = static_cast<double>(order.size() - rank);
    least = std::max(least, std::min(1.0, still_open * p_values[order[rank]]));
    adjusted[order[rank]] = least;
  }
  return adjusted;
}

}  // namespace floorproof
