// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "report/campaign_report.h"
#include "report/rare_page.h"
#include "run/rare/rare_search.h"

namespace floorproof {
namespace {

int WriteRareReport(const std::string& named, const Globals& globals) {
  const std::filesystem::path page = std::filesystem::path(named) / "rare.html";
  const RarePage made = MakeRarePage(named);
  ResultFolder folder(named, RareResults(), {});
  folder.Begin();
  WriteFileWhole(page, made.html);
  globals.Say(made.verdict);
  globals.Say(fmt::format("report: {} ({:.1f} MB, opens from disk)", page.string(),
                          static_cast<double>(made.html.size()) / 1e6));
  globals.Result(
      {{"report", page.string()}, {"verdict", made.verdict}, {"bytes", made.html.size()}});
  return kExitDone;
}

int WriteReport(const std::string& named, const Globals& globals) {
  if (HoldsRareSearch(named)) return WriteRareReport(named, globals);
  const WrittenReport written = WriteCampaignReport(named, named, globals);
  globals.Say(written.verdict);
  globals.Say(fmt::format("report: {} ({:.1f} MB, opens from disk)", written.page.string(),
                          static_cast<double>(written.bytes) / 1e6));
  for (const std::string& film : written.linked) globals.Say("linked, not in the page: " + film);
  globals.Result({{"report", written.page.string()},
                  {"verdict", written.verdict},
                  {"bytes", written.bytes},
                  {"linked", written.linked}});
  return kExitDone;
}

}  // namespace

void AddReport(CommandLine& line, const Globals& globals, int& status) {
  auto folder = std::make_shared<std::string>();
  Subcommand command = line.Add("report",
                                "Write the page of a campaign, report.html, or of rare failures, "
                                "rare.html, from its recorded results alone");
  command.Text("DIR", *folder, "A folder that `campaign` or `rare` wrote",
               Subcommand::Need::kRequired);
  command.OnRun([folder, &globals, &status] { status = WriteReport(*folder, globals); });
}

}  // namespace floorproof
