// SPDX-License-Identifier: Apache-2.0
// How an error line names a number of a model: its element, the element's name and the attribute.
#pragma once

#include <string>
#include <string_view>

#include "base/printable.h"

namespace floorproof {

// "geom 'belly' mass"; "geom mass" where the element has no name. A long name is cut, so that the
// attribute is never.
inline std::string PartName(std::string_view element, std::string_view name,
                            std::string_view attribute) {
  constexpr std::size_t kMaxOfAName = 30;
  std::string out(element);
  if (!name.empty()) out += " '" + CutEnd(name, kMaxOfAName) + "'";
  return out + " " + std::string(attribute);
}

}  // namespace floorproof
