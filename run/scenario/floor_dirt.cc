// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/floor_dirt.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/json_schema.h"
#include "planners/online/online_planner.h"
#include "run/scenario/named_plugin.h"

namespace floorproof {
namespace {

const std::string kPath = "dirt.", kCleaningPath = "dirt.cleaning.";
constexpr const char* kTooMany = "more than 100 million particles are not laid";

bool Cleans(const PluginEntry<Planner>& entry) {
  return entry.make()->promises().covers != PlannerPromises::Covers::kNothing;
}

std::vector<PluginEntry<Planner>> Cleaners() {
  std::vector<PluginEntry<Planner>> cleaners;
  std::ranges::copy_if(Planners(), std::back_inserter(cleaners), Cleans);
  return cleaners;
}

std::unique_ptr<Planner> MakeCleaner(const NamedPlugin& named) {
  const std::string key = kCleaningPath + "plan.planner";
  for (const auto& entry : OnlinePlanners())
    if (entry.name == named.name)
      throw InputError(named.mark, key, named.name,
                       "plans on the way over an unknown floor: rounds of cleaning follow a plan "
                       "that is known before");
  const std::vector<PluginEntry<Planner>> cleaners = Cleaners();
  for (const auto& entry : Planners())
    if (entry.name == named.name && !Cleans(entry))
      throw InputError(named.mark, key, named.name, "goes to places and cleans no floor");
  return MakePlugin(std::span<const PluginEntry<Planner>>(cleaners), named.name, key, named.mark);
}

void ReadCleaning(const ConfigNode& node, FloorDirt& dirt) {
  ReadParams(node, kCleaningPath, [&](ParamVisitor& v) { dirt.cleaning.Visit(v); }, {"plan"});
  const NamedPlugin named = ReadNamed(node, "plan", "planner", "boustrophedon", kCleaningPath);
  const auto cleaner = MakeCleaner(named);
  ReadParams(named.params, kCleaningPath + "plan.", *cleaner, {"planner"});
  dirt.cleaner = {named.name, ValuesOf(*cleaner)};
  dirt.cleaner_mark = named.mark;
}

double FloorArea(const HazardMap& map) {
  std::int64_t cells = 0;
  for (int iy = 0; iy < map.frame.height; ++iy)
    for (int ix = 0; ix < map.frame.width; ++ix) cells += !map.IsWall(ix, iy);
  return static_cast<double>(cells) * map.frame.cell_m * map.frame.cell_m;
}

// The side of the tape's image.
void CheckImage(const ConfigNode& node, const SamplingParams& sampling) {
  constexpr double kLeast = 11;   // the window of the structural similarity
  constexpr double kMost = 2000;  // some 100 MB while it is drawn
  const double pixels = 1000 * sampling.tape.side_m * sampling.microscope.pixels_per_mm;
  if (pixels >= kLeast && pixels <= kMost) return;
  const auto written = [&](const char* group, const char* key) -> const ConfigNode* {
    const ConfigNode* in = node.Find(group);
    return in != nullptr ? in->Find(key) : nullptr;
  };
  const ConfigNode* scale = written("microscope", "pixels_per_mm");
  const ConfigNode* named = scale != nullptr ? scale : written("tape", "side_m");
  throw InputError(named != nullptr ? named->mark : node.mark,
                   kPath + (scale != nullptr ? "microscope.pixels_per_mm" : "tape.side_m"),
                   named != nullptr ? named->scalar : "",
                   "makes an image of " + std::to_string(std::lround(pixels)) +
                       " pixels a side: it must have 11 to 2000");
}

}  // namespace

void CleaningRounds::Visit(ParamVisitor& v) {
  v("rounds", rounds, Between(0, 1000), "how often its plan was driven");
  brush.Visit(v);
}

void DirtAuditParams::Visit(ParamVisitor& v) {
  laid.Visit(v);
  sampling.Visit(v);
  v("dirty_above", dirty_above, Between(0, 1e6), "a sample with more particles counted is dirty");
}

FloorDirt ReadDirt(const ConfigNode& node, const HazardMap& map) {
  FloorDirt dirt;
  ReadParams(node, kPath, [&](ParamVisitor& v) { dirt.params.Visit(v); }, {"cleaning"});
  const auto refuse = [&](const char* key, double value, const std::string& rule) {
    throw InputError(MarkOf(node, key), kPath + key, FormatDouble(value), rule);
  };
  const DirtParams& laid = dirt.params.laid;
  if (laid.least_diameter_m > laid.most_diameter_m)
    refuse("least_diameter_m", laid.least_diameter_m,
           "must not be above most_diameter_m, " + FormatDouble(laid.most_diameter_m));
  CheckImage(node, dirt.params.sampling);
  const double floor_m2 = std::max(FloorArea(map), 1e-9);
  const double most_per_m2 = static_cast<double>(kMostParticles) / floor_m2;
  if (laid.density_per_m2 > most_per_m2)
    refuse("density_per_m2", laid.density_per_m2,
           "must be at most " + std::to_string(static_cast<std::int64_t>(most_per_m2)) +
               " on this floor: " + kTooMany);
  // What gathers at walls is counted only where it might be too much: that takes time.
  if (laid.density_per_m2 + 2 * laid.wall_density_per_m2 > most_per_m2) {
    const double expected = ExpectedParticles(map, laid);
    // Their number is linear in it.
    const double even = laid.density_per_m2 * floor_m2;
    const double each = (expected - even) / laid.wall_density_per_m2;
    const double most = (static_cast<double>(kMostParticles) - even) / each;
    if (expected > static_cast<double>(kMostParticles))
      refuse("wall_density_per_m2", laid.wall_density_per_m2,
             "must be at most " + std::to_string(static_cast<std::int64_t>(most)) +
                 " on this floor: " + kTooMany);
  }
  ConfigNode cleaning = ConfigNode::Map();
  cleaning.mark = node.mark;
  if (const ConfigNode* written = node.Find("cleaning"); written != nullptr && !written->IsNull())
    cleaning = *written;
  ReadCleaning(cleaning, dirt);
  return dirt;
}

ConfigNode DirtSchema() {
  FloorDirt usual;
  const std::vector<PluginEntry<Planner>> cleaners = Cleaners();
  const std::vector<NamedSchema> plans =
      PluginSchemas(std::span<const PluginEntry<Planner>>(cleaners));
  const ConfigNode cleaning =
      MapSchema()
          .Params([&](ParamVisitor& v) { usual.cleaning.Visit(v); })
          .Key("plan", NamedPluginSchema("planner", "its name", plans, Unnamed::kFirst),
               "by which the floor was cleaned")
          .Node();
  return OrNull(MapSchema()
                    .Params([&](ParamVisitor& v) { usual.params.Visit(v); })
                    .Key("cleaning", OrNull(cleaning), "who cleaned it before")
                    .Node());
}

ConfigNode WriteDirt(const FloorDirt& dirt) {
  ConfigNode node = WithParams(ConfigNode::Map(), dirt.params);
  ConfigNode cleaning = WithParams(ConfigNode::Map(), dirt.cleaning);
  ConfigNode plan = ConfigNode::Map();
  plan.Add("planner", ConfigNode::Scalar(dirt.cleaner.name, true));
  WriteValues(dirt.cleaner.params, plan);
  cleaning.Add("plan", std::move(plan));
  node.Add("cleaning", std::move(cleaning));
  return node;
}

}  // namespace floorproof
