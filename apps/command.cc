// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "run/episode/records.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario_spec.h"

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

fs::path DefaultFolder(const fs::path& scenario, const std::string& name) {
  const bool is_folder =
      !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
  return fs::path("out") /
         (scenario.stem() == "scenario" && is_folder ? fs::path(name) : scenario.stem());
}

bool Holds(const fs::path& folder, const char* file) {
  std::error_code ignored;
  return fs::exists(folder / file, ignored);
}

// Settings of an episode and of a campaign have one name: neither replaces the other's.
fs::path Apart(const std::string& out, const fs::path& folder, const char* others, const char* what,
               const char* beside) {
  if (!out.empty() && Holds(out, others))
    throw InputError({out, 0}, "", "",
                     std::string("holds ") + what +
                         ", whose settings this would replace: --out names another folder");
  if (!out.empty()) return out;
  return Holds(folder, others) ? folder / beside : folder;
}

}  // namespace

fs::path OutputFolder(const std::string& out, const fs::path& scenario, const std::string& name) {
  return Apart(out, DefaultFolder(scenario, name), "campaign.sqlite", "a campaign", "run");
}

fs::path CampaignFolder(const std::string& out, const fs::path& scenario, const std::string& name) {
  return Apart(out, DefaultFolder(scenario, name), "plan.json", "a plan or a run", "campaign");
}

void SayDrawn(const ScenarioSpec& spec, const Globals& globals) {
  if (!spec.drawn.empty())
    globals.SayFact("Drawn", DrawnText(spec.drawn) + "; these override the file");
}

int ExitStatus(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSuccess:
      return kExitDone;
    case Outcome::kFailure:
    case Outcome::kTimeout:
    case Outcome::kAborted:
    case Outcome::kNotPlanned:
      return kExitNotSuccess;
    case Outcome::kError:
      return kExitBroken;
    case Outcome::kInterrupted:
      return kInterruptedExit;
  }
  return kExitBroken;
}

}  // namespace floorproof
