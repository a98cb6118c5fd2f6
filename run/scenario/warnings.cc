// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/warnings.h"

#include <fmt/format.h>

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

std::vector<std::string> Warnings(const Scenario& scenario) {
  std::vector<std::string> lines;
  for (const auto& warning : scenario.site.warnings) lines.push_back("warning: " + warning);
  const ContactWalk walk{scenario.physics.timestep_s, scenario.physics.integrator == "discrete"};
  for (const Hazard& hazard : scenario.site.map.hazards) {
    constexpr double kNoticed = 0.02;
    const double asked = hazard.material.restitution;
    const double most = ReboundOf(SoftnessFor(asked, walk), walk);
    if (asked > most + kNoticed)
      lines.push_back(
          fmt::format("warning: {}: restitution {} is more than steps of {} s can give, {:.2f} "
                      "(shorter physics.timestep_s, livelier contacts)",
                      hazard.id, asked, walk.timestep_s, most));
  }
  std::string outside;
  for (const fs::path& file : FilesRead(scenario))
    if (!scenario.files.HasStandIn(file) && !LiesIn(scenario.file.parent_path(), file) &&
        !LiesIn(ModelsFolder(), file))
      outside += (outside.empty() ? "" : ", ") + file.lexically_normal().string();
  if (!outside.empty()) lines.push_back("reads outside the scenario's folder: " + outside);
  return lines;
}

}  // namespace floorproof
