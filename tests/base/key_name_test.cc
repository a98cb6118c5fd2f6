// SPDX-License-Identifier: Apache-2.0
#include "base/key_name.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

TEST(KeyName, SaysWhatAndInWhichUnit) {
  const auto text = [](const char* path) {
    const KeyName key = NameOfKey(path);
    return key.name + " [" + key.unit + "]";
  };
  EXPECT_EQ(text("site.generate.sizes.step.height_m"), "step height [m]");
  EXPECT_EQ(text("site.hazards.0.height_m"), "hazard 0 height [m]");
  EXPECT_EQ(text("site.hazards.plank.height_m"), "plank height [m]");
  EXPECT_EQ(text("site.floor.friction"), "floor friction []");
  EXPECT_EQ(text("plan.speed_mps"), "plan speed [m/s]");
  EXPECT_EQ(text("start.yaw_deg"), "start yaw [°]");
  EXPECT_EQ(text("faults.12.onset_s"), "fault 12 onset [s]");
  EXPECT_EQ(text("friction"), "friction []");
  EXPECT_EQ(text("_m"), " m []") << "no more than a suffix";
  EXPECT_EQ(text(""), " []");
  EXPECT_EQ(text("a..b"), " b []");
}

TEST(KeyName, MetresBelowOneAreMillimetres) {
  EXPECT_EQ(ScaleOf({"", "m"}, 0.5).unit, "mm");
  EXPECT_EQ(ScaleOf({"", "m"}, -0.5).per, 1000);
  EXPECT_EQ(ScaleOf({"", "m"}, 2).unit, "m");
  EXPECT_EQ(ScaleOf({"", "s"}, 0.5).per, 1);
}

}  // namespace
}  // namespace floorproof
