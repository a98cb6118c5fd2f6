// SPDX-License-Identifier: Apache-2.0
// Names of files and scenarios as people write them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace floorproof {

// "roll_over": "roll over".
inline std::string Words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace floorproof
