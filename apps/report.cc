// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/result_folder.h"
#include "report/campaign_page.h"
#include "report/page.h"

namespace floorproof {
namespace {

int WriteReport(const std::string& named, const Globals& globals) {
  const std::filesystem::path folder = named;
  ResultFolder out(folder, PageResults(), {});
  const Report report = GatherReport(folder, named, out, globals);
  const std::string html = ReportHtml(report);
  const std::filesystem::path page = folder / "report.html";
  WriteFileWhole(page, html);
  nlohmann::ordered_json linked = nlohmann::ordered_json::array();
  for (const ReportFilm& film : report.films)
    if (film.mp4.empty()) linked.push_back(film.path);
  globals.Say(VerdictText(report));
  globals.Say(fmt::format("report: {} ({:.1f} MB, opens from disk)", page.string(),
                          static_cast<double>(html.size()) / 1e6));
  for (const auto& film : linked)
    globals.Say("linked, not in the page: " + film.get<std::string>());
  globals.Result({{"report", page.string()},
                  {"verdict", VerdictText(report)},
                  {"bytes", html.size()},
                  {"linked", std::move(linked)}});
  return kDone;
}

}  // namespace

void AddReport(CommandLine& line, const Globals& globals, int& status) {
  auto folder = std::make_shared<std::string>();
  Subcommand command =
      line.Add("report", "Write a campaign's page, report.html, from its recorded results alone");
  command.Text("DIR", *folder, "A folder that `campaign` wrote", Subcommand::Need::kRequired);
  command.OnRun([folder, &globals, &status] { status = WriteReport(*folder, globals); });
}

}  // namespace floorproof
