// SPDX-License-Identifier: Apache-2.0
// The last part of a campaign's page: what made it, and with which settings.
#pragma once

#include <string>

#include "report/html_page.h"
#include "run/campaign/campaign_summary.h"

namespace floorproof {

// `settings`: the scenario, resolved.
PageSection SettingsSection(const CampaignSummary& summary, const std::string& settings);

}  // namespace floorproof
