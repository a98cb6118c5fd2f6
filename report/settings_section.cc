// SPDX-License-Identifier: Apache-2.0
#include "report/settings_section.h"

#include "report/html.h"

namespace floorproof {

std::string ScenarioDetails(const std::string& settings) {
  return "<details><summary>The scenario, with every default stated</summary>\n<pre>" +
         MarkupText(settings) + "</pre></details>\n";
}

PageSection SettingsSection(const CampaignSummary& summary, const std::string& settings) {
  std::string html = "<dl><dt>campaign</dt><dd>" + MarkupText(summary.campaign) + "</dd>";
  for (const auto& [name, version] : summary.versions)
    html += "<dt>" + MarkupText(name) + "</dt><dd>" + MarkupText(version) + "</dd>";
  return {"settings", "Settings and versions", html + "</dl>\n" + ScenarioDetails(settings)};
}

}  // namespace floorproof
