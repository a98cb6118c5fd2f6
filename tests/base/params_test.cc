// SPDX-License-Identifier: Apache-2.0
#include "base/params.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floorproof {
namespace {

using ::testing::HasSubstr;

struct Dut : Configurable {
  double speed = 0.5;
  int count = 3;
  bool fast = false;
  std::string kind = "a";
  std::optional<double> width;
  double inner = 1;
  void Visit(ParamVisitor& v) override {
    v("speed_mps", speed, Positive(), "speed");
    v("count", count, Between(1, 10), "how many");
    v("fast", fast, "hurry");
    v("kind", kind, {"a", "bee"}, "which");
    v("width_m", width, Positive(), "none: the robot's");
    v.Group(
        "group", [this](ParamVisitor& g) { g("inner", inner, Any(), "inside"); }, "a group");
  }
};

std::string Refusal(const std::string& text) {
  Dut dut;
  try {
    ReadParams(ParseYaml(text, "a.yaml"), "plan.", dut);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Params, DefaultsStayWhereNothingIsWritten) {
  Dut dut;
  ReadParams(ParseYaml("count: 7\ngroup: {inner: -2}\n", "a.yaml"), "", dut);
  EXPECT_EQ(dut.count, 7);
  EXPECT_EQ(dut.speed, 0.5);
  EXPECT_EQ(dut.inner, -2);
  EXPECT_FALSE(dut.width.has_value());
}

TEST(Params, ARefusalNamesFileLineKeyValueAndRule) {
  EXPECT_EQ(Refusal("fast: true\nspeed_mps: -1\n"), "a.yaml:2: plan.speed_mps = -1: must be > 0");
  EXPECT_EQ(Refusal("count: 11"), "a.yaml:1: plan.count = 11: must be in [1, 10]");
  EXPECT_THAT(Refusal("count: 2.5"), HasSubstr("must be a whole number"));
  EXPECT_THAT(Refusal("count: 99999999999999999999"), HasSubstr("must be a whole number"));
  EXPECT_THAT(Refusal("speed_mps: .nan"), HasSubstr("must be a"));
  EXPECT_THAT(Refusal("speed_mps: inf"), HasSubstr("must be a finite number"));
  EXPECT_THAT(Refusal("speed_mps: 'fast'"), HasSubstr("must be a number"));
  EXPECT_THAT(Refusal("speed_mps: [1]"), HasSubstr("must be a number"));
  EXPECT_THAT(Refusal("width_m: null"), HasSubstr("must be a number, or none"));
  EXPECT_THAT(Refusal("width_m: nothing"), HasSubstr("must be a number, or none"));
  EXPECT_THAT(Refusal("width_m: 0"), HasSubstr("must be > 0, or none"));
  EXPECT_THAT(Refusal("fast: maybe"), HasSubstr("must be true or false"));
  EXPECT_THAT(Refusal("kind: be"), HasSubstr("did you mean bee?"));
  EXPECT_THAT(Refusal("sped_mps: 1"),
              HasSubstr("plan.sped_mps: unknown key; did you mean speed_mps?"));
  EXPECT_THAT(Refusal("group: {iner: 1}"),
              HasSubstr("plan.group.iner: unknown key; did you mean inner?"));
  EXPECT_THAT(Refusal("[1, 2]"), HasSubstr("must be a map"));
}

TEST(Params, WrittenParametersReadBackTheSame) {
  Dut a, b;
  a.speed = 0.1 + 0.2;
  a.width = 1.0 / 3;
  ConfigNode node;
  WriteParams(a, node);
  ReadParams(ParseYaml(WriteYaml(node), "a.yaml"), "", b);
  EXPECT_EQ(b.speed, a.speed);
  EXPECT_EQ(b.width, a.width);
  a.width.reset();
  WriteParams(a, node);
  ReadParams(ParseYaml(WriteYaml(node), "a.yaml"), "", b);
  EXPECT_FALSE(b.width.has_value());
}

TEST(Params, AsDataTheyMakeTheSameAgain) {
  Dut dut;
  dut.speed = 0.1 + 0.2;
  dut.count = 7;
  dut.fast = true;
  dut.kind = "bee";
  dut.width = 0.25;
  dut.inner = -1e-300;
  const ParamValues values = ValuesOf(dut);
  Dut again;
  EXPECT_NE(ValuesOf(again), values);
  SetValues(values, again);
  EXPECT_EQ(ValuesOf(again), values);
  EXPECT_EQ(WriteYaml(WithValues(ConfigNode::Map(), values)),
            "speed_mps: 0.30000000000000004\ncount: 7\nfast: true\nkind: \"bee\"\nwidth_m: 0.25\n"
            "group:\n  inner: -1e-300\n");
  // One that is not given, or is of another type, stays as it is.
  SetValues({{"count", 2.5}, {"group.inner", 3.0}}, again);
  EXPECT_EQ(again.count, 7);
  EXPECT_EQ(again.inner, 3);
}

TEST(Params, AGroupWithoutParametersIsWritten) {
  const ParamValues values = ValuesOf([](ParamVisitor& v) {
    v.Group(
        "plain", [](ParamVisitor&) {}, "one of several orders");
  });
  EXPECT_EQ(WriteYaml(WithValues(ConfigNode::Map(), values)), "plain:\n  {}\n");
}

TEST(Params, EachParameterIsDocumented) {
  Dut dut;
  const auto docs = DocumentParams(dut);
  ASSERT_EQ(docs.size(), 6u);
  EXPECT_EQ(docs[0].name, "speed_mps");
  EXPECT_EQ(docs[0].default_text, "0.5");
  EXPECT_EQ(docs[0].rule, "must be > 0");
  EXPECT_EQ(docs[4].rule, "must be > 0, or none");
  EXPECT_EQ(docs[5].name, "group.inner");
}

}  // namespace
}  // namespace floorproof
