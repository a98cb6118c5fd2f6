// SPDX-License-Identifier: Apache-2.0
#include "bench/study_sites.h"

#include <fmt/format.h>

#include "base/config.h"
#include "base/streams.h"
#include "env/geometry/distance.h"
#include "env/map/init_files.h"
#include "env/map/site.h"
#include "measure/plan_floors.h"

namespace floorproof {
namespace {

constexpr const char* kTrainingMix =
    "cable_cover: [1, 2], groove: [0, 1], rough: [0, 2], drop: [0, 1], raised: [0, 1], glass: [0, "
    "1], "
    "mixed: 0";
constexpr const char* kTestMix =
    "cable_cover: [0, 1], groove: [0, 2], rough: [1, 3], drop: [0, 2], raised: [0, 1], glass: [0, "
    "2], "
    "mixed: 0";

constexpr const char* kHardMix =
    "cable_cover: [1, 2], groove: [1, 2], rough: [0, 2], drop: [0, 1], raised: [0, 1], glass: [0, "
    "1], "
    "mixed: 0";

std::string Generated(const RobotSpec& spec, const char* mix, int seed, Stream& random,
                      double hardest = kUsuallyHardest) {
  return fmt::format(
      "  generate: {{kind: fmea, cells: [9, 8], seed: {}, hazards: {{{}}}, sizes: {{{}}}}}\n", seed,
      mix, DrawnSizes(spec, random, hardest));
}

// Places on open floor, away from walls, from the start and from each other.
std::vector<Vec2> OpenPlaces(const HazardMap& map, const Vec2& start_W, int most, Stream& random) {
  constexpr double kFromWalls_m = 0.7, kApart_m = 1.4;
  Grid<std::uint8_t> walls(map.frame.width, map.frame.height, 0);
  std::vector<Vec2> open;
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix) walls(ix, iy) = map.IsWall(ix, iy);
  const Grid<float> distance = DistanceToSet(walls, true);
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix)
      if (distance(ix, iy) * map.frame.cell_m >= kFromWalls_m)
        open.push_back(map.frame.Center(ix, iy));
  std::vector<Vec2> places;
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries && !open.empty() && static_cast<int>(places.size()) < most; ++i) {
    const Vec2 place = open[random.Below(open.size())];
    bool apart = (place - start_W).norm() >= kApart_m;
    for (const Vec2& other : places) apart = apart && (place - other).norm() >= kApart_m;
    if (apart) places.push_back(place);
  }
  return places;
}

// A map with hazards laid on its open floor, each at an angle of its own, and where to start.
std::string Laid(const StudyInputs& inputs, int number, Stream& random, std::string& start) {
  constexpr int kMost = 4;
  constexpr double kHalf_m = 0.3;  // of a square's side, and of a line
  const std::string name = kStudyMaps[static_cast<std::size_t>(number) % kStudyMaps.size()];
  const std::string map = (inputs.maps / name / "map.yaml").string();
  const Site site = ReadSite(
      ParseYaml(fmt::format("site: 1\nname: {}\nmap: {}\nunknown: wall\n", name, QuotedYaml(map)),
                map),
      inputs.maps);
  const Pose2 from = ChooseStart(site.map, inputs.spec);
  start = fmt::format("start: {{x_m: {:.6g}, y_m: {:.6g}, yaw_deg: {:.6g}}}\n", from.x_m, from.y_m,
                      from.yaw_rad * 180 / kPi);
  std::string text = fmt::format("  map: {}\n  unknown: wall\n  hazards:\n", QuotedYaml(map));
  for (const Vec2& place : OpenPlaces(site.map, from.p(), kMost, random)) {
    const DrawnHazard& drawn = DrawnHazards()[random.Below(DrawnHazards().size())];
    const bool line =
        drawn.type == std::string("cable_cover") || drawn.type == std::string("groove");
    const Pose2 X_WH{place.x(), place.y(), random.Uniform(0, 2 * kPi)};
    std::string points;
    const std::vector<Vec2> corners = line ? std::vector<Vec2>{{-kHalf_m, 0}, {kHalf_m, 0}}
                                           : Rectangle({-kHalf_m, -kHalf_m}, {kHalf_m, kHalf_m});
    for (const Vec2& corner : corners) {
      const Vec2 p = X_WH * corner;
      points += fmt::format("{}[{:.4f}, {:.4f}]", points.empty() ? "" : ", ", p.x(), p.y());
    }
    text +=
        fmt::format("    - {{type: {}, {}: [{}], {}}}\n", drawn.type, line ? "line_m" : "polygon_m",
                    points, DrawnKeys(drawn, inputs.spec, random));
  }
  return text;
}

}  // namespace

std::string StudyScenario(const StudyInputs& inputs, StudySet set, int number,
                          const std::string& planner) {
  const int seed = number + 100'000 * (5 + 2 * static_cast<int>(set));  // of the site
  Stream random(0, static_cast<std::uint64_t>(seed), "study_sites");
  std::string start;
  constexpr double kHarder = 0.8;
  std::string floor;
  switch (set) {
    case StudySet::kTraining:
      floor = Generated(inputs.spec, kTrainingMix, seed, random);
      break;
    case StudySet::kTest:
      floor = Generated(inputs.spec, kTestMix, seed, random);
      break;
    case StudySet::kMaps:
      floor = Laid(inputs, number, random, start);
      break;
    case StudySet::kHard:
      floor = Generated(inputs.spec, kHardMix, seed, random, kHarder);
      break;
  }
  return fmt::format(
      "scenario: 1\n"
      "seed: {}\n"  // of the drives: sites that shared their draws would be off together
      "site:\n"
      "  site: 1\n"
      "  name: {}_{}\n"
      "{}"
      "  floor: {{friction: 0.6}}\n"
      "robot: {}\n"
      "{}"
      "risk: {{model: {}}}\n"
      "plan: {{planner: {}}}\n"
      "randomise:\n"
      "  site.floor.friction: {{uniform: [0.35, 0.9]}}\n"
      "  robot.mass_kg: {{uniform: [{:.4g}, {:.4g}]}}\n",
      seed, Name(set), number, floor, QuotedYaml(inputs.robot), start, QuotedYaml(inputs.model),
      planner, 0.9 * inputs.spec.mass_kg, 1.1 * inputs.spec.mass_kg);
}

}  // namespace floorproof
