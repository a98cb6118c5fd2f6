// SPDX-License-Identifier: Apache-2.0
// The suite where a robot passes a size and not an easier one.
#include <gtest/gtest.h>

#include <algorithm>

#include "validate/suite/robot_suite.h"

namespace floorproof {
namespace {

const PluginEntry<Method>& Listed(std::string_view method) {
  return *std::ranges::find(Methods(), method, &PluginEntry<Method>::name);
}

// The listed method on a ladder of two rungs, 1 and 80 mm: its climb steps over what lies between.
class CoarseSill final : public Method {
 public:
  std::string_view shaped_after() const override { return ""; }
  std::string_view task() const override { return ""; }
  std::optional<SizeLadder> sizes(const RobotModel&) const override {
    return SizeLadder{"height", "mm", {.per_unit = 1, .first = 1, .spacing = 79, .last = 80}};
  }
  MethodDrive LayOut(const MethodRun& run) const override { return sill_->LayOut(run); }
  MethodVerdict Judge(const MethodRun& run, const EpisodeRecord& record) const override {
    return sill_->Judge(run, record);
  }

 private:
  std::unique_ptr<Method> sill_ = Listed("sill").make();
};

// hTetro drives over a sill of 80 mm as over a hill. One of 26 to 40 mm lies between two of its
// rows of wheels, and its belly hangs on it.
TEST(SlowSuite, HtetroHangsOnLowerSillsThanItDrivesOver) {
  const RobotModel htetro = ReadRobot(FindRobotFile("htetro", {}));
  const SuiteOptions options{.reliability = 0.7, .confidence = 0.9, .jobs = 2};
  const PluginEntry<Method> coarse{
      "sill", "", [] { return std::unique_ptr<Method>(std::make_unique<CoarseSill>()); }};
  const MethodResult dut = *RunMethod(coarse, htetro, "htetro", options, {});
  EXPECT_EQ(dut.withdrawn, 80);
  const MethodResult fine = *RunMethod(Listed("sill"), htetro, "htetro", options, {});
  ASSERT_TRUE(FailsAt(dut).has_value());
  EXPECT_GE(*FailsAt(dut), 26);
  EXPECT_LE(*FailsAt(dut), 40);
  ASSERT_TRUE(dut.size && fine.size);
  EXPECT_NEAR(*dut.size, *fine.size, 3) << "what a ladder finds that steps over nothing";
}

}  // namespace
}  // namespace floorproof
