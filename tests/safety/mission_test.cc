// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "controllers/safety/mission_run.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<PrimitiveType> kTypes = {{"rotation", {"yaw_deg", "p1_s"}, true, "the wheels"},
                                           {"line", {"x_m", "y_m", "p1_s"}, true, "the wheels"},
                                           {"brush", {}, true, "the brush"},
                                           {"acceleration_control", {"p2_s"}, false},
                                           {"stand", {}, false}};

// The paper's example: one skill, Rotation-Line-Rotation with AccelerationControl in parallel, and
// what section 4 assumes of them.
constexpr const char* kGoTo = R"(mission: 1
name: inspect the bridge
primitives:
  rotation: {severity: minor, extent: external, occurrence: low, availability: eminent}
  line: {severity: catastrophic, extent: external, occurrence: very_low, availability: singular}
  acceleration_control: {severity: 6, extent: 2, occurrence: 3, availability: redundant}
skills:
  go_to: {run: [rotation, line, rotation], with: [acceleration_control]}
tasks:
  drive: [go_to]
run: [drive]
)";

Mission Read(const std::string& text) { return ReadMission(ParseYaml(text, "m.yaml"), kTypes); }

// The error for the file with `from` replaced by `to`; "taken" if there is none.
std::string Refusal(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  try {
    Read(text.replace(at, from.size(), to));
  } catch (const InputError& e) {
    return e.what();
  }
  return "taken";
}

// Takes so many periods, and fails as it is told.
struct Script {
  int periods = 1;
  bool fails = false;
  std::optional<Failure> failure;
};
class Scripted : public Primitive {
 public:
  Scripted(Script& script, std::string name, std::vector<std::string>& log)
      : script_(script), name_(std::move(name)), log_(log) {}
  void Start(double) override { log_.push_back(name_); }
  NodeStatus Update(double) override {
    if (script_.fails) return NodeStatus::kFailed;
    return ++run_ < script_.periods ? NodeStatus::kRunning : NodeStatus::kDone;
  }
  std::optional<Failure> failure() const override { return script_.failure; }

 private:
  Script& script_;
  std::string name_;
  std::vector<std::string>& log_;
  int run_ = 0;
};

class MissionTest : public ::testing::Test {
 protected:
  MissionRun Run(const Mission& mission) {
    return MissionRun(mission, [this](const MissionNode& node) {
      return std::make_unique<Scripted>(scripts_[node.name], node.name, log_);
    });
  }
  static std::size_t Find(const Mission& mission, const std::string& name) {
    for (std::size_t i = 0; i < mission.nodes.size(); ++i)
      if (mission.nodes[i].name == name) return i;
    ADD_FAILURE() << name;
    return 0;
  }
  // Of the primitive and of all that it is part of.
  static void ExpectFromLineUp(const MissionRun& dut, const Mission& mission, NodeStatus status) {
    for (const char* name : {"inspect the bridge", "drive", "go_to", "line"})
      EXPECT_EQ(dut.status(Find(mission, name)), status) << name;
  }
  std::map<std::string, Script> scripts_;
  std::vector<std::string> log_;  // what began, in order
};

TEST_F(MissionTest, RunsItsTasksSkillsAndPrimitivesInOrder) {
  const Mission mission = Read(kGoTo);
  MissionRun dut = Run(mission);
  scripts_["rotation"].periods = 2;
  scripts_["line"].periods = 3;
  scripts_["acceleration_control"].periods = 1000;
  int periods = 1;
  while (dut.Update(0.02 * periods) == NodeStatus::kRunning) ++periods;
  EXPECT_THAT(log_, ElementsAre("acceleration_control", "rotation", "line", "rotation"));
  EXPECT_EQ(periods, 2 + 2 + 1) << "where one is done the next begins in the same period";
  scripts_["acceleration_control"].failure = Failure{};
  const std::size_t beside = Find(mission, "acceleration_control");
  EXPECT_EQ(dut.status(beside), NodeStatus::kDone) << "it ran as long as its skill did";
  EXPECT_EQ(dut.failure(beside), std::nullopt);
  ExpectFromLineUp(dut, mission, NodeStatus::kDone);
}

