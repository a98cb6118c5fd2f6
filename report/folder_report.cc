// SPDX-License-Identifier: Apache-2.0
#include "report/folder_report.h"

#include "report/campaign_report.h"
#include "report/measure_page.h"
#include "report/rare_page.h"
#include "report/run_page.h"

namespace floorproof {
namespace {

WrittenReport WriteRareReport(const std::filesystem::path& folder) {
  const RarePage made = MakeRarePage(folder);
  return WritePage(folder / "rare.html",
                   {"page", [](std::string_view name) { return name == "rare.html"; }},
                   made.verdict, made.html);
}

}  // namespace

WrittenReport WriteFolderReport(const std::filesystem::path& folder, const std::string& named,
                                const Console& console) {
  if (HoldsRareSearch(folder)) return WriteRareReport(folder);
  if (HoldsRun(folder)) return WriteRunReport(folder, named);
  if (HoldsMeasurement(folder)) return WriteMeasureReport(folder, named);
  return WriteCampaignReport(folder, named, console);
}

}  // namespace floorproof
