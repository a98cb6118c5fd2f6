// SPDX-License-Identifier: Apache-2.0
#include "controllers/safety/decision.h"

#include <gmock/gmock.h>

#include <vector>

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using State = DecisionState;
using Edge = DecisionEdge;

// Two skills that matter, so that one and the sum differ.
DecisionParams TwoSkills() {
  DecisionParams params;
  params.z_crit = 61;
  params.zz_crit = 90;
  params.w = 2;
  return params;
}

class DecisionTest : public ::testing::Test {
 protected:
  std::vector<Edge> Edges() const {
    std::vector<Edge> edges;
    for (const DecisionTransition& t : dut_.transitions()) edges.push_back(t.edge);
    return edges;
  }
  void Update(std::vector<double> states, std::optional<bool> reconfigured = {}) {
    dut_.Update(t_s_ += 0.02, states, reconfigured);
  }
  DecisionMachine dut_{TwoSkills()};
  double t_s_ = 0;
};

TEST_F(DecisionTest, WithoutRiskItStaysNormal) {
  for (int i = 0; i < 100; ++i) Update({0, 20});
  EXPECT_EQ(dut_.state(), State::kNormal);
  EXPECT_THAT(Edges(), IsEmpty());
}

TEST_F(DecisionTest, ASumAboveXcritLeadsToFaultModeAndIsAssessed) {
  Update({10, 10.5});
  EXPECT_EQ(dut_.state(), State::kFaultMode);
  EXPECT_THAT(Edges(), ElementsAre(Edge::kSumRose, Edge::kToAssess, Edge::kBelowZmin));
  for (int i = 0; i < 100; ++i) Update({10, 10.5});
  EXPECT_EQ(dut_.transitions().size(), 3u) << "what was assessed is not assessed again";
}

TEST_F(DecisionTest, AtYcritItStaysAndBelowItReturnsToNormal) {
  Update({15, 15});
  Update({11, 0});
  EXPECT_EQ(dut_.state(), State::kFaultMode);
  Update({10.9, 0});
  EXPECT_EQ(dut_.state(), State::kNormal);
  EXPECT_EQ(dut_.transitions().back().edge, Edge::kSumFell);
}

TEST_F(DecisionTest, AtZminItIsReconfigured) {
  Update({41.9, 0});
  EXPECT_EQ(dut_.state(), State::kFaultMode);
  Update({42, 0});
  EXPECT_EQ(dut_.state(), State::kReconfiguring);
  for (int i = 0; i < 10; ++i) Update({42, 0});
  EXPECT_EQ(dut_.state(), State::kReconfiguring) << "until it is over";
  Update({8, 0}, true);
  EXPECT_EQ(dut_.state(), State::kNormal) << "and then goes back through fault mode";
}

TEST_F(DecisionTest, WReconfigurationsMayFailThenFaultModeRemains) {
  Update({50, 0});
  Update({50, 0}, false);
  EXPECT_EQ(dut_.state(), State::kReconfiguring) << "the second try";
  Update({50, 0}, false);
  EXPECT_EQ(dut_.state(), State::kFaultMode);
  EXPECT_EQ(dut_.transitions().back().edge, Edge::kNoneLeft);
  EXPECT_EQ(dut_.failed_reconfigurations(), 2);
  Update({55, 0});
  EXPECT_EQ(dut_.state(), State::kFaultMode) << "assessed anew, and nothing is left to try";
  Update({0, 0});
  EXPECT_EQ(dut_.failed_reconfigurations(), 0) << "once it was normal all may be tried again";
}

TEST_F(DecisionTest, ASkillThatReachesZcritEndsTheMissionInAnyState) {
  const std::vector<std::vector<double>> before[] = {
      {}, {{30, 0}}, {{50, 0}}};  // normal, fault mode, reconfiguring
  for (const auto& updates : before) {
    DecisionMachine dut(TwoSkills());
    for (const auto& states : updates) dut.Update(0, states);
    dut.Update(1, std::vector<double>{0, 60.9});
    EXPECT_NE(dut.state(), State::kAbort);
    dut.Update(1, std::vector<double>{0, 61});
    EXPECT_EQ(dut.state(), State::kAbort);
    EXPECT_EQ(dut.transitions().back().edge, Edge::kFatalSkill);
    EXPECT_EQ(dut.transitions().back().worst, 1u);
    dut.Update(2, std::vector<double>{0, 0});
    EXPECT_EQ(dut.state(), State::kAbort) << "for good";
  }
}

