// SPDX-License-Identifier: Apache-2.0
// Text, numbers (base/quantity.h) and files as they stand in an HTML page.
#pragma once

#include <string>
#include <string_view>

#include "base/markup.h"
#include "base/quantity.h"
#include "base/text_table.h"
#include "stats/interval.h"

namespace floorproof {

// data:<type>;base64,..
std::string DataUri(std::string_view type, std::string_view bytes);
// A relative path as an address: what has a meaning there is percent-encoded, '/' stays.
std::string UrlPath(std::string_view path);

// The table as the page has such; its first column names the rows.
std::string TableHtml(const TextTable& table);

// An interval of shares, rounded outward: "0 to 60.3 %".
std::string PercentText(const Interval& share);

}  // namespace floorproof
