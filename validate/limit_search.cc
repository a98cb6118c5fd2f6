// SPDX-License-Identifier: Apache-2.0
#include "validate/limit_search.h"

#include "base/interrupt.h"

namespace floorproof {

std::optional<Limit> FindLimit(const Rungs& rungs,
                               const std::function<bool(double size)>& crosses) {
  const auto size = [&](int n) { return static_cast<double>(n) / rungs.per_unit; };
  int crossed = 0, held = 0;
  for (int rung = rungs.first; held == 0 && rung <= rungs.last; rung += rungs.spacing) {
    if (Interrupted()) return {};
    (crosses(size(rung)) ? crossed : held) = rung;
  }
  if (held == 0) return Limit{size(crossed), true};
  if (held == rungs.first) return Limit{0, false};
  while (held - crossed > 1) {
    if (Interrupted()) return {};
    const int middle = (crossed + held) / 2;
    (crosses(size(middle)) ? crossed : held) = middle;
  }
  return Limit{size(crossed), false};
}

}  // namespace floorproof
