// SPDX-License-Identifier: Apache-2.0
#include "env/map/generate.h"

#include <algorithm>
#include <string>
#include <vector>

#include "env/map/crossing_site.h"
#include "env/map/site_generator.h"

namespace floorproof {
namespace {

struct Kind {
  std::string name;
  bool random;
  ConfigNode (*resolved)(const ConfigNode& generate);
  ConfigNode (*drawn)(const ConfigNode& generate, std::uint64_t campaign_seed,
                      std::uint64_t episode);
};

ConfigNode ResolvedDrawing(const ConfigNode& generate) {
  return WriteGenerate(ReadGenerate(generate));
}

ConfigNode Drawing(const ConfigNode& generate, std::uint64_t campaign_seed, std::uint64_t episode) {
  const GenerateParams params = ReadGenerate(generate);
  Stream stream = params.seed ? Stream(static_cast<std::uint64_t>(*params.seed), 0, "site")
                              : Stream(campaign_seed, episode, "site");
  return DrawSite(params, generate, stream);
}

ConfigNode ResolvedCrossing(const ConfigNode& generate) {
  return WriteCrossing(ReadCrossing(generate));
}

ConfigNode Crossing(const ConfigNode& generate, std::uint64_t, std::uint64_t) {
  return LayCrossing(ReadCrossing(generate), generate);
}

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kKinds = [] {
    std::vector<Kind> kinds;
    for (const SiteKind& drawing : SiteKinds())
      kinds.push_back({drawing.name, true, ResolvedDrawing, Drawing});
    kinds.push_back({"crossing", false, ResolvedCrossing, Crossing});
    return kinds;
  }();
  return kKinds;
}

const Kind& KindOf(const ConfigNode& generate) {
  std::string name = Kinds().front().name;
  std::vector<std::string> names, others;
  for (const Kind& kind : Kinds()) names.push_back(kind.name);
  for (const auto& entry : generate.entries) others.push_back(entry.first);
  ReadParams(
      generate, "generate.", [&](ParamVisitor& v) { v("kind", name, names, "what is drawn"); },
      others);
  return *std::ranges::find(Kinds(), name, &Kind::name);
}

}  // namespace

bool DrawnAtRandom(const ConfigNode& generate) {
  return KindOf(generate).random && generate.Find("seed") == nullptr;
}

ConfigNode ResolvedGenerate(const ConfigNode& generate) {
  return KindOf(generate).resolved(generate);
}

ConfigNode GenerateSchema() {
  std::vector<NamedSchema> kinds = GenerateSchemas();
  kinds.push_back(CrossingSchema());
  return NamedMapSchema("kind", "what is drawn", kinds, Unnamed::kFirst);
}

ConfigNode Generated(const ConfigNode& generate, std::uint64_t campaign_seed,
                     std::uint64_t episode) {
  return KindOf(generate).drawn(generate, campaign_seed, episode);
}

}  // namespace floorproof
