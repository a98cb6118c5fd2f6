// SPDX-License-Identifier: Apache-2.0
// How an error line names a number of a model: its element, the element's name and the attribute.
#pragma once

#include <string>
#include <string_view>

namespace floorproof {

// "geom 'belly' mass"; "geom mass" where the element has no name. A long name is cut, so that the
// attribute is never.
inline std::string PartName(std::string_view element, std::string_view name,
                            std::string_view attribute) {
  constexpr std::size_t kMaxOfAName = 30;
  std::string out(element);
  if (name.size() > kMaxOfAName)
    out += " '" + std::string(name.substr(0, kMaxOfAName - 3)) + "...'";
  else if (!name.empty())
    out += " '" + std::string(name) + "'";
  return out + " " + std::string(attribute);
}

}  // namespace floorproof
