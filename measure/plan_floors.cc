// SPDX-License-Identifier: Apache-2.0
#include "measure/plan_floors.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/config.h"
#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

constexpr DrawnHazard kDrawn[] = {{"cable_cover", "cable_cover", 0},
                                  {"groove", "groove", 0},
                                  {"rough", "rough", 0},
                                  {"raised", "step", 1},
                                  {"drop", "step", 0}};

double Sized(Stream& random, std::pair<double, double> span, double hardest) {
  const double share = hardest * random.Uniform();
  return span.first < 0 ? span.second + share * (span.first - span.second)
                        : span.first + share * (span.second - span.first);
}

}  // namespace

std::span<const DrawnHazard> DrawnHazards() { return kDrawn; }

std::string DrawnKeys(const DrawnHazard& drawn, const RobotSpec& spec, Stream& random,
                      double hardest) {
  std::string keys;
  for (const auto& entry : HazardTypes()) {
    if (entry.name != drawn.type) continue;
    for (const KeyRange& range : entry.make()->Ranges(spec))
      keys += fmt::format(
          "{}{}: {:.4g}", keys.empty() ? "" : ", ", range.key,
          Sized(random, range.spans.at(range.spans.size() > 1 ? drawn.span : 0), hardest));
  }
  return keys;
}

std::string DrawnSizes(const RobotSpec& spec, Stream& random, double hardest) {
  std::string sizes;
  for (const DrawnHazard& drawn : kDrawn)
    sizes += fmt::format("{}{}: {{{}}}", sizes.empty() ? "" : ", ", drawn.character,
                         DrawnKeys(drawn, spec, random, hardest));
  return sizes;
}

std::string PlanFloorsScenario(const std::string& robot, const RobotSpec& spec, int floors,
                               FloorConditions conditions) {
  constexpr double kCell_m = 0.5;
  constexpr int kFirstSeed = 300'000;  // no floor of a study
  constexpr std::pair kFriction(0.35, 0.9), kMass(0.9, 1.1);
  const bool known = conditions != FloorConditions::kDrawn;
  std::string rows;
  for (int floor = 0; floor < floors; ++floor) {
    const int seed = kFirstSeed + floor;
    Stream random(0, static_cast<std::uint64_t>(seed), "plan_floors");
    rows +=
        fmt::format("    - {{label: \"{}\", site.generate.seed: {}, site.generate.sizes: {{{}}}",
                    floor, seed, DrawnSizes(spec, random));
    if (known)
      rows += fmt::format(", site.floor.friction: {:.4g}",
                          random.Uniform(kFriction.first, kFriction.second));
    if (conditions == FloorConditions::kKnown)
      rows += fmt::format(", robot.mass_kg: {:.4g}",
                          random.Uniform(kMass.first, kMass.second) * spec.mass_kg);
    rows += "}\n";
  }
  return fmt::format(
      "# Plans over small floors: what single encounters come to in whole plans (`floorproof "
      "measure`).\n"
      "scenario: 1\n"
      "name: {}\n"
      "robot: {{name: {}}}\n"
      "site:\n"
      "  site: 1\n"
      "  name: floors\n"
      "  generate: {{kind: fmea, cells: [9, 8], cell_m: {:.4g}, hazards: {{cable_cover: [0, 1], "
      "groove: [0, 1], rough: [0, 2], drop: [0, 1], raised: [0, 1], glass: [0, 1], mixed: 0}}}}\n"
      "  floor: {{friction: 0.6}}\n"
      "{}"
      "matrix:\n"
      "  floor:\n{}"
      "  plan.planner: [boustrophedon, spiral, risk_coverage, fmea_path_transform]\n",
      QuotedYaml("plans of " + spec.name), QuotedYaml(robot),
      std::max(kCell_m, 2 * spec.inscribed_radius_m),
      known ? ""
            : fmt::format("sampling: low_discrepancy\n"
                          "randomise:\n"
                          "  site.floor.friction: {{uniform: [{:.4g}, {:.4g}]}}\n"
                          "  robot.mass_kg: {{uniform: [{:.4g}, {:.4g}]}}\n",
                          kFriction.first, kFriction.second, kMass.first * spec.mass_kg,
                          kMass.second * spec.mass_kg),
      rows);
}

}  // namespace floorproof
