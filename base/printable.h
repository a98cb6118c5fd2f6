// SPDX-License-Identifier: Apache-2.0
// Text from elsewhere, before it reaches a terminal, a file's name or a page. A control character
// there moves the cursor or clears what was said, a mark of writing direction makes a name read as
// another.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace floorproof {

// Whether it is UTF-8 without control characters but line breaks and tabs.
bool IsUtf8Text(std::string_view text);

// Why a name or value of a file is refused: it is no UTF-8, or holds a control character (line
// breaks and tabs are none) or a mark of writing direction. Empty when it is not.
std::string WhyUnprintable(std::string_view text);

// The text with a question mark for each such character or byte.
std::string Printable(std::string_view text);

// The same on one line: a space for each line break and tab.
std::string PrintableLine(std::string_view text);

// At most `most` characters of UTF-8 text; "..." replaces what is cut.
std::string CutEnd(std::string_view text, std::size_t most);
std::string CutMiddle(std::string_view text, std::size_t most);

// Printable text as a field of a CSV file: in quotes where it needs them; what a spreadsheet would
// run, as text.
std::string CsvField(const std::string& text);

}  // namespace floorproof
