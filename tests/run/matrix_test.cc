// SPDX-License-Identifier: Apache-2.0
// `matrix`: all combinations, their names, and what is refused.
#include "run/scenario/matrix.h"

#include <gmock/gmock.h>

#include <tuple>

#include "run/scenario/scenario_file.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Variant> Read(const std::string& yaml) {
  const ConfigNode node = ParseYaml(yaml, "s.yaml");
  return ReadMatrix(&node);
}

std::vector<std::string> Names(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

TEST(Matrix, WithoutOneThereIsTheDefault) {
  EXPECT_THAT(Names(ReadMatrix(nullptr)), ElementsAre("default"));
  EXPECT_TRUE(ReadMatrix(nullptr).front().overrides.empty());
}

// Refused by their number, before each is compared with all others.
TEST(Matrix, ManyVariantsAreRefusedAtOnce) {
  std::string list = "[0";
  for (int i = 1; i < 100'000; ++i) list += "," + std::to_string(i);
  try {
    Read("seed_of_x: " + list + "]\n");
    FAIL() << "taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("must be at most 1000 variants"));
  }
}

TEST(Matrix, IsAllCombinationsTheLastKeyFastest) {
  const auto dut = Read("robot: [beluga, htetro]\nsite.floor.friction: [0.5, 1]\n");
  EXPECT_THAT(Names(dut), ElementsAre("robot=beluga,friction=0.5", "robot=beluga,friction=1",
                                      "robot=htetro,friction=0.5", "robot=htetro,friction=1"));
  ASSERT_EQ(dut[2].overrides.size(), 2u);
  EXPECT_EQ(dut[2].overrides[0].first, "robot");
  EXPECT_EQ(dut[2].overrides[0].second.scalar, "htetro");
  EXPECT_EQ(dut[2].overrides[1].first, "site.floor.friction");
  EXPECT_EQ(dut[2].overrides[1].second.scalar, "0.5");
}

TEST(Matrix, FilesAreNamedByTheirStems) {
  EXPECT_THAT(Names(Read("site: [sites/a.yaml, ../b.xml, c.txt]\n")),
              ElementsAre("site=a", "site=b", "site=c.txt"));
}

TEST(Matrix, LabelledEntriesChangeKeysTogether) {
  const auto dut = Read(
      "setup:\n"
      "  - {label: plain, robot: beluga}\n"
      "  - {label: worn, robot: htetro, site.floor.friction: 0.3}\n");
  EXPECT_THAT(Names(dut), ElementsAre("setup=plain", "setup=worn"));
  ASSERT_EQ(dut[1].overrides.size(), 2u);
  EXPECT_EQ(dut[1].overrides[1].first, "site.floor.friction");
}

TEST(Matrix, AKeyMayBeSetWithinWhatAnotherAxisSets) {
  EXPECT_EQ(Read("robot: [htetro]\nrobot.shape: [O, I]").size(), 2u);
}

TEST(Matrix, BadInputNamesLineKeyAndRule) {
  std::string many = "a: [0";
  for (int i = 1; i < 101; ++i) many += ", " + std::to_string(i);
  many += "]\n";
  const std::tuple<std::string, const char*, const char*> cases[] = {
      {"[1]", "s.yaml:1: matrix", "must be a map"},
      {"{}", "matrix", "must be a map"},
      {"robot: beluga", "s.yaml:1: matrix.robot = beluga", "must be a list"},
      {"robot: []", "matrix.robot", "a value or more"},
      {"x: [1]\nrobot: ['a,b']", "s.yaml:2: matrix.robot", "no comma"},
      {"robot: ['a/b']", "matrix.robot", "no comma"},
      {"robot: [beluga, htetro, beluga]", "matrix.robot", "two variants of one name"},
      {"site: [a/x.yaml, b/x.yaml]", "matrix.site", "two variants of one name: give them labels"},
      {"start: [{x_m: 1}]", "matrix.start", "a map with a label"},
      {"start: [[1, 2]]", "matrix.start", "must be a value"},
      {"seed: [1, 2]", "matrix.seed", "cannot differ between variants"},
      {"s: [{label: a, gate.max_rate: 0.1}]", "matrix.s = gate.max_rate", "cannot differ"},
      {many + "b" + many.substr(1), "matrix", "must be at most 1000 variants"},
      {"start.x_m: [1, 2]\nset: [{label: a, start.x_m: 3}]", "matrix.set = start.x_m",
       "a key above sets start.x_m, which this would undo"},
      {"robot.shape: [O, I]\nrobot: [htetro]", "matrix.robot = robot",
       "a key above sets robot.shape"},
      {"s: [{label: " + std::string(200, 'a') + ", start.x_m: 3}]", "matrix.s",
       "has at most 200 bytes"},
  };
  for (const auto& [yaml, where, rule] : cases) {
    try {
      Read(yaml);
      ADD_FAILURE() << yaml << " is taken";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(where)) << yaml;
      EXPECT_THAT(e.what(), HasSubstr(rule)) << yaml;
    }
  }
}

class MatrixScenario : public ScenarioTest {
 protected:
  std::string WhyRefused(const std::string& more, const std::vector<Override>& overrides = {}) {
    Save("plan.csv", "x_m,y_m\n1.5,2.5\n2.5,2.5\n");
    try {
      const ScenarioFile file(Save("s.yaml", RoomScenario("", more)), overrides);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

// Whose value counts must not hang on an order that nobody sees.
TEST_F(MatrixScenario, AKeyIsSetInOnePlaceOnly) {
  const std::string matrix = "matrix: {start.y_m: [2, 3]}\n";
  EXPECT_EQ(WhyRefused(matrix), "");
  EXPECT_EQ(WhyRefused(matrix, {{"start.x_m", "1.5"}}), "");
  EXPECT_THAT(WhyRefused(matrix, {{"start.y_m", "2"}}),
              HasSubstr("start.y_m: the scenario's matrix sets start.y_m"));
  EXPECT_THAT(WhyRefused(matrix, {{"start", "{y_m: 2}"}}), HasSubstr("the scenario's matrix"));
  EXPECT_THAT(WhyRefused(matrix + "randomise: {start.y_m: {uniform: [2, 3]}}\n"),
              HasSubstr("randomise.start.y_m: the scenario's matrix sets start.y_m"));
  EXPECT_THAT(WhyRefused(matrix + "randomise: {start: {choice: [{y_m: 2}]}}\n"),
              HasSubstr("the scenario's matrix sets start.y_m"));
}

// Labelled variants may each change other keys.
TEST_F(MatrixScenario, NoVariantsKeyIsSetElsewhere) {
  const std::string matrix =
      "matrix: {setup: [{label: a, robot: beluga}, {label: b, start.y_m: 3}]}\n";
  EXPECT_EQ(WhyRefused(matrix), "");
  EXPECT_THAT(WhyRefused(matrix, {{"start.y_m", "2"}}), HasSubstr("the scenario's matrix"));
  EXPECT_THAT(WhyRefused(matrix + "randomise: {start.y_m: {uniform: [2, 3]}}\n"),
              HasSubstr("the scenario's matrix"));
}

}  // namespace
}  // namespace floorproof
