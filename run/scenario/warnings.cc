// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/input_file.h"
#include "base/quantity.h"
#include "env/scene/models_folder.h"
#include "env/scene/restitution.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

bool LiesIn(const fs::path& folder, const fs::path& file) {
  std::error_code ignored;
  return LiesBelow(fs::canonical(folder.empty() ? "." : folder, ignored),
                   fs::canonical(file, ignored));
}

// What asks for more speed than the robot has gets less, silently: trackers cap it.
void WarnOfSpeeds(const Scenario& s, std::vector<std::string>& lines) {
  const double most_mps = s.world.robot.spec.max_speed_mps;
  const auto capped = [&](const std::string& what, double asked_mps) {
    lines.push_back(fmt::format("warning: {} {} m/s is more than {} drives: {} m/s at most", what,
                                NumberText(asked_mps), s.spec.robot_name, NumberText(most_mps)));
  };
  std::size_t fast = 0, first = 0;
  double asked_mps = 0;
  for (std::size_t i = 0; i < s.spec.user_plan.size(); ++i) {
    if (s.spec.user_plan[i].speed_mps <= most_mps) continue;
    if (fast++ == 0) first = i + 1;
    asked_mps = std::max(asked_mps, s.spec.user_plan[i].speed_mps);
  }
  if (fast > 0)
    capped(
        fmt::format("{}, {} of {} from number {} on: speed_mps of up to", s.spec.plan_file.string(),
                    fast, CountText(s.spec.user_plan.size(), "waypoint"), first),
        asked_mps);
  if (s.spec.recovery && s.spec.recovery->back_off_mps > most_mps)
    capped("react.back_off_mps", s.spec.recovery->back_off_mps);
}

void WarnOfLimits(const Scenario& s, std::vector<std::string>& lines) {
  const MeasuredLimits& measured = s.world.robot.spec.measured;
  const double friction = s.world.site.map.floor_friction;
  if (!measured.why_unused.empty())
    lines.push_back(fmt::format("warning: {}'s measured limits are not used: {}; step_m, {}, is",
                                s.spec.robot_name, measured.why_unused,
                                LengthText(s.world.robot.spec.step_m)));
  else if (!measured.limits.empty() && !measured.hashed)
    lines.push_back(
        fmt::format("warning: {}'s measured limits come without measured_figures: "
                    "whether they were edited since cannot be told; robot --ladder "
                    "measures them again",
                    s.spec.robot_name));
  if (!measured.limits.empty() && friction < measured.frictions.front())
    lines.push_back(fmt::format(
        "warning: {}'s limits were measured on friction {} and more, and "
        "the floor has {}: it crosses less than they say",
        s.spec.robot_name, NumberText(measured.frictions.front()), NumberText(friction)));
}

// A drive over places is no coverage: judged by it, each one fails.
void WarnOfCoverage(const Scenario& s, std::vector<std::string>& lines) {
  const double least = s.spec.episode.min_coverage;
  if (least > 0 && s.spec.plan_by == PlanBy::kPlanner &&
      s.spec.promises.covers == PlannerPromises::Covers::kNothing)
    lines.push_back(
        fmt::format("warning: success.min_coverage is {}, and the planner {} goes to "
                    "places and covers no floor: 0 is what judges its drives",
                    NumberText(least), s.spec.planner_name));
}

void WarnOfDirt(const Scenario& s, std::vector<std::string>& lines) {
  if (!s.world.dirt) return;
  if (!s.spec.promises.visits_places)
    lines.push_back("warning: `dirt` has no effect: this plan takes no samples");
  else if (s.spec.episode.drive != "physics")
    lines.push_back("warning: `dirt` has no effect: nothing is driven");
}

}  // namespace

std::vector<std::string> Warnings(const Scenario& scenario) {
  std::vector<std::string> lines;
  for (const auto& warning : scenario.world.site.warnings) lines.push_back("warning: " + warning);
  const ContactWalk walk{scenario.world.physics.timestep_s,
                         scenario.world.physics.integrator == "discrete"};
  for (const Hazard& hazard : scenario.world.site.map.hazards) {
    constexpr double kNoticed = 0.02;
    const double asked = hazard.material.restitution;
    const double most = ReboundOf(SoftnessFor(asked, walk), walk);
    if (asked > most + kNoticed)
      lines.push_back(
          fmt::format("warning: {}: restitution {} is more than steps of {} s can give, {:.2f} "
                      "(shorter physics.timestep_s, livelier contacts)",
                      hazard.id, asked, walk.timestep_s, most));
  }
  WarnOfLimits(scenario, lines);
  WarnOfSpeeds(scenario, lines);
  WarnOfCoverage(scenario, lines);
  WarnOfDirt(scenario, lines);
  std::string outside;
  for (const fs::path& file : FilesRead(scenario))
    if (!scenario.files.HasStandIn(file) && !LiesIn(scenario.spec.file.parent_path(), file) &&
        !LiesIn(ModelsFolder(), file))
      outside += (outside.empty() ? "" : ", ") + file.lexically_normal().string();
  if (!outside.empty()) lines.push_back("reads outside the scenario's folder: " + outside);
  return lines;
}

}  // namespace floorproof
