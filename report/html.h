// SPDX-License-Identifier: Apache-2.0
// Text, numbers and files as they stand in an HTML page.
#pragma once

#include <string>
#include <string_view>

#include "base/markup.h"
#include "stats/interval.h"

namespace floorproof {

// data:<type>;base64,..
std::string DataUri(std::string_view type, std::string_view bytes);
// A relative path as an address: what has a meaning there is percent-encoded, '/' stays.
std::string UrlPath(std::string_view path);

// Three significant digits, thousands grouped: 0.0866, 94.6, 136,000. NaN and infinity: "–".
std::string NumberText(double value);
// A share in percent: "25 %".
std::string PercentText(double share);
// An interval of shares, rounded outward: "0 to 60.3 %".
std::string PercentText(const Interval& share);

}  // namespace floorproof
