// SPDX-License-Identifier: Apache-2.0
// The page of `compare`: two variants, perhaps of two campaigns, paired.
#pragma once

#include <filesystem>
#include <string>

#include "run/campaign/campaign_comparison.h"

namespace floorproof {

struct ComparedSide {
  std::filesystem::path folder;  // of its campaign
  std::string variant, name;     // there, and on the page
};

// From the campaigns' summaries and their comparison alone. Throws InputError naming a summary that
// cannot be read.
std::string ComparePage(const ComparedSide& a, const ComparedSide& b, const Comparison& comparison);

}  // namespace floorproof
