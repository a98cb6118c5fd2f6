// SPDX-License-Identifier: Apache-2.0
// A campaign as CI systems read it.
#pragma once

#include <string>

#include "run/campaign/campaign_summary.h"

namespace floorproof {

// JUnit XML: a suite a variant, with a case that its episodes ran and, where there is a gate, one
// for that; times are simulated, what people read stands in system-out.
std::string JunitXml(const CampaignSummary& summary, bool failed_fast,
                     const std::string& scenario_name);

}  // namespace floorproof