TEST_F(MissionTest, AFailureGoesUpToTheMissionAndWhatFollowsWaits) {
  const Mission mission = Read(kGoTo);
  MissionRun dut = Run(mission);
  scripts_["acceleration_control"].periods = 1000;
  scripts_["line"].fails = true;
  EXPECT_EQ(dut.Update(0), NodeStatus::kFailed);
  ExpectFromLineUp(dut, mission, NodeStatus::kFailed);
  EXPECT_EQ(dut.status(mission.nodes.size() - 2), NodeStatus::kWaiting) << "the second rotation";
  EXPECT_EQ(dut.Update(1), NodeStatus::kFailed) << "and stays so";
}

TEST_F(MissionTest, OneThatRunsInParallelFailsItsSkill) {
  const Mission mission = Read(kGoTo);
  MissionRun dut = Run(mission);
  scripts_["rotation"].periods = 10;
  scripts_["acceleration_control"].fails = true;
  EXPECT_EQ(dut.Update(0), NodeStatus::kFailed);
  EXPECT_EQ(dut.status(Find(mission, "rotation")), NodeStatus::kWaiting);
}

// Section 4, an intermittent fault of the thrusters: availability singular, persistence 1. The text
// prints 24 for Line and 8 for Rotation; by its own assumptions they are 36 and 16
// (docs/safety.md).
TEST_F(MissionTest, TheWorkedExample) {
  const Mission mission = Read(kGoTo);
  MissionRun run = Run(mission);
  DecisionMachine decision(mission.decision);
  const auto of = [&](const char* name, Persistence persistence) {
    const auto found = std::ranges::find(mission.primitives, name, &MissionPrimitive::name);
    return SafetyStateOf(found->rating, {persistence, Availability::kSingular});
  };
  EXPECT_EQ(of("line", Persistence::kIntermittent), 36);
  EXPECT_EQ(of("rotation", Persistence::kIntermittent), 16);
  EXPECT_EQ(of("acceleration_control", Persistence::kIntermittent), 60);
  EXPECT_EQ(of("acceleration_control", Persistence::kPermanent), 96);

  for (const char* name : {"rotation", "line", "acceleration_control"}) {
    scripts_[name].periods = 1000;
    scripts_[name].failure = Failure{Persistence::kIntermittent, Availability::kSingular};
  }
  const auto update = [&](double t_s, std::optional<bool> reconfigured = {}) {
    run.Update(t_s);
    decision.Update(t_s, run.safety_states(), reconfigured);
  };
  const std::size_t go_to = Find(mission, "go_to");
  update(0);
  EXPECT_EQ(run.risk(go_to).greatest, 60) << "it mirrors its worst primitive";
  EXPECT_EQ(LevelOf(run.risk(go_to).greatest, mission.levels), SafetyLevel::kSerious);
  EXPECT_EQ(decision.state(), DecisionState::kReconfiguring) << "through fault mode, above Zmin";
  EXPECT_EQ(decision.transitions().front().to, DecisionState::kFaultMode);
  // The nominal velocity is halved, which "does not change the Safety State".
  update(1, false);
  EXPECT_EQ(decision.state(), DecisionState::kFaultMode);
  for (double t_s = 2; t_s < 10; ++t_s) update(t_s);
  EXPECT_EQ(decision.state(), DecisionState::kFaultMode) << "it continues operating";
  // The time-out: what was intermittent is permanent.
  for (auto& [name, script] : scripts_) script.failure->persistence = Persistence::kPermanent;
  update(10);
  EXPECT_EQ(run.risk(go_to).greatest, 96);
  EXPECT_EQ(LevelOf(96, mission.levels), SafetyLevel::kFatal);
  EXPECT_EQ(decision.state(), DecisionState::kAbort);
  EXPECT_EQ(decision.transitions().back().edge, DecisionEdge::kFatalSkill);
}

