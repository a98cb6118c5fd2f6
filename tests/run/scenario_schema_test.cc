// SPDX-License-Identifier: Apache-2.0
// The schema of scenario files beside their reader: what it refuses the reader refuses, and it
// knows every key that the reader knows.
#include "run/scenario/scenario_schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/json_schema.h"
#include "controllers/estimator.h"
#include "controllers/tracker.h"
#include "env/scene/models_folder.h"
#include "run/campaign/campaign_gate.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/scenario_parts.h"
#include "tests/schema_mutations.h"
#include "tests/schema_takes.h"

namespace floorproof {
namespace {

const ConfigNode& Schema() {
  static const ConfigNode kSchema = [] {
    GateParams gate;
    return ScenarioSchema(MapSchema().Params([&](ParamVisitor& v) { gate.Visit(v); }).Node());
  }();
  return kSchema;
}

const std::string kFile = (ModelsFolder() / "scenarios" / "scenario.yaml").string();

// With its gate, which campaigns read. Nothing is drawn: what is written counts.
bool Reads(const ConfigNode& scenario) {
  try {
    const auto file = ScenarioFile::FromText(WriteYaml(scenario), kFile);
    file.Read(std::nullopt);
    CampaignGate::Read(file.gate(), 1000, true);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// With every default stated.
ConfigNode Resolved(const std::string& text) {
  const auto file = ScenarioFile::FromText(text, kFile);
  return ParseYaml(ResolvedScenario(file.Read(), ModelsFolder() / "scenarios"), kFile);
}

const std::string kRoom =
    "scenario: 1\n"
    "site: {site: 1, grid: {rows: \"######\\n#....#\\n#....#\\n######\"}, "
    "start: {x_m: 1, y_m: 1}, goal: {x_m: 2, y_m: 1}}\n"
    "robot: beluga\n";

// All keys of a scenario, in a few of them.
std::vector<ConfigNode> Scenarios() {
  return {
      Resolved(kRoom + "react: {}\nmapper: {}\nsafety: {}\nrisk: {}\ndirt: {}\nestimator: mcl\n"
                       "sensors: {bumper: {}}\nsampling: low_discrepancy\n"
                       "faults: [{type: weak_motor, id: worn 2, wheel: wheel_left}]\n"
                       "randomise: {robot.mass_kg: {normal: [50, 1], min: 40}, "
                       "site.floor.friction: {uniform: [[0.2, 0.4], [0.6, 0.8]]}, "
                       "estimator.start_error_x_m: {lognormal: [0.1, 0.1], max: 1}, "
                       "plan.planner: {choice: [boustrophedon, spiral]}}\n"
                       "matrix: {success.min_coverage: [0, 0.5], "
                       "way: [{label: slow, plan.speed_mps: 0.1}, {label: fast}]}\n"
                       "gate: {mode: sequential}\n"),
      Resolved(kRoom + "plan: {planner: audit}\n"),
      Resolved(kRoom + "plan: {command: [/bin/true, -x]}\ncontroller: {lookahead_s: 1}\n"),
      Resolved(kRoom + "plan: rolling_window\ndrive: cells\n"),
  };
}

TEST(ScenarioSchema, HasTheReadersKeysAtTheTop) {
  std::vector<std::string> known = ScenarioKeys(), stated;
  for (const auto& entry : Schema().Find("properties")->entries) stated.push_back(entry.first);
  std::ranges::sort(known);
  std::ranges::sort(stated);
  EXPECT_EQ(stated, known);
}

TEST(ScenarioSchema, TakesWhatComesWithTheProgram) {
  for (const auto& entry : std::filesystem::directory_iterator(ModelsFolder() / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_TRUE(Takes(Schema(), ReadYamlFile(entry.path()))) << entry.path();
  }
}

TEST(ScenarioSchema, KnowsEveryKeyThatThereIs) {
  for (const ConfigNode& scenario : Scenarios()) {
    EXPECT_TRUE(Reads(scenario)) << WriteYaml(scenario);
    EXPECT_TRUE(Takes(Schema(), scenario)) << WriteYaml(scenario);
  }
}

TEST(ScenarioSchema, KnowsTheKeysOfEveryPlugIn) {
  const auto takes = [](const std::string& more) {
    const ConfigNode scenario = ParseYaml(kRoom + more, "");
    EXPECT_TRUE(Takes(Schema(), scenario)) << more;
    ConfigNode odd = scenario;
    ConfigNode& last = odd.entries.back().second;
    (last.IsList() ? last.items.front() : last).Add("no_such_key", ConfigNode::Scalar("1"));
    EXPECT_FALSE(Takes(Schema(), odd)) << more;
  };
  const auto keys = [](Configurable& of) {
    ConfigNode node = ConfigNode::Map();
    WriteParams(of, node);
    std::string text;
    for (const auto& [key, value] : node.entries) text += ", " + key + ": " + WriteYamlLine(value);
    return text + "}";
  };
  for (const auto& entry : Planners())
    takes("plan: {planner: " + std::string(entry.name) + keys(*entry.make()));
  for (const auto& entry : OnlinePlanners())
    takes("plan: {planner: " + std::string(entry.name) + keys(*entry.make()));
  for (const auto& entry : Trackers())
    takes("controller: {name: " + std::string(entry.name) + keys(*entry.make()));
  for (const auto& entry : Estimators())
    takes("estimator: {name: " + std::string(entry.name) + keys(*entry.make()));
  for (const auto& entry : Faults())
    takes("faults: [{type: " + std::string(entry.name) + keys(*entry.make()) + "]");
}

// A small scenario for each key, and the key: reading takes time as a text is long.
std::vector<std::pair<ConfigNode, std::string>> OnePartEach() {
  std::vector<std::pair<ConfigNode, std::string>> parts;
  std::vector<ConfigNode> all = Scenarios();
  for (ConfigNode& scenario : all)
    for (auto& [key, value] : scenario.entries) {
      const bool again = &scenario != &all.front() && key != "plan" && key != "controller";
      if (again || key == "site" || key == "files") continue;
      ConfigNode part = ParseYaml(kRoom + "sampling: low_discrepancy\n", "");
      part.Add(key, std::move(value));
      parts.emplace_back(std::move(part), key);
    }
  return parts;
}

TEST(ScenarioSchema, RefusesKeysThatThereAreNot) {
  for (auto& [scenario, key] : OnePartEach()) {
    EXPECT_TRUE(Reads(scenario)) << key;
    const auto look = [&scenario = scenario](const std::string& where) {
      if (where.starts_with("matrix.way[")) return;  // keys that a variant sets, any
      EXPECT_FALSE(Takes(Schema(), scenario)) << where;
      EXPECT_FALSE(Reads(scenario)) << where;
    };
    AddUnknownKeys(*scenario.Find(key), look, key);
  }
}

TEST(ScenarioSchema, WhatItRefusesTheReaderRefuses) {
  int refused = 0;
  OddInPlace odd;
  const auto check = [&refused](const ConfigNode& scenario, const std::string& where) {
    if (Takes(Schema(), scenario)) return;
    ++refused;
    EXPECT_FALSE(Reads(scenario)) << where;
  };
  for (auto& [scenario, key] : OnePartEach()) {
    const auto look = [&check, &scenario = scenario](const std::string& where) {
      check(scenario, where);
    };
    odd.PutFor(*scenario.Find(key), look, key);
    LeaveOut(*scenario.Find(key), look, key);
  }
  EXPECT_GT(refused, 300);
}

TEST(ScenarioSchema, RequiresWhatTheReaderRequires) {
  for (const char* key : {"scenario", "site", "robot"}) {
    ConfigNode scenario = ParseYaml(kRoom, "");
    scenario.Remove(key);
    EXPECT_FALSE(Takes(Schema(), scenario)) << key;
    EXPECT_FALSE(Reads(scenario)) << key;
  }
  ConfigNode varied = ParseYaml(kRoom + "matrix: {robot: [beluga, htetro]}\n", "");
  varied.Remove("robot");
  EXPECT_TRUE(Takes(Schema(), varied)) << "the variants name it";
}

TEST(ScenarioSchema, ShortFormsAreTaken) {
  for (const char* more :
       {"plan: spiral", "plan:", "plan: {file: a.csv}", "plan: {overlap: 0.1}",
        "plan: {planner: audit, samples: {file: a.csv}}", "robot: {name: my.xml, mass_kg: 4}",
        "controller: {lookahead_s: 1}", "estimator: {}", "sensors: {lidar: }", "gate: none",
        "matrix:", "safety: {}", "mission: mine.yaml", "risk: {tables: mine.yaml, model: none}",
        "faults:", "mission: {}", "failures: {stuck: }", "site: site.yaml", "name: 7"}) {
    ConfigNode scenario = ParseYaml(kRoom, "");
    for (auto& [key, value] : ParseYaml(more, "").entries) scenario.Add(key, value);
    EXPECT_TRUE(Takes(Schema(), scenario)) << more;
  }
  for (const char* more :
       {"plan: spirall", "plan: {file: a.csv, overlap: 0.1}", "plan: {planner: spirall}",
        "robot: belugaa", "estimator: {lookahead_m: 0.3}", "mission: mine", "gate: some",
        "randomise: {seed: {uniform: [1, 2]}}", "randomise: {plan.command: {choice: [1]}}",
        "randomise: {a: {uniform: [1, 2], normal: [1, 2]}}",
        "randomise: {a: {uniform: [1, 2], min: 1}}", "matrix: {a: 1}", "matrix: {a: [{b: 1}]}",
        "site:", "robot:", "scenario: 2", "faults: [{id: a}]",
        "faults: [{type: weak_motor, id: '7'}]"}) {
    ConfigNode scenario = ParseYaml(kRoom, "");
    for (auto& [key, value] : ParseYaml(more, "").entries) scenario.Add(key, value);
    EXPECT_FALSE(Takes(Schema(), scenario)) << more;
  }
}

}  // namespace
}  // namespace floorproof
