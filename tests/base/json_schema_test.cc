// SPDX-License-Identifier: Apache-2.0
// Schemas of parameters, and of maps that a name chooses among.
#include "base/json_schema.h"

#include <gtest/gtest.h>

#include "tests/schema_takes.h"

namespace floorproof {
namespace {

struct Tuning final : Configurable {
  void Visit(ParamVisitor& v) override {
    v("gain", gain, Positive(), "how much");
    v("tries", tries, Between(1, 9), "how often");
    v("fast", fast, "or slowly");
    v("way", way, {"left", "right"}, "which");
    v("label", label, {}, "any text");
    v("limit_m", limit_m, NonNegative(), "at most");
    v.Group(
        "inner", [this](ParamVisitor& g) { g("depth_m", depth_m, AtLeast(2), "below"); },
        "a group");
  }
  double gain = 0.5, depth_m = 3;
  int tries = 2;
  bool fast = true;
  std::string way = "left", label;
  std::optional<double> limit_m;
};

bool Takes(const ConfigNode& schema, const std::string& yaml) {
  return floorproof::Takes(schema, ParseYaml(yaml, ""));
}

TEST(JsonSchema, TakesTheParametersWithTheirRules) {
  Tuning tuning;
  const ConfigNode dut = MapSchema().Params(tuning).Node();
  for (const char* yaml :
       {"{}", "{gain: 1e-3, tries: 9, fast: false, way: right, label: 7, limit_m: none}",
        "{limit_m: 0}", "{inner: {depth_m: 2}}", "{inner: }"})
    EXPECT_TRUE(Takes(dut, yaml)) << yaml;
  for (const char* yaml : {"{gain: 0}", "{gain: high}", "{tries: 10}", "{tries: 1.5}", "{fast: 1}",
                           "{way: up}", "{label: []}", "{limit_m: -1}", "{limit_m: nothing}",
                           "{inner: {depth_m: 1}}", "{inner: {gain: 1}}", "{gains: 1}", "[]", "7"})
    EXPECT_FALSE(Takes(dut, yaml)) << yaml;
}

TEST(JsonSchema, StatesDefaultAndHelp) {
  Tuning tuning;
  const ConfigNode dut = MapSchema().Params(tuning).Node();
  const ConfigNode& keys = *dut.Find("properties");
  EXPECT_EQ(WriteYamlLine(*keys.Find("gain")),
            "{type: \"number\", exclusiveMinimum: 0, default: 0.5, description: \"how much "
            "(default 0.5; must be > "
            "0)\"}");
  EXPECT_EQ(keys.Find("limit_m")->Find("default")->scalar, "none");
  MapSchema bare;
  bare.Params([&](ParamVisitor& v) { tuning.Visit(v); }, MapSchema::Defaults::kElsewhere);
  EXPECT_EQ(WriteYamlLine(bare.At("gain")),
            "{type: \"number\", exclusiveMinimum: 0, description: \"how much (must be > 0)\"}");
}

TEST(JsonSchema, AMapsNameSaysWhichKeysItMayHave) {
  MapSchema apple, pear;
  apple.Key("red", BoolSchema());
  pear.Key("soft", BoolSchema());
  const std::vector<NamedSchema> fruit = {{"apple", "", apple}, {"pear", "", pear}};
  for (const auto unnamed : {Unnamed::kRefused, Unnamed::kFirst, Unnamed::kAny}) {
    const ConfigNode dut = NamedMapSchema("type", "", fruit, unnamed);
    EXPECT_TRUE(Takes(dut, "{type: apple, red: true}"));
    EXPECT_TRUE(Takes(dut, "{type: pear, soft: true}"));
    EXPECT_FALSE(Takes(dut, "{type: pear, red: true}"));
    EXPECT_FALSE(Takes(dut, "{type: apple, soft: true}"));
    EXPECT_FALSE(Takes(dut, "{type: plum}"));
    EXPECT_EQ(Takes(dut, "{red: true}"), unnamed != Unnamed::kRefused);
    EXPECT_EQ(Takes(dut, "{soft: true}"), unnamed == Unnamed::kAny);
    EXPECT_EQ(Takes(dut, "{soft: true, red: true}"), unnamed == Unnamed::kAny);
    EXPECT_FALSE(Takes(dut, "{sweet: true}"));
  }
}

TEST(JsonSchema, RefusedKeysAreWholeWordsAndWhatIsBelow) {
  const ConfigNode dut = AnyKeysSchema(AnythingSchema(), {"seed", "plan.made"});
  for (const char* yaml : {"{seed: 1}", "{seed.a: 1}", "{plan.made: 1}", "{plan.made.x: 1}"})
    EXPECT_FALSE(Takes(dut, yaml)) << yaml;
  for (const char* yaml : {"{seeds: 1}", "{plan: 1}", "{planxmade: 1}", "{a.seed: 1}"})
    EXPECT_TRUE(Takes(dut, yaml)) << yaml;
}

}  // namespace
}  // namespace floorproof
