// SPDX-License-Identifier: Apache-2.0
// Text from elsewhere, before it reaches a terminal, a file's name or a page. A control character
// there moves the cursor or clears what was said, a mark of writing direction makes a name read as
// another.
#pragma once

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

// The same as a field of a CSV file: in quotes where it needs them; what a spreadsheet would run,
// as text.
std::string CsvField(const std::string& text);

}  // namespace floorproof
