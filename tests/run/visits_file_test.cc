// SPDX-License-Identifier: Apache-2.0
#include "run/episode/visits_file.h"

#include <gtest/gtest.h>

namespace floorproof {
namespace {

EpisodeRecord Swept() {
  EpisodeRecord record;
  record.passes_frame = {3, 2, 0.1, {-1.25, 1.0 / 3, 0.7}};
  record.passes = Grid<std::uint8_t>(3, 2);
  record.passes.cells = {0, 1, 2, 3, 255, 7};
  record.sweepable = Grid<std::uint8_t>(3, 2, 1);
  record.sweepable(2, 1) = 0;
  return record;
}

TEST(VisitsFile, IsReadAsItWasWritten) {
  const EpisodeRecord record = Swept();
  const std::optional<Visits> dut = ReadVisits(VisitsPgm(record));
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->frame.width, 3);
  EXPECT_EQ(dut->frame.cell_m, 0.1);
  EXPECT_EQ(dut->frame.X_WG.x_m, -1.25);
  EXPECT_EQ(dut->frame.X_WG.y_m, 1.0 / 3);
  EXPECT_EQ(dut->frame.X_WG.yaw_rad, 0.7);
  EXPECT_EQ(dut->passes(0, 0), 0);
  EXPECT_EQ(dut->passes(2, 0), 2);
  EXPECT_EQ(dut->passes(1, 1), 254) << "more passes than the picture can tell";
  EXPECT_EQ(dut->passes(2, 1), Visits::kOutOfReach);
}

TEST(VisitsFile, IsAPictureWithItsTopRowFirst) {
  const std::string pgm = VisitsPgm(Swept());
  EXPECT_TRUE(pgm.starts_with("P5\n#"));
  EXPECT_EQ(pgm.substr(pgm.size() - 6), std::string("\x03\xfe\xff\0\x01\x02", 6));
  EXPECT_EQ(pgm.substr(pgm.size() - 14, 8), "3 2\n255\n");
}

TEST(VisitsFile, WhatIsNotWholeIsNotRead) {
  const std::string pgm = VisitsPgm(Swept());
  EXPECT_FALSE(ReadVisits(""));
  EXPECT_FALSE(ReadVisits("P5\n3 2\n255\n123456"));
  for (std::size_t n = 0; n < pgm.size(); ++n) EXPECT_FALSE(ReadVisits(pgm.substr(0, n))) << n;
  EXPECT_FALSE(ReadVisits(pgm + "x"));
  for (const char* value : {"nan", "inf", "-0.1"}) {
    std::string lies = pgm;
    lies.replace(lies.find("cell_m ") + 7, lies.find(" x_m") - lies.find("cell_m ") - 7, value);
    EXPECT_FALSE(ReadVisits(lies)) << value;
  }
  std::string large = pgm;
  large.replace(large.find("\n3 2\n"), 5, "\n65536 65536\n");
  EXPECT_FALSE(ReadVisits(large)) << "a size that is not that of its cells";
}

}  // namespace
}  // namespace floorproof
