// SPDX-License-Identifier: Apache-2.0
#include "report/recorded_campaign.h"

#include <limits>
#include <utility>

#include "base/error.h"
#include "base/input_file.h"
#include "run/campaign/summary_json.h"

namespace floorproof {

RecordedCampaign ReadRecordedCampaign(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json", database = folder / "campaign.sqlite";
  CampaignSummary summary = ReadSummary(file);
  if (const std::string why = WhyUnreadable(database, std::numeric_limits<std::uintmax_t>::max());
      !why.empty())
    throw InputError({database.string(), 0}, "", "", why + ": not the folder of a `campaign`");
  CampaignStore store = CampaignStore::Open(database, false);
  if (store.about().id != summary.campaign)
    throw InputError({file.string(), 0}, "campaign", summary.campaign,
                     "is another campaign than campaign.sqlite's, " + store.about().id);
  return {std::move(summary), std::move(store)};
}

}  // namespace floorproof
