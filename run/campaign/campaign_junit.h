// SPDX-License-Identifier: Apache-2.0
// A campaign as CI systems read it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run/campaign/campaign_gate.h"

namespace floorproof {

// JUnit XML: a suite a variant of `summary` (summary.json), with a case that its episodes ran and,
// where there is a gate, one for that; times are simulated, what people read stands in system-out.
std::string JunitXml(const nlohmann::ordered_json& summary, const std::vector<GateState>& gate,
                     bool failed_fast, const std::string& scenario_name);

}  // namespace floorproof
