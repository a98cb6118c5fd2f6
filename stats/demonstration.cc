// SPDX-License-Identifier: Apache-2.0
#include "stats/demonstration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/params.h"

namespace floorproof {

int RunsToDemonstrate(double reliability, double confidence) {
  for (const auto& [key, value] :
       {std::pair("reliability", reliability), std::pair("confidence", confidence)})
    if (!(value > 0 && value < 1))
      throw InputError({}, key, FormatDouble(value), "must lie between 0 and 1");
  constexpr double kMost = 1e6;
  constexpr double kRounding = 1e-9;  // 0.9 and 0.19 ask for 2 runs, not for 3
  const double n = std::log1p(-confidence) / std::log(reliability);
  if (n > kMost)
    throw InputError({}, "reliability", FormatDouble(reliability),
                     "takes more than a million runs to demonstrate");
  return std::max(1, static_cast<int>(std::ceil(n * (1 - kRounding))));
}

}  // namespace floorproof