constexpr const char* kTwoTasks = R"(mission: 1
name: hall
primitives:
  rotation: {severity: minor, extent: isolated, occurrence: low}
  line: {severity: catastrophic, extent: isolated, occurrence: very_low}
  watch: {type: stand, severity: minor, extent: external, occurrence: very_low}
skills:
  turn: {run: [rotation]}
  go: {run: [line], with: [watch]}
tasks:
  there: [turn, go]
  and_back: [there, there]
run: [and_back, there]
)";

TEST_F(MissionTest, ATaskTakesTheGreatestOfItsSkillsAndTheirSum) {
  const Mission mission = Read(kTwoTasks);
  MissionRun dut = Run(mission);
  scripts_["rotation"] = {2, false, Failure{Persistence::kPermanent, Availability::kRedundant}};
  scripts_["line"] = {2, false, Failure{Persistence::kIntermittent, Availability::kEminent}};
  scripts_["watch"] = {100, false, Failure{Persistence::kPermanent, Availability::kSingular}};
  ASSERT_EQ(dut.skills().size(), 6u);
  const std::size_t there = Find(mission, "there");
  dut.Update(0);
  EXPECT_EQ(dut.risk(there).greatest, 2 * (0 + 2 * 2));
  EXPECT_EQ(dut.risk(there).sum, 8);
  dut.Update(1);  // the turn is done; go has begun: line 6 x (1 + 1), watch 4 x (2 + 2)
  EXPECT_EQ(dut.risk(there).greatest, 16) << "the worst one, in parallel or not";
  EXPECT_EQ(dut.risk(there).sum, 16) << "what is done is no risk";
  EXPECT_EQ(dut.risk(0).greatest, 16);
  EXPECT_THAT(dut.safety_states(), ElementsAre(0, 16, 0, 0, 0, 0));
}

TEST_F(MissionTest, AFailedSkillRemainsARisk) {
  const Mission mission = Read(kTwoTasks);
  MissionRun dut = Run(mission);
  scripts_["rotation"] = {2, true, Failure{Persistence::kPermanent, Availability::kSingular}};
  for (int i = 0; i < 3; ++i) dut.Update(i);
  EXPECT_EQ(dut.risk(0).sum, 2 * (2 + 4));
}

constexpr const char* kBeside = R"(mission: 1
name: hall
primitives:
  line: {severity: catastrophic, extent: isolated, occurrence: very_low}
  brush: {severity: minor, extent: isolated, occurrence: low}
  watch: {type: stand, severity: minor, extent: external, occurrence: very_low}
  listen: {type: stand, severity: catastrophic, extent: isolated, occurrence: low}
skills:
  go: {run: [line]}
  sweep: {run: [brush]}
  see: {with: [watch]}
  hear: {with: [listen]}
tasks:
  there: {run: [go, go], with: [senses, sweep]}
  senses: {with: [see, hear]}
  back: [go]
run: [there, back]
)";

TEST_F(MissionTest, SkillsAndTasksRunBesideThoseInOrderAndEndWithThem) {
  const Mission mission = Read(kBeside);
  MissionRun dut = Run(mission);
  scripts_["line"].periods = 3;
  scripts_["brush"].periods = 2;
  for (const char* name : {"watch", "listen"}) scripts_[name].periods = 1000;
  EXPECT_EQ(dut.Update(0), NodeStatus::kRunning);
  EXPECT_THAT(log_, ElementsAre("watch", "listen", "brush", "line"));
  dut.Update(1);
  EXPECT_EQ(dut.status(Find(mission, "sweep")), NodeStatus::kDone);
  EXPECT_EQ(dut.status(Find(mission, "there")), NodeStatus::kRunning) << "one of those beside it";
  for (int i = 2; i < 5; ++i) dut.Update(i);
  EXPECT_EQ(log_.size(), 6u) << "the second line, and the one of the next task";
  for (const char* name : {"there", "senses", "see", "hear", "watch", "listen"})
    EXPECT_EQ(dut.status(Find(mission, name)), NodeStatus::kDone) << name;
  EXPECT_EQ(dut.status(Find(mission, "back")), NodeStatus::kRunning);
}

