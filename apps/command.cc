// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <fmt/format.h>

#include <cstdio>

#include "env/scene/restitution.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

bool LiesIn(const fs::path& folder, const fs::path& file) {
  std::error_code ignored;
  const fs::path from = fs::canonical(folder.empty() ? "." : folder, ignored);
  const fs::path to = fs::canonical(file, ignored).lexically_relative(from);
  return !to.empty() && *to.begin() != "..";
}

}  // namespace

std::vector<Override> Globals::Overrides() const {
  std::vector<Override> overrides;
  for (const auto& text : sets) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"--set", 0}, text, "", "must be key.path=value");
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

void Globals::Say(const std::string& line) const {
  if (quiet) return;
  std::FILE* out = json ? stderr : stdout;
  std::fprintf(out, "%s\n", line.c_str());
  std::fflush(out);
}

void Globals::Result(const nlohmann::ordered_json& json_result) const {
  if (json) std::printf("%s\n", json_result.dump(2).c_str());
}

std::filesystem::path OutputFolder(const std::string& out, const Scenario& scenario) {
  return out.empty() ? fs::path("out") / scenario.file.stem() : fs::path(out);
}

void SayWarnings(const Scenario& scenario, const Globals& globals) {
  for (const auto& warning : scenario.site.warnings) globals.Say("warning: " + warning);
  const ContactWalk walk{scenario.physics.timestep_s, scenario.physics.integrator == "discrete"};
  for (const Hazard& hazard : scenario.site.map.hazards) {
    constexpr double kNoticed = 0.02;
    const double asked = hazard.material.restitution;
    const double most = ReboundOf(SoftnessFor(asked, walk), walk);
    if (asked > most + kNoticed)
      globals.Say(
          fmt::format("warning: {}: restitution {} is more than steps of {} s can give, {:.2f} "
                      "(shorter physics.timestep_s, livelier contacts)",
                      hazard.id, asked, walk.timestep_s, most));
  }
  std::string outside;
  for (const fs::path& file : FilesRead(scenario))
    if (!LiesIn(scenario.file.parent_path(), file) && !LiesIn(ModelsFolder(), file))
      outside += (outside.empty() ? "" : ", ") + file.lexically_normal().string();
  if (!outside.empty()) globals.Say("reads outside the scenario's folder: " + outside);
}

}  // namespace floorproof
