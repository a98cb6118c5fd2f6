// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/interrupt.h"
#include "run/episode/records.h"

namespace floorproof {
namespace fs = std::filesystem;

std::vector<Override> Globals::Overrides() const {
  std::vector<Override> overrides;
  for (const auto& text : sets) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"--set", 0}, "", text, "must be KEY=VALUE, as in --set robot=htetro");
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

void Globals::Result(const nlohmann::ordered_json& json_result) const {
  if (json) std::printf("%s\n", JsonText(json_result).c_str());
}

namespace {

// Where the file itself lies, not what it links to: what it names is found from there.
fs::path PlaceOf(const fs::path& file) {
  const fs::path absolute = fs::absolute(file);
  return fs::weakly_canonical(absolute.parent_path()) / absolute.filename();
}

fs::path DefaultFolder(const fs::path& scenario) {
  const fs::path place = PlaceOf(scenario);
  fs::path path = place.lexically_relative(fs::weakly_canonical(fs::current_path()));
  if (path.empty() || *path.begin() == "..") path = place.relative_path();
  if (path.extension() == ".yaml") path.replace_extension();
  return "out" / path;
}

// Settings of an episode and of a campaign have one name: neither replaces the other's.
void RefuseFolderThatHolds(const fs::path& folder, const char* file, const char* what) {
  std::error_code ignored;
  if (fs::exists(folder / file, ignored))
    throw InputError({folder.string(), 0}, "", "",
                     std::string("holds ") + what +
                         ", whose settings this would replace: --out names another folder");
}

}  // namespace

fs::path OutputFolder(const std::string& out, const fs::path& scenario) {
  fs::path folder = out.empty() ? DefaultFolder(scenario) : fs::path(out);
  RefuseFolderThatHolds(folder, "campaign.sqlite", "a campaign");
  return folder;
}

fs::path CampaignFolder(const std::string& out, const fs::path& scenario) {
  fs::path folder = out.empty() ? DefaultFolder(scenario) / "campaign" : fs::path(out);
  RefuseFolderThatHolds(folder, "plan.json", "a plan or a run");
  return folder;
}

void SayDrawn(const Scenario& scenario, const Globals& globals) {
  if (!scenario.drawn.empty())
    globals.Say("drawn by `randomise`, whatever else is written: " + DrawnText(scenario.drawn));
}

int Cores() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int ExitStatus(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSuccess:
      return kDone;
    case Outcome::kFailure:
    case Outcome::kTimeout:
    case Outcome::kNotPlanned:
      return kNotSuccess;
    case Outcome::kError:
      return kBroken;
    case Outcome::kInterrupted:
      return kInterruptedExit;
  }
  return kBroken;
}

}  // namespace floorproof