// Section 3.3: sum R_i is of every skill. See 4 x (2 + 1 x 1), hear 6 x (1 + 1 x 2), go 6 x (2 +
// 1).
TEST_F(MissionTest, OfSkillsBesideEachOtherTheRisksAddUp) {
  const Mission mission = Read(kBeside);
  MissionRun dut = Run(mission);
  DecisionMachine decision({.z_crit = 61, .zz_crit = 47});
  for (const char* name : {"line", "brush", "watch", "listen"}) scripts_[name].periods = 1000;
  scripts_["watch"].failure = Failure{Persistence::kIntermittent, Availability::kSingular};
  scripts_["listen"].failure = Failure{Persistence::kIntermittent, Availability::kEminent};
  const auto update = [&](double t_s) {
    dut.Update(t_s);
    decision.Update(t_s, dut.safety_states(), false);
  };
  update(0);
  for (const char* name : {"senses", "there", "hall"}) {
    EXPECT_EQ(dut.risk(Find(mission, name)).greatest, 18) << name;
    EXPECT_EQ(dut.risk(Find(mission, name)).sum, 12 + 18) << name;
  }
  EXPECT_EQ(decision.state(), DecisionState::kFaultMode);
  scripts_["line"].failure = Failure{Persistence::kIntermittent, Availability::kSingular};
  update(1);
  EXPECT_EQ(dut.risk(0).greatest, 18) << "no skill is near Zcrit";
  EXPECT_EQ(dut.risk(0).sum, 12 + 18 + 18);
  EXPECT_EQ(decision.state(), DecisionState::kAbort);
  EXPECT_EQ(decision.transitions().back().edge, DecisionEdge::kSumIntolerable);
}

TEST_F(MissionTest, ASkillBesideOthersThatFailsFailsItsTask) {
  const Mission mission = Read(kBeside);
  MissionRun dut = Run(mission);
  for (const char* name : {"line", "brush", "watch"}) scripts_[name].periods = 1000;
  scripts_["listen"].fails = true;
  EXPECT_EQ(dut.Update(0), NodeStatus::kFailed);
  for (const char* name : {"hear", "senses", "there", "hall"})
    EXPECT_EQ(dut.status(Find(mission, name)), NodeStatus::kFailed) << name;
}

TEST(MissionFile, KeepsARatingsOwnKeysForItsType) {
  const Mission mission = Read(
      "mission: 1\nprimitives: {line: {p1_s: 3, severity: 2}}\nskills: {go: {run: [line]}}\n"
      "tasks: {a: [go]}\nrun: [a]\nweights: {severity: 0.5}\nlevels: {serious: 80}\n"
      "decision: {z_crit: 90, zz_crit: 100}\n");
  const MissionPrimitive& line = mission.primitives.front();
  EXPECT_EQ(line.type, "line");
  ASSERT_EQ(line.params.entries.size(), 1u);
  EXPECT_EQ(line.params.entries[0].first, "p1_s");
  EXPECT_EQ(mission.weights.severity, 0.5);
  EXPECT_EQ(mission.levels.serious, 80);
  EXPECT_EQ(mission.decision.zz_crit, 100);
}

TEST(MissionFile, ASkillHandsItsKeysToThoseOfItsPrimitivesThatKnowThem) {
  const Mission mission = Read(
      "mission: 1\nprimitives: {line: {p1_s: 3}, rotation: {}}\n"
      "skills: {go: {run: [rotation, line], x_m: 2, p1_s: 4}, on: {run: [line]}}\n"
      "tasks: {a: [go, on]}\nrun: [a]\n");
  const auto keys = [&](std::size_t node) {
    std::map<std::string, std::string> found;
    for (const auto& [key, value] : mission.nodes[node].params.entries) found[key] = value.scalar;
    return found;
  };
  using Keys = std::map<std::string, std::string>;
  EXPECT_EQ(keys(3), Keys({{"p1_s", "4"}})) << "the rotation knows no x_m";
  EXPECT_EQ(keys(4), Keys({{"p1_s", "4"}, {"x_m", "2"}})) << "the skill's rules";
  EXPECT_EQ(keys(6), Keys({{"p1_s", "3"}})) << "another skill's are not its own";
}

