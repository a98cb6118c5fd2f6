// SPDX-License-Identifier: Apache-2.0
// The schema of site files beside their reader: what it refuses the reader refuses, and it knows
// every key that the reader knows.
#include "env/map/site_keys.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "env/hazards/hazard_type.h"
#include "env/map/site.h"
#include "tests/places.h"
#include "tests/schema_mutations.h"
#include "tests/schema_takes.h"

namespace floorproof {
namespace {

const ConfigNode& Schema() {
  static const ConfigNode kSchema = SiteSchema();
  return kSchema;
}

bool Reads(const ConfigNode& site) {
  try {
    ReadSite(site, "");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// With every default stated.
ConfigNode Resolved(const std::string& text) {
  return ResolveSite(ParseYaml(text, "site.yaml"), "", "");
}

const std::string kGrid = "site: 1\ngrid: {rows: \"######\\n#.G.v#\\n#.=r.#\\n######\"}\n";

std::vector<ConfigNode> Sites(const std::vector<std::string>& kinds) {
  std::string hazards = "hazards:\n";
  for (const std::string& type : PluginNames(HazardTypes())) {
    const bool line =
        MakePlugin(HazardTypes(), type, "")->placement() == HazardType::Placement::kLine;
    hazards += "  - {type: " + type + ", id: 2nd " + type + ", " +
               (line ? "line_m: [[0.6, 0.6], [1.2, 0.6]]}\n"
                     : "polygon_m: [[0.6, 0.6], [1.2, 0.6], [1.2, 1.2], [0.6, 1.2]]}\n");
  }
  std::vector<ConfigNode> sites = {
      Resolved(kGrid + "start: {x_m: 0.75, y_m: 0.75}\ngoal: {x_m: 0.75, y_m: 1.25}\n" + hazards)};
  for (const std::string& kind : kinds)
    sites.push_back(Resolved("site: 1\ngenerate: {seed: 3, kind: " + kind + "}\n"));
  sites.push_back(
      Resolved("site: 1\ngenerate: {kind: crossing, outline_m: [[0, 0], [1, 0], [0, 1]]}\n"));
  return sites;
}

TEST(SiteSchema, KnowsEveryKeyThatThereIs) {
  for (const ConfigNode& site : Sites({"room", "rooms", "fmea"})) {
    ASSERT_TRUE(Reads(site)) << WriteYaml(site);
    EXPECT_TRUE(Takes(Schema(), site)) << WriteYaml(site);
  }
}

TEST(SiteSchema, TakesWhatComesWithTheProgram) {
  int taken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SourceFile("models/sites"))) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_TRUE(Takes(Schema(), ReadYamlFile(entry.path()))) << entry.path();
    ++taken;
  }
  EXPECT_GT(taken, 10);
}

TEST(SiteSchema, RefusesKeysThatThereAreNot) {
  for (ConfigNode site : Sites({"room"}))
    AddUnknownKeys(site, [&](const std::string& where) {
      EXPECT_FALSE(Takes(Schema(), site)) << where;
      EXPECT_FALSE(Reads(site)) << where;
    });
}

TEST(SiteSchema, WhatItRefusesTheReaderRefuses) {
  int refused = 0;
  const auto check = [&refused](const ConfigNode& site, const std::string& where) {
    if (Takes(Schema(), site)) return;
    ++refused;
    EXPECT_FALSE(Reads(site)) << where;
  };
  OddInPlace odd;
  for (ConfigNode site : Sites({"room"})) {
    const auto look = [&](const std::string& where) { check(site, where); };
    odd.Put(site, look);
    LeaveOut(site, look);
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace floorproof
