// SPDX-License-Identifier: Apache-2.0
// Numbers as files state them.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace floorproof {

// To six significant digits: what is written so is read again as the same number.
inline double RoundedTo6(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

}  // namespace floorproof