TEST(MissionFile, WhatCannotBeIsRefusedWithLineAndKey) {
  const auto refusal = [](const std::string& from, const std::string& to) {
    return Refusal(kTwoTasks, from, to);
  };
  EXPECT_EQ(refusal("hall", "hall"), "taken");
  EXPECT_EQ(refusal("there: [turn, go]", "there: [turn, and_back]"),
            "m.yaml:11: tasks.there = and_back: is part of itself: and_back -> there -> and_back");
  EXPECT_EQ(refusal("there: [turn, go]", "there: [there]"),
            "m.yaml:11: tasks.there = there: is part of itself: there -> there");
  EXPECT_THAT(refusal("run: [line]", "run: [lines]"),
              HasSubstr("m.yaml:9: skills.go.run = lines: is no primitive of this mission; did you "
                        "mean line? (known: rotation line watch)"));
  EXPECT_THAT(refusal("run: [line]", "run: [turn]"),
              HasSubstr("skills.go.run = turn: is a skill: skills are made of primitives"));
  EXPECT_THAT(refusal("type: stand", "type: stnd"),
              HasSubstr("m.yaml:6: primitives.watch.type = stnd: is no primitive; did you mean "
                        "stand?"));
  EXPECT_THAT(
      refusal("[turn, go]", "[turn, goo]"),
      HasSubstr("m.yaml:11: tasks.there = goo: is neither skill nor task; did you mean go?"));
  EXPECT_THAT(refusal("run: [and_back, there]", "run: [go]"),
              HasSubstr("m.yaml:13: run = go: is a skill, and no task"));
  EXPECT_EQ(refusal("severity: minor", "severity: 3"),
            "m.yaml:4: primitives.rotation.severity = 3: must be one of absence (0) minor (2) "
            "catastrophic (6)");
  EXPECT_THAT(refusal("occurrence: low", "occurrence: often"),
              HasSubstr("must be one of very_low (1) low (2) high (3) relatively_high (4)"));
  EXPECT_THAT(refusal("name: hall", "levels: {weak: 20}"),
              HasSubstr("m.yaml:2: levels.weak = 20: must be above medium, 20"));
  EXPECT_THAT(refusal("name: hall", "decision: {x_crit: 70}"), HasSubstr("decision.x_crit = 70"));
  EXPECT_THAT(refusal("name: hall", "weights: {severity: 11}"),
              HasSubstr("weights.severity = 11: must be in [0, 10]"));
  EXPECT_THAT(refusal("name: hall", "nmae: hall"), HasSubstr("nmae"));
  EXPECT_THAT(refusal("name: hall", "levels: {serious: 61}"),
              HasSubstr("levels.serious = 61: must be below decision.z_crit, 61"));
  EXPECT_THAT(refusal("run: [line]", "run: [line, watch]"),
              HasSubstr("skills.go.run = watch: goes on for ever: it belongs under with"));
  EXPECT_THAT(refusal("with: [watch]", "with: [line]"),
              HasSubstr("skills.go.with = line: comes to an end: it belongs under run"));
  EXPECT_THAT(refusal("run: [and_back, there]", "run: [there]\ntasks2: {}"), HasSubstr("tasks2"));
  EXPECT_THAT(refusal("and_back: [there, there]", "and_back: [there]\n  a: [b]\n  b: [a]"),
              HasSubstr("is part of itself: a -> b -> a"))
      << "though nothing runs them";
  EXPECT_THAT(refusal("  go: {run", "  idle: {run: [nothing]}\n  go: {run"),
              HasSubstr("skills.idle.run = nothing: is no primitive of this mission"));
  EXPECT_THAT(refusal("run: [line], with: [watch]", "run: [line], x: 2"),
              HasSubstr("m.yaml:9: skills.go.x: unknown key; did you mean x_m?"));
  EXPECT_THAT(refusal("severity: minor, extent: isolated", "severty: minor"),
              HasSubstr("m.yaml:4: primitives.rotation.severty: unknown key"));
  EXPECT_THAT(refusal("mission: 1", "mission: 2"), HasSubstr("mission = 2"));
  EXPECT_THAT(refusal("run: [and_back, there]", "run: []"), HasSubstr("run"));
  EXPECT_THAT(refusal("  turn: {run: [rotation]}", "  line: {run: [rotation]}"),
              HasSubstr("skills.line: is the name of a primitive, too"));
}

