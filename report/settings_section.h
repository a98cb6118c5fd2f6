// SPDX-License-Identifier: Apache-2.0
// The last part of a page: what made it, and with which settings.
#pragma once

#include <string>

#include "report/html_page.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

// The scenario, resolved, folded away.
std::string ScenarioDetails(const std::string& settings);
// `settings`: likewise.
PageSection SettingsSection(const CampaignSummary& summary, const std::string& settings);

}  // namespace floorproof
