// SPDX-License-Identifier: Apache-2.0
// A report's tables of rates with their intervals drawn beside them, and of paired differences.
#pragma once

#include <string>

#include "report/page.h"

namespace floorproof {

// All variants' rates of any failure, one below the other.
std::string VariantsTable(const Report& report);
// One variant: outcomes, rates, rates per km and hour, kinds, hazards, metrics.
std::string VariantRates(const Report& report, const VariantSummary& variant);
// The squares of the floor where most episodes failed; empty where none did.
std::string PlaceRates(const Report& report, const VariantSummary& variant);
// Each variant against the first.
std::string PairedTables(const Report& report);

}  // namespace floorproof
