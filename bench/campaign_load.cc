// SPDX-License-Identifier: Apache-2.0
// Makes campaigns of many episodes without driving them, for measuring what reads campaigns: all of
// them in one folder, and the same in two halves to be merged. Outcomes, draws, encounters and
// metrics have the form and the length of a driven campaign's.
//   bench_campaign_load FOLDER [EPISODES] [FAILING]
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "base/file_output.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_files.h"
#include "run/campaign/campaign_store.h"
#include "run/campaign/drive_campaign.h"
#include "run/episode/records.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenario = R"(scenario: 1
name: load
seed: 1
site:
  site: 1
  generate: {kind: room, cells: [20, 20], cell_m: 0.25, obstacle_density: 0, seed: 1}
  start: {x_m: 2.5, y_m: 2.5, yaw_deg: 0}
robot: beluga
plan: boustrophedon
randomise:
  site.floor.friction: {uniform: [0.4, 0.9]}
  robot.clearance_m: {uniform: [0.01, 0.03]}
)";

EpisodeRow MakeLoadRow(std::uint64_t id, std::uint64_t every) {
  EpisodeRow row;
  row.variant = "default";
  row.episode = id;
  row.outcome = "success";
  const double share = static_cast<double>(id * 7919 % 100'003) / 100'003;
  for (std::size_t i = 0; i < row.metrics.size(); ++i)
    row.metrics[i] = (1.0 + static_cast<double>(i)) * (0.5 + share) / 3;
  row.drawn = fmt::format(R"({{"site.floor.friction": {}, "robot.clearance_m": {}}})",
                          0.4 + 0.5 * share, 0.03 - 0.02 * share);
  row.plan =
      R"({"status": "success", "waypoints": 212, "length_m": 151.2345678, "turns": 96, "coverage": 0.987654})";
  Encounter met;
  met.hazard = fmt::format("sill {}", id % 7);
  met.type = "step";
  met.size = {{"height_m", 0.02 * share}};
  met.at.speed_mps = 0.3;
  row.encounters = {met, met};
  row.wall_s = 0.25;
  if (id % every != 0) return row;
  row.outcome = "failure";
  row.events_of[static_cast<std::size_t>(FailureMode::kStuck)] = 1;
  row.events = fmt::format(
      R"([{{"mode": "stuck", "kind": "held", "hazard": "sill {}", "t_s": {}, "x_m": {}, "y_m": {}, "text": "stood still for 7.6 s before 'sill', a step of 12 mm"}}])",
      id % 7, 200 * share, 0.5 + 4 * share, 0.5 + static_cast<double>(id % 17) / 4);
  row.encounters.back().outcome = Encounter::Outcome::kFailed;
  row.encounters.back().mode = FailureMode::kStuck;
  return row;
}

void MakeFolder(const ScenarioFile& file, const fs::path& folder, EpisodeRange range,
                std::uint64_t episodes, std::uint64_t every) {
  constexpr std::size_t kBatch = 1000;
  fs::remove_all(folder);
  fs::create_directories(folder);
  CampaignStore store = CampaignStore::Create(folder / "campaign.sqlite", DescribeCampaign(file));
  std::vector<EpisodeRow> rows;
  for (std::uint64_t id = range.begin; id < range.end; ++id) {
    rows.push_back(MakeLoadRow(id, every));
    if (rows.size() < kBatch && id + 1 < range.end) continue;
    store.Add(rows);
    rows.clear();
  }
  store.SetAsked(episodes);
  WriteFileWhole(folder / "scenario.resolved.yaml",
                 ResolvedScenario(file.Read(std::nullopt), folder));
  WriteSummaryFiles(store, file, {}, folder);
}

int Main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_campaign_load FOLDER [EPISODES] [FAILING]\n");
    return 2;
  }
  const fs::path folder = argv[1];
  const std::uint64_t episodes = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100'000;
  const std::uint64_t failing = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : episodes / 10;
  const std::uint64_t every =
      std::max<std::uint64_t>(1, episodes / std::max<std::uint64_t>(1, failing));
  fs::create_directories(folder);
  std::ofstream(folder / "load.yaml") << kScenario;
  const ScenarioFile file(folder / "load.yaml");
  MakeFolder(file, folder / "all", {0, episodes}, episodes, every);
  MakeFolder(file, folder / "a", {0, episodes / 2}, episodes, every);
  MakeFolder(file, folder / "b", {episodes / 2, episodes}, episodes, every);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
