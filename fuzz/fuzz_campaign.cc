// SPDX-License-Identifier: Apache-2.0
// A campaign.sqlite from elsewhere, opened and read as `report` and `compare` do.
#include "fuzz/read_or_refuse.h"
#include "run/campaign/campaign_store.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  const auto file = Save("campaign.sqlite", View(data, size));
  for (const char* beside :
       {"campaign.sqlite-wal", "campaign.sqlite-shm", "campaign.sqlite-journal"})
    std::filesystem::remove(Folder() / beside);
  ReadOrRefuse([&] {
    const CampaignStore store = CampaignStore::Open(file, false);
    for (const std::string& variant : store.Variants()) {
      store.ForEach(
          variant, [](const EpisodeRow&) {}, true);
      store.Episodes(variant);
      store.Find(variant, 0);
    }
  });
  return 0;
}
