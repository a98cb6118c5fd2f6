// SPDX-License-Identifier: Apache-2.0
#include "report/rare_films.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "base/interrupt.h"
#include "report/replay.h"
#include "run/episode/records.h"
#include "run/rare/rare_json.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {

namespace fs = std::filesystem;

fs::path LikelyFailureFolder(const fs::path& search, std::size_t number) {
  return search / "likeliest" / std::to_string(number);
}

fs::path FilmOf(const fs::path& search, std::size_t number, const std::vector<std::string>& sets) {
  const fs::path into = LikelyFailureFolder(search, number), film = into / "video.mp4";
  RefuseLinks(search, into);
  if (!IsPlainFile(film)) return "";
  const fs::path recorded = into / "result.json";
  if (!IsPlainFile(recorded)) return "";
  std::optional<JsonValue> drawn;
  try {
    drawn = ReadResult(recorded).Find("drawn");
  } catch (const InputError&) {  // it is filmed again
  }
  if (!drawn) return "";
  const bool same = std::ranges::all_of(sets, [&](const std::string& set) {
    const std::size_t at = set.find('=');
    const std::string key = set.substr(0, at);
    if (key == "episode") return true;  // the record does not say it; draws do not come twice
    const ConfigNode value = ParseYaml(at == std::string::npos ? "" : set.substr(at + 1), "set");
    const auto there = drawn->Find(key);
    return there && there->json() == DrawnJson({{key, value}})[key];
  });
  return same ? film : "";
}

void FilmLikelyFailures(const ScenarioFile& file, const RareOutcome& outcome,
                        const fs::path& folder, const Console& console) {
  for (std::size_t i = 0; i < outcome.failures.size(); ++i) {
    if (Interrupted()) throw Interruption();
    const LikelyFailure& failure = outcome.failures[i];
    if (!FilmOf(folder, failure.region + 1, Sets(failure.set)).empty()) continue;
    const fs::path into = LikelyFailureFolder(folder, failure.region + 1);
    console.Say(fmt::format("film {} of {}: the likeliest failure of its kind", i + 1,
                            outcome.failures.size()));
    Drawn drawn = failure.set;
    std::erase_if(drawn, [](const auto& entry) { return entry.first == "episode"; });
    AddMadePlan(failure.row, folder, file.files(), drawn);
    std::vector<FailureMode> modes;
    for (const Event& event : EventsOf(failure.row)) modes.push_back(event.mode);
    ReplayRow(file.ReadDrawn(outcome.estimate.regions[failure.region].likeliest.noise, drawn),
              failure.row, into, {.video = true, .only_around = modes}, console);
  }
}

}  // namespace floorproof