TEST_F(DecisionTest, ASumThatReachesZZcritEndsItInFaultMode) {
  Update({45, 44.9});
  EXPECT_NE(dut_.state(), State::kAbort);
  DecisionMachine dut(TwoSkills());
  dut.Update(0, std::vector<double>{45, 45});
  EXPECT_EQ(dut.state(), State::kAbort);
  EXPECT_EQ(dut.transitions().back().edge, Edge::kSumIntolerable);
}

TEST_F(DecisionTest, EachTransitionSaysWhyInNumbers) {
  Update({50, 5});
  Update({50, 5}, false);
  Update({50, 5}, true);
  Update({2, 1});
  std::vector<std::string> reasons;
  State from = State::kNormal;
  for (const DecisionTransition& t : dut_.transitions()) {
    EXPECT_EQ(t.from, from);
    from = t.to;
    reasons.push_back(Reason(t, TwoSkills(), t.worst == 0 ? "go_to" : "sweep"));
  }
  EXPECT_EQ(from, dut_.state());
  EXPECT_THAT(
      reasons,
      ElementsAre("the sum rose above Xcrit: 55 > 20", "a sum of 55 is to be assessed, go_to first",
                  "go_to is to be reconfigured, at 50", "go_to could not be reconfigured",
                  "go_to is to be reconfigured, at 50", "go_to was reconfigured",
                  "the sum fell below Ycrit: 3 < 11"));
}

TEST(DecisionParams, ThresholdsOutOfOrderAreRefused) {
  const auto refusal = [](const std::string& yaml) -> std::string {
    const ConfigNode node = ParseYaml(yaml, "m.yaml");
    DecisionParams params;
    try {
      ReadParams(node, "decision.", [&](ParamVisitor& v) { params.Visit(v); });
      params.Check(node, "decision.");
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal("{}"), "taken");
  EXPECT_EQ(refusal("{y_crit: 21}"),
            "m.yaml:1: decision.y_crit = 21: must not be above x_crit, 20");
  EXPECT_EQ(refusal("{y_crit: 15, z_min: 12}"),
            "m.yaml:1: decision.y_crit = 15: must not be above z_min, 12");
  EXPECT_EQ(refusal("{x_crit: 61}"), "m.yaml:1: decision.x_crit = 61: must be below zz_crit, 61");
  EXPECT_EQ(refusal("{z_min: 70}"), "m.yaml:1: decision.z_min = 70: must be below zz_crit, 61");
  EXPECT_EQ(refusal("{z_crit: 70}"),
            "m.yaml:1: decision.z_crit = 70: must not be above zz_crit, 61");
  EXPECT_EQ(refusal("{w: -1}"), "m.yaml:1: decision.w = -1: must be in [0, 1000]");
}

TEST(SupervisionPrimitives, AreThoseOfThePapersList) {
  using P = SupervisionPrimitive;
  EXPECT_THAT(PrimitivesFor(SafetyLevel::kHigh), IsEmpty());
  EXPECT_THAT(PrimitivesFor(SafetyLevel::kMedium), ElementsAre(P::kReconfiguration));
  EXPECT_THAT(PrimitivesFor(SafetyLevel::kWeak), ElementsAre(P::kAdaptation));
  EXPECT_THAT(PrimitivesFor(SafetyLevel::kSerious),
              ElementsAre(P::kAutonomyAdjustment, P::kSafetyWaiting));
  EXPECT_THAT(PrimitivesFor(SafetyLevel::kFatal), ElementsAre(P::kDefinitiveStop));
}

}  // namespace
}  // namespace floorproof