TEST(MissionFile, WhatCannotRunSideBySideIsRefusedWithLineAndKey) {
  const auto refusal = [](const std::string& from, const std::string& to) {
    return Refusal(kBeside, from, to);
  };
  const std::string with = "with: [senses, sweep]";
  EXPECT_EQ(refusal(with, with), "taken");
  EXPECT_EQ(refusal(with, "with: [senses, back]"),
            "m.yaml:14: tasks.there.with = back: needs the wheels while go does, which runs beside "
            "it");
  EXPECT_EQ(refusal(with, "with: [sweep, sweep]"),
            "m.yaml:14: tasks.there.with = sweep: needs the brush while sweep does, which runs "
            "beside it");
  EXPECT_EQ(refusal("senses: {with: [see, hear]}", "senses: {with: [see, go]}"),
            "m.yaml:14: tasks.there.with = senses: needs the wheels while go does, which runs "
            "beside it")
      << "however deep";
  EXPECT_EQ(refusal("back: [go]", "back: [see]"),
            "m.yaml:16: tasks.back = see: goes on for ever: it belongs under with");
  EXPECT_EQ(refusal("run: [go, go]", "run: [go, senses]"),
            "m.yaml:14: tasks.there.run = senses: goes on for ever: it belongs under with");
  EXPECT_EQ(refusal("run: [there, back]", "run: [senses]"),
            "m.yaml:17: run = senses: goes on for ever: it belongs under with");
  EXPECT_EQ(refusal("run: [go, go], ", "run: [], "),
            "m.yaml:14: tasks.there.run: must be a list of skills or tasks");
  EXPECT_EQ(refusal("{run: [go, go], with: [senses, sweep]}", "{}"),
            "m.yaml:14: tasks.there.run: must be a list of skills or tasks");
  EXPECT_THAT(refusal("run: [go, go], ", "run: [go, go], wiht: [see], "),
              HasSubstr("m.yaml:14: tasks.there.wiht: unknown key; did you mean with?"));
  EXPECT_THAT(
      refusal("back: [go]", "back: go"),
      HasSubstr("m.yaml:16: tasks.back = go: must be a list of skills or tasks, or a map of "
                "run and with"));
}

TEST(MissionFile, ATreeThatGrowsAsAPowerIsRefused) {
  std::string text =
      "mission: 1\nprimitives: {line: {}}\nskills: {go: {run: [line]}}\ntasks:\n  t0: [go, go]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string below = "t" + std::to_string(i - 1);
    text += "  t" + std::to_string(i) + ": [" + below + ", " + below + "]\n";
  }
  try {
    Read(text + "run: [t29]\n");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("more than 10,000 nodes"));
  }
}

TEST(MissionFile, ATreeThatIsTooDeepIsRefused) {
  std::string text =
      "mission: 1\nprimitives: {line: {}}\nskills: {go: {run: [line]}}\ntasks:\n  t0: [go]\n";
  for (int i = 1; i < 200; ++i)
    text += "  t" + std::to_string(i) + ": [t" + std::to_string(i - 1) + "]\n";
  try {
    Read(text + "run: [t199]\n");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("lies more than 100 tasks deep"));
  }
}

}  // namespace
}  // namespace floorproof
