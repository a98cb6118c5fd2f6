// SPDX-License-Identifier: Apache-2.0
// Bytes into characters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace floorproof {

// The character at a text's beginning and how many bytes it takes; 0: no UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};
// `text` is not empty.
Character FirstCharacter(std::string_view text);

}  // namespace floorproof
