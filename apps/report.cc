// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "report/folder_report.h"

namespace floorproof {
namespace {

int WriteReport(const std::string& named, const Globals& globals) {
  const WrittenReport written = WriteFolderReport(named, named, globals);
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
  Subcommand command =
      line.Add("report",
               "Write the page of a drive, a campaign or a measurement, DIR/report.html, or "
               "of rare failures, DIR/rare.html, from recorded results alone");
  command.Text(
      "DIR", *folder,
      "A folder that `run`, `campaign`, `measure` or `rare` wrote; the page is written there, "
      "and replaces only a page of an earlier `report`",
      Subcommand::Need::kRequired);
  command.OnRun([folder, &globals, &status] { status = WriteReport(*folder, globals); });
}

}  // namespace floorproof
