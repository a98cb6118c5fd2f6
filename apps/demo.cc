// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "env/scene/models_folder.h"
#include "report/drive_and_film.h"
#include "report/run_page.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

// The bundled scenarios, and how each should end.
struct DemoDrive {
  const char *scenario, *says;
  Outcome expected;
  const char* mode;  // of the first failure event; empty: none
};
constexpr DemoDrive kDrives[] = {
    {"demo_beluga", "BELUGA covers a hall with furniture, a door sill and a glass wall",
     Outcome::kSuccess, ""},
    {"demo_htetro", "hTetro covers the same hall, forward and sideways on its Mecanum wheels",
     Outcome::kSuccess, ""},
    {"demo_unseen_step", "the same hall, and a 40 mm step that nobody put on the map",
     Outcome::kFailure, "stuck"},
};

bool AsExpected(const DemoDrive& drive, const EpisodeRecord& record) {
  if (record.outcome != drive.expected) return false;
  return record.events.empty() ? *drive.mode == '\0'
                               : Name(record.events.front().mode) == drive.mode;
}

}  // namespace

void AddDemo(CommandLine& line, const Globals& globals, int& status) {
  auto out = std::make_shared<std::string>("out/demo");
  Subcommand command = line.Add("demo",
                                "The bundled site: a clean drive of each robot and a plan "
                                "that fails, driven, judged, filmed");
  command.TextWithDefault("--out", *out, "Output folder");
  command.OnRun([out, &globals, &status] {
    const std::filesystem::path root = *out;
    auto all = nlohmann::ordered_json::object();
    bool good = true;
    std::string finished;
    for (const auto& drive : kDrives) {
      globals.Say("");
      globals.Say(fmt::format("{}: {}", drive.scenario, drive.says));
      Scenario scenario =
          ReadScenario(ModelsFolder() / "scenarios" / (std::string(drive.scenario) + ".yaml"),
                       globals.Overrides());
      const DriveResult result = DriveAndFilm(scenario, root / drive.scenario,
                                              {.video = true, .finished = finished}, globals);
      if (result.not_written) std::rethrow_exception(result.not_written);
      const std::filesystem::path folder = root / drive.scenario;
      globals.SayFact("Page", WriteRunReport(folder, folder.string()).page.string());
      finished += (finished.empty() ? "" : ", ") + (root / drive.scenario).string();
      const bool as_expected = AsExpected(drive, result.record);
      good = good && as_expected;
      globals.Say(fmt::format("{}: expected {}{}{}",
                              as_expected ? "as expected" : "NOT AS EXPECTED", Name(drive.expected),
                              *drive.mode ? ", " : "", drive.mode));
      all[drive.scenario] = ResultJson(scenario, result.record);
    }
    globals.Say("");
    globals.Say("pages, films, heat maps and records are in " + root.string());
    globals.Result(all);
    status = good ? kExitDone : kExitBroken;
  });
}

}  // namespace floorproof
