// SPDX-License-Identifier: Apache-2.0
#include "report/rare_films.h"

#include <fmt/format.h>

#include "base/input_files.h"
#include "report/drive_and_film.h"

namespace floorproof {

namespace fs = std::filesystem;

fs::path LikelyFailureFolder(const fs::path& search, std::size_t number) {
  return search / "likeliest" / std::to_string(number);
}

void FilmLikelyFailures(const ScenarioFile& file, const RareOutcome& outcome,
                        const fs::path& folder, const Console& console) {
  for (std::size_t i = 0; i < outcome.failures.size(); ++i) {
    const LikelyFailure& failure = outcome.failures[i];
    const fs::path into = LikelyFailureFolder(folder, i + 1);
    std::error_code ignored;
    if (fs::exists(into / "video.mp4", ignored)) continue;
    RefuseLinks(folder, into);
    console.Say(fmt::format("film {} of {}: the likeliest failure of its kind", i + 1,
                            outcome.failures.size()));
    Drawn drawn = failure.set;
    std::erase_if(drawn, [](const auto& entry) { return entry.first == "episode"; });
    if (const std::string made = MadePlan(failure.row); !made.empty())
      drawn.emplace_back("plan.made",
                         ConfigNode::Scalar(fs::absolute(FindCopy(folder, made)).string(), true));
    Scenario scenario = file.ReadDrawn(failure.region.likeliest.noise, drawn);
    RefuseProgram(scenario);
    std::vector<FailureMode> modes;
    for (const Event& event : EventsOf(failure.row)) modes.push_back(event.mode);
    const DriveResult result =
        DriveAndFilm(scenario, into, {.video = true, .draft_around = modes}, console);
    if (result.not_written) std::rethrow_exception(result.not_written);
    if (Name(result.record.outcome) != failure.row.outcome)
      throw InternalError(into.string() + ": it came out other than it was found");
  }
}

}  // namespace floorproof
