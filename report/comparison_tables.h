// SPDX-License-Identifier: Apache-2.0
// A paired comparison as tables for people: the same on a terminal and on a page.
#pragma once

#include <string>
#include <vector>

#include "base/text_table.h"
#include "run/campaign/campaign_comparison.h"

namespace floorproof {

struct ComparisonPart {
  std::string id, title;  // of a page's section
  TextTable table;
  std::vector<std::string> notes;  // below it, a line each
};

// Failures and metrics of the drives, where anything was driven, and figures of the plans. Parts
// have a table, notes, or both.
std::vector<ComparisonPart> ComparisonParts(const Comparison& comparison);

}  // namespace floorproof
