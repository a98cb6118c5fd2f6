// SPDX-License-Identifier: Apache-2.0
// Every law holds on the true model, and fails on each wrong model that it must notice. Compiled
// twice: the quick laws, and the slow ones.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <iostream>
#include <map>

#include "validate/law.h"

namespace floorproof {
namespace {

// The robot and case that a row is of: all but the last part of its name.
std::string GroupOf(const std::string& row) { return row.substr(0, row.rfind('/')); }

std::string Describe(const WrongModel& wrong) {
  return fmt::format(
      "friction x {}, wheels + {} m, gravity x {}, seams of {} m, battery x {}, resistance x {}, "
      "hotel load x {}, restitution x {}, forks + {} rad",
      wrong.friction_factor, wrong.wheel_radius_add_m, wrong.gravity_factor, wrong.seam_step_m,
      wrong.battery_factor, wrong.resistance_factor, wrong.hotel_load_factor,
      wrong.restitution_factor, wrong.steering_add_rad);
}

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

// Under each wrong model at least one row fails; and of every robot and case at least one row fails
// under one of them. Single rows may feel none, as the drift of a robot whose wheels are all
// larger: they are printed.
TEST_P(LawTest, FailsOnWrongModels) {
  ASSERT_FALSE(dut_->notices().empty()) << "a law that notices nothing proves nothing";
  std::map<std::string, bool> row_fails, group_fails;
  for (const WrongModel& wrong : dut_->notices()) {
    ASSERT_NE(wrong, WrongModel{});
    std::vector<LawRow> rows;
    dut_->Check(wrong, rows);
    EXPECT_FALSE(std::ranges::all_of(rows, &LawRow::ok)) << Describe(wrong);
    for (const LawRow& row : rows) {
      row_fails[row.law] |= !row.ok();
      group_fails[GroupOf(row.law)] |= !row.ok();
    }
  }
  for (const auto& [row, fails] : row_fails)
    if (!fails) std::cout << row << " holds under every wrong model\n";
  for (const auto& [group, fails] : group_fails)
    EXPECT_TRUE(fails) << group << " holds under every wrong model";
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
