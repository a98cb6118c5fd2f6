// SPDX-License-Identifier: Apache-2.0
#include "env/audit/gathering.h"

#include <gtest/gtest.h>

#include "env/audit/audit_sample.h"
#include "env/audit/brush.h"
#include "tests/audit/audit_floors.h"

namespace floorproof {
namespace {

TEST(Gathering, ASampleIsDirtyAboveTheThreshold) {
  const std::vector<int> counts = {0, 9, 10, 11, 60};
  const Gathering dut = Gather(counts);
  EXPECT_EQ(dut.dirty, 2);
  EXPECT_EQ(dut.clean, 3);
  EXPECT_DOUBLE_EQ(*dut.Efficiency(), 0.4);
  EXPECT_EQ(Gather(counts, 9).dirty, 3);
}

// Tables 1 and 2 of the audit paper.
TEST(Gathering, GivesThePapersEfficiencies) {
  EXPECT_NEAR(*(Gathering{22, 29}.Efficiency()), 0.43, 0.005);
  EXPECT_NEAR(*(Gathering{47, 4}.Efficiency()), 0.92, 0.005);
  EXPECT_NEAR(*(Gathering{29, 24}.Efficiency()), 0.54, 0.01);
  EXPECT_NEAR(*(Gathering{44, 15}.Efficiency()), 0.74, 0.01);
}

TEST(Gathering, OfNoSampleThereIsNone) { EXPECT_FALSE(Gather({}).Efficiency()); }

// A room as in section 6.1, cleaned five rounds back and forth.
class CleanedRoom : public ::testing::Test {
 protected:
  static DirtField Cleaned(const CleaningParams& params) {
    constexpr double kSide_m = 4.5, kRobot_m = 0.165;
    DirtField field = LayDirt(testing::BareRoom(kSide_m, kSide_m), {}, 1);
    Shape2 tool;
    tool.radius_m = 0.1;
    Stream random(1, 0, "cleaning");
    for (int round = 0; round < 5; ++round)
      CleanAlong(field, tool, testing::ZigZag(kSide_m, kSide_m, kRobot_m, 0.17), params, random);
    return field;
  }
  // What is read from tapes at these places, through the microscope.
  static Gathering Sampled(DirtField field, const std::vector<Vec2>& places) {
    Stream lift(1, 0, "lift");
    std::vector<int> counts;
    for (const Vec2& p : places)
      counts.push_back(TakeSample(field, {p.x(), p.y(), 0}, {}, lift, counts.size()).counted.count);
    return Gather(counts);
  }
  static std::vector<Vec2> Grid7() {
    std::vector<Vec2> places;
    for (int i = 0; i < 49; ++i) places.push_back(Vec2(i % 7 + 0.5, i / 7 + 0.5) * (4.5 / 7));
    return places;
  }
  static std::vector<Vec2> AtWalls(double from_wall_m) {
    std::vector<Vec2> places;
    for (int i = 0; i < 12; ++i) {
      const double along = 0.3 + 0.35 * i;
      places.insert(places.end(), {Vec2(along, from_wall_m), Vec2(along, 4.5 - from_wall_m),
                                   Vec2(from_wall_m, along), Vec2(4.5 - from_wall_m, along)});
    }
    return places;
  }
};

TEST_F(CleanedRoom, AnEvenGridsSamplesAreAboutAsDirtyAsThePapers) {
  const DirtField field = Cleaned({});
  // The paper's two trials: 0.43 and 0.54. Of 49 samples the chance alone makes 0.07.
  EXPECT_NEAR(*Sampled(field, Grid7()).Efficiency(), 0.45, 0.15);
  // Where the tool does not reach there is more than anywhere else.
  EXPECT_GT(*Sampled(field, AtWalls(0.03)).Efficiency(), 0.92);
}

TEST_F(CleanedRoom, PushingGathersDirtAtWallsWhichTakingUpAloneDoesNot) {
  const auto beside_wall = [](const DirtField& field) {
    int count = 0;
    for (const Particle& p : field.All()) count += p.p_W.y() < 0.05;
    return count / (0.05 * 4.5);
  };
  EXPECT_NEAR(beside_wall(Cleaned({.pick_up = 0.2, .push_aside = 0})), 80'000, 2'000);
  EXPECT_GT(beside_wall(Cleaned({.pick_up = 0.2, .push_aside = 0.3})), 1.2 * 80'000);
}

}  // namespace
}  // namespace floorproof
