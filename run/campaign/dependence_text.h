// SPDX-License-Identifier: Apache-2.0
// What failures depend on, in words, as JSON and as a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "run/campaign/dependence.h"

namespace floorproof {

// "0.5 to 0.562"; a choice by its name.
std::string BinText(const ValueBin& bin);
// "failures at lower values (p = 0.0012 after Holm for 6 values)", or that no influence is shown.
std::string InfluenceText(const ValueDependence& value, int looked_at);
// Up to which value a number is safe, in a clause; empty of choices and where nothing can be said.
std::string SafeText(const ValueDependence& value, const SafeRangeSettings& limit);

// A variant in lines, each beginning with the key it speaks of: the telling values (at most
// `most`), or that none is. None where nothing was drawn, or no failure and no range is to be told.
std::vector<std::string> DependenceText(const VariantDependence& variant, std::size_t most = 3);

// What has no rate, no bound or no answer is null. Variants in their order, values the most telling
// first.
nlohmann::ordered_json DependenceJson(const std::vector<VariantDependence>& variants);

// dependence.csv: variant,value,low,high,n,k,rate,lower,upper; a row a bin. Of a choice `low` and
// `high` are its name.
std::string DependenceCsv(const std::vector<VariantDependence>& variants);

}  // namespace floorproof
