// SPDX-License-Identifier: Apache-2.0
// What failures depend on, in words, and as a table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/key_name.h"
#include "run/campaign/dependence.h"

namespace floorproof {

// The unit in which a key's bins are told, one for all of them.
KeyScale BinScale(const std::string& key, const std::vector<ValueBin>& bins);
// "0.5 to 0.562", "5 to 15.6 mm"; a choice by its name.
std::string BinText(const ValueBin& bin, const KeyScale& scale);
// "failures at lower values (p = 0.0012 after Holm for 6 values)", or that no influence is shown.
std::string InfluenceText(const ValueDependence& value, int looked_at);
// Up to which value a number is safe, in a clause; empty of choices and where nothing can be said.
// `metric`: of which the limit is.
std::string SafeText(const ValueDependence& value, const SafeRangeSettings& limit,
                     std::string_view metric = "not_success");
// The same for a table that states the limit: of which values it is the mean ("up to 19.8 mm (25 of
// 1024 failed)", or why nothing is shown), and of which each part by itself ("up to 13.1 mm",
// "all", "none"; empty where nothing is shown).
struct SafeClauses {
  std::string on_average{}, each_part{};
};
SafeClauses SafeClausesOf(const ValueDependence& value);

// A variant in lines, each beginning with the key it speaks of: the telling values (at most
// `most`), or that none is. None where nothing was drawn, or no failure and no range is to be told.
std::vector<std::string> DependenceText(const VariantDependence& variant, std::size_t most = 3);

// dependence.csv: variant,value,low,high,n,k,rate,lower,upper; a row a bin. Of a choice `low` and
// `high` are its name.
std::string DependenceCsv(const std::vector<VariantDependence>& variants);

}  // namespace floorproof
