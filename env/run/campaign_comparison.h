// SPDX-License-Identifier: Apache-2.0
// Two variants on the same episodes, which have the same draws in both: a paired comparison.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "env/run/campaign_store.h"

namespace floorproof {

// {a, b, n, failures: {any_failure, each mode: {a, b, only_a, only_b, difference, lower, upper,
// p}}, metrics: {coverage, duration_s, ...: {mean, lower, upper, median}}}. Differences are A - B
// at 95 %: rates by Tango's score interval and the exact McNemar test, metrics by Student's
// interval of the mean. Episodes that are an error or not planned in either are left out. Throws
// InputError when the two drew different values for the same episode (other seeds, or other keys
// randomised).
nlohmann::ordered_json CompareVariants(const CampaignStore& a, const std::string& variant_a,
                                       const CampaignStore& b, const std::string& variant_b);

}  // namespace floorproof
