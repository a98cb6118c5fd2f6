// SPDX-License-Identifier: Apache-2.0
#include "apps/drive_and_film.h"
#include "env/core/input_file.h"
#include "env/run/records.h"

namespace floorproof {
namespace {

constexpr std::uintmax_t kMostBytes = 64u << 20;

// Events and outcome of the drive just made must be the recorded ones: the film shows what was
// judged.
void CheckSame(const std::filesystem::path& result_file, const nlohmann::ordered_json& now) {
  const auto before =
      nlohmann::ordered_json::parse(ReadInputFile(result_file, kMostBytes), nullptr, false);
  if (!before.is_object())
    throw InputError({result_file.string(), 0}, "", "", "is not a result (a JSON object)");
  for (const char* key : {"outcome", "events", "metrics"})
    if (before.value(key, nlohmann::ordered_json()) != now[key])
      throw InternalError(result_file.string() + ": the replay differs from the record in '" + key +
                          "' (recorded with another version or on another machine type?)");
}

}  // namespace

void AddReplay(CLI::App& app, const Globals& globals, int& status) {
  struct Options {
    std::string folder;
    bool video = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "replay", "Drive a recorded episode again, exactly, and film it (for `run`'s folder)");
  command->add_option("DIR", options->folder, "A folder that `run` wrote")->required();
  command->add_flag("--video", options->video, "Film it: video.mp4 and frame_*.png in DIR");
  command->callback([options, &globals, &status] {
    const std::filesystem::path folder = options->folder;
    for (const char* needed : {"scenario.resolved.yaml", "result.json"})
      if (const std::string why = WhyUnreadable(folder / needed, kMostBytes); !why.empty())
        throw InputError({(folder / needed).string(), 0}, "", "",
                         why + ": not a folder of a finished `run`");
    Scenario scenario = ReadScenario(folder / "scenario.resolved.yaml", globals.Overrides());
    const DriveResult result =
        DriveAndFilm(scenario, folder, {.video = options->video, .write_records = false}, globals);
    if (result.not_written) std::rethrow_exception(result.not_written);
    const auto json = ResultJson(scenario, result.record);
    if (globals.sets.empty()) CheckSame(folder / "result.json", json);
    globals.Result(json);
    status = kDone;
  });
}

}  // namespace floorproof
