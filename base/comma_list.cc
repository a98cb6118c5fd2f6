// SPDX-License-Identifier: Apache-2.0
#include "base/comma_list.h"

#include <algorithm>

namespace floorproof {

std::vector<std::string> SplitAtCommas(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; !text.empty() && from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::string_view part = text.substr(from, to - from);
    const std::size_t first = part.find_first_not_of(" \t"), last = part.find_last_not_of(" \t");
    parts.emplace_back(first == part.npos ? "" : part.substr(first, last - first + 1));
    from = to + 1;
  }
  return parts;
}

}  // namespace floorproof
