// SPDX-License-Identifier: Apache-2.0
// What an event's evidence says of it.
#pragma once

#include <optional>
#include <string_view>

#include "env/core/event.h"

namespace floorproof {

// none: nothing of that name was measured.
inline std::optional<double> Evidence(const Event& event, std::string_view name) {
  for (const auto& [key, value] : event.evidence)
    if (key == name) return value;
  return {};
}

// When the robot came to stand of which it was found only seconds later that it is stuck; of other
// failures when they happened.
inline double BeganAt(const Event& event) {
  return event.t_s - Evidence(event, "still_s").value_or(0);
}

}  // namespace floorproof
