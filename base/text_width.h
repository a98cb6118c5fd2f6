// SPDX-License-Identifier: Apache-2.0
// Text in the columns of a terminal: a Chinese character takes two, a combining mark none. Of text
// without control characters (base/printable.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

int DisplayWidth(std::string_view text);

// In lines of at most `width` columns, broken at spaces and between wide characters. A number keeps
// its unit ("198.8 s"); a word that is wider than a line stays whole, for paths and commands are
// copied. At least one line.
std::vector<std::string> WrapText(std::string_view text, int width);

// With "…" in place of what goes beyond `width` columns.
std::string CutText(std::string_view text, int width);

}  // namespace floorproof
