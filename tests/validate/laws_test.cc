// SPDX-License-Identifier: Apache-2.0
// Every law holds on the true model, and fails on each wrong model that it must notice. Compiled
// twice: the quick laws, and the slow ones.
#include <gmock/gmock.h>

#include "env/validate/law.h"

namespace floorproof {
namespace {

class LawTest : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Law> dut_ = MakePlugin(Laws(), GetParam(), "law");
};

std::vector<std::string> TheseLaws() {
  std::vector<std::string> names;
  for (const auto& entry : Laws())
    if (entry.make()->slow() == FP_SLOW_LAWS) names.emplace_back(entry.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Laws, LawTest, ::testing::ValuesIn(TheseLaws()),
                         [](const auto& law) { return law.param; });

TEST_P(LawTest, HoldsOnTheTrueModel) {
  std::vector<LawRow> rows;
  dut_->Check({}, rows);
  ASSERT_FALSE(rows.empty());
  for (const LawRow& row : rows) {
    EXPECT_TRUE(row.ok()) << row.law << ": expected " << row.expected << ", measured "
                          << row.measured << ", tolerance " << row.tolerance << " " << row.unit;
    EXPECT_TRUE(row.law.starts_with(GetParam() + "/")) << row.law;
  }
}

TEST_P(LawTest, FailsOnWrongModels) {
  ASSERT_FALSE(dut_->notices().empty()) << "a law that notices nothing proves nothing";
  for (const WrongModel& wrong : dut_->notices()) {
    ASSERT_NE(wrong, WrongModel{});
    std::vector<LawRow> rows;
    dut_->Check(wrong, rows);
    EXPECT_FALSE(std::ranges::all_of(rows, &LawRow::ok))
        << "friction x " << wrong.friction_factor << ", wheels + " << wrong.wheel_radius_add_m
        << " m, gravity x " << wrong.gravity_factor << ", seams of " << wrong.seam_step_m
        << " m, battery x " << wrong.battery_factor << ", restitution x "
        << wrong.restitution_factor;
  }
}

TEST(ValidateCsv, HasARowAComparison) {
  const LawResult result{"a",
                         "a = b",
                         {{
                              "a/x",
                              1,
                              1.05,
                              0.1,
                              "m",
                          },
                          {"a/y", 1, 2, 0.5, "s"}}};
  EXPECT_EQ(ValidateCsv(std::vector{result}),
            "law,expected,measured,tolerance,unit,ok\na/x,1,1.05,0.1,m,1\na/y,1,2,0.5,s,0\n");
}

}  // namespace
}  // namespace floorproof
