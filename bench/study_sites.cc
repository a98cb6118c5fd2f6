// SPDX-License-Identifier: Apache-2.0
#include "bench/study_sites.h"

#include <fmt/format.h>

#include "base/streams.h"
#include "env/hazards/hazard_type.h"

namespace floorproof {
namespace {

// A character of drawn floors, what it is, and which of its type's spans its first key is drawn
// from: a step's are down and up.
struct Drawn {
  const char* character;
  const char* type;
  std::size_t span;
};
constexpr Drawn kDrawn[] = {{"cable_cover", "cable_cover", 0},
                            {"groove", "groove", 0},
                            {"rough", "rough", 0},
                            {"raised", "step", 1},
                            {"drop", "step", 0}};

constexpr const char* kTrainingMix =
    "cable_cover: [1, 2], groove: [0, 1], rough: [0, 2], drop: [0, 1], raised: [0, 1], glass: [0, "
    "1], "
    "mixed: 0";
constexpr const char* kTestMix =
    "cable_cover: [0, 1], groove: [0, 2], rough: [1, 3], drop: [0, 2], raised: [0, 1], glass: [0, "
    "2], "
    "mixed: 0";

// Nearer to what is easy: a plan meets a hazard many times.
double Easy(Stream& random, std::pair<double, double> span) {
  constexpr double kHardest = 0.6;
  const double share = kHardest * random.Uniform();
  return span.first < 0 ? span.second + share * (span.first - span.second)
                        : span.first + share * (span.second - span.first);
}

std::string Sizes(const RobotSpec& spec, Stream& random) {
  std::string text;
  for (const Drawn& drawn : kDrawn)
    for (const auto& entry : HazardTypes()) {
      if (entry.name != drawn.type) continue;
      std::string keys;
      for (const KeyRange& range : entry.make()->Ranges(spec))
        keys += fmt::format("{}{}: {:.4g}", keys.empty() ? "" : ", ", range.key,
                            Easy(random, range.spans.at(range.spans.size() > 1 ? drawn.span : 0)));
      text += fmt::format("{}{}: {{{}}}", text.empty() ? "" : ", ", drawn.character, keys);
    }
  return text;
}

}  // namespace

std::string StudyScenario(const std::string& robot, const RobotSpec& spec, StudySet set, int number,
                          const std::string& planner, const std::string& model) {
  const bool training = set == StudySet::kTraining;
  const int seed = number + (training ? 500'000 : 700'000);  // of the site
  Stream random(0, static_cast<std::uint64_t>(seed), "study_sites");
  return fmt::format(
      "scenario: 1\n"
      "site:\n"
      "  site: 1\n"
      "  name: {}_{}\n"
      "  generate: {{kind: fmea, cells: [9, 8], seed: {}, hazards: {{{}}}, sizes: {{{}}}}}\n"
      "  floor: {{friction: 0.6}}\n"
      "robot: \"{}\"\n"
      "risk: {{model: \"{}\"}}\n"
      "plan: {{planner: {}}}\n"
      "randomise:\n"
      "  site.floor.friction: {{uniform: [0.35, 0.9]}}\n"
      "  robot.mass_kg: {{uniform: [{:.4g}, {:.4g}]}}\n",
      Name(set), number, seed, training ? kTrainingMix : kTestMix, Sizes(spec, random), robot,
      model, planner, 0.9 * spec.mass_kg, 1.1 * spec.mass_kg);
}

}  // namespace floorproof
