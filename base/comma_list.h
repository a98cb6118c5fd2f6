// SPDX-License-Identifier: Apache-2.0
// Lists as people and tables write them: parts with commas between.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

// The parts, without the spaces and tabs around each. A part may be empty; an empty text has none.
std::vector<std::string> SplitAtCommas(std::string_view text);

}  // namespace floorproof
