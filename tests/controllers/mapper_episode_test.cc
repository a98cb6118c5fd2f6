// SPDX-License-Identifier: Apache-2.0
// A driven robot's map holds what its sensors said, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

class MapperEpisode : public ScenarioTest {
 protected:
  MapperEpisode() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n3,2.5\n3,3.3\n"); }

  EpisodeRecord With(const std::string& hazards, const std::string& lidar = "") {
    const EpisodeRecord record =
        Drive(Read(RoomScenario(hazards, "mapper: {}\nsensors: {lidar: {" + lidar + "}}\n")));
    EXPECT_EQ(record.outcome, Outcome::kSuccess) << record.message;
    EXPECT_TRUE(record.known);
    return record;
  }
  static bool Same(const EpisodeRecord& a, const EpisodeRecord& b) {
    return a.known->log_odds.cells == b.known->log_odds.cells &&
           a.known->marked.cells == b.known->marked.cells;
  }
};

constexpr const char* kCrate =
    "{type: blind_object, height_m: 1, polygon_m: [[6, 1], [7, 1], [7, 2], [6, 2]]";

// The site's map says of a crate that it is there, or says nothing: the floor is the same, and what
// the robot knows of it is too, cell for cell.
TEST_F(MapperEpisode, TheSitesMapIsNotCopied) {
  const EpisodeRecord told = With(std::string(kCrate) + "}");
  const EpisodeRecord untold = With(std::string(kCrate) + ", known: false}");
  EXPECT_TRUE(Same(told, untold));
  EXPECT_FALSE(Same(told, With(""))) << "it was in sight";
}

// Planted in the map where no beam reaches: nothing is known of it, nor changes.
TEST_F(MapperEpisode, WhatWasNotSensedIsNotKnown) {
  const std::string near = "range_m: 2.5";
  const EpisodeRecord bare = With("", near), planted = With(std::string(kCrate) + "}", near);
  EXPECT_TRUE(Same(bare, planted));
  const KnownMap& known = *planted.known;
  const Cell crate = known.frame.ToCell({6.5, 1.5});
  EXPECT_EQ(known.log_odds(crate), 0);
  EXPECT_FALSE(Same(bare, With(std::string(kCrate) + "}", "range_m: 8")));
}

// A bare room is known for the most part and hardly wrong. A pane across it is not seen: what lies
// behind is, and the pane itself is taken for free.
TEST_F(MapperEpisode, GlassIsWhatItGetsWrong) {
  const std::string pane = "{type: glass, line_m: [[4.2, 0.5], [5, 4.5]]}";
  const auto compare = [&](const std::string& hazards) {
    const EpisodeRecord record = With(hazards);
    return Compare(*record.known, Read(RoomScenario(hazards)).world.site.map, 0.01, 0.1);
  };
  const auto wrongly_free = [](const KnownAgainstTruth& seen) {
    return std::ranges::count(seen.cells.cells, KnownAgainstTruth::kWronglyFree);
  };
  const KnownAgainstTruth bare = compare(""), glass = compare(pane);
  EXPECT_GT(bare.known, 0.9);
  EXPECT_LT(bare.wrong, 0.005);
  EXPECT_GT(glass.known, 0.9);
  EXPECT_LT(wrongly_free(bare), 5);
  EXPECT_GT(wrongly_free(glass), 60) << "4 m in cells of 5 cm";
}

}  // namespace
}  // namespace floorproof
