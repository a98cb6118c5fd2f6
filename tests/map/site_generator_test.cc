// SPDX-License-Identifier: Apache-2.0
// Random sites: what every one of them keeps, whatever the seed.
#include "env/map/site_generator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/input_file.h"
#include "env/map/site.h"
#include "tests/map/temp_folder.h"
#include "tests/places.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

ConfigNode SiteOf(const std::string& generate, const std::string& more = "") {
  return ParseYaml("site: 1\ngenerate: {" + generate + "}\n" + more, "site.yaml");
}
std::string RowsOf(const ConfigNode& site) { return site.Find("grid")->Find("rows")->scalar; }
std::string Drawn(const std::string& generate, std::uint64_t seed, std::uint64_t episode) {
  return RowsOf(GeneratedSite(SiteOf(generate), seed, episode));
}

// The drawing as one reads it: (x, y) from the top left.
struct Picture {
  explicit Picture(const std::string& text) : chars(text) {
    width = static_cast<int>(text.find('\n'));
    height = static_cast<int>(text.size()) / (width + 1);
  }
  char at(int x, int y) const { return chars[static_cast<std::size_t>(y * (width + 1) + x)]; }
  int Count(char c) const { return static_cast<int>(std::ranges::count(chars, c)); }
  int Driveable() const { return Count('.') + Count('=') + Count('g') + Count('r'); }

  std::string chars;
  int width = 0, height = 0;
};

// How many cells of the kinds `over` can be reached from (x, y) by the cells' sides.
int Reached(const Picture& picture, int x, int y, const std::string& over) {
  std::vector<std::pair<int, int>> wave = {{x, y}};
  std::set<std::pair<int, int>> seen = {{x, y}};
  for (std::size_t i = 0; i < wave.size(); ++i) {
    const auto [cx, cy] = wave[i];
    for (const auto& next : {std::pair{cx + 1, cy}, {cx - 1, cy}, {cx, cy + 1}, {cx, cy - 1}})
      if (over.find(picture.at(next.first, next.second)) != std::string::npos &&
          seen.insert(next).second)
        wave.push_back(next);
  }
  return static_cast<int>(wave.size());
}

std::pair<int, int> CellOf(const HazardMap& map, const Vec2& p_W) {
  const Cell cell = map.frame.ToCell(p_W);
  return {cell.ix, map.frame.height - 1 - cell.iy};
}

// What holds for every generated site. Gives its drawing.
Picture ExpectSound(const ConfigNode& drawn) {
  const Picture dut(RowsOf(drawn));
  SCOPED_TRACE(dut.chars);
  const Site site = ReadSite(drawn, "/nowhere");
  EXPECT_TRUE(site.warnings.empty());
  EXPECT_EQ(site.map.frame.width, dut.width);
  EXPECT_EQ(site.map.frame.height, dut.height);
  for (int x = 0; x < dut.width; ++x)
    EXPECT_TRUE(dut.at(x, 0) == '#' && dut.at(x, dut.height - 1) == '#');
  for (int y = 0; y < dut.height; ++y)
    EXPECT_TRUE(dut.at(0, y) == '#' && dut.at(dut.width - 1, y) == '#');
  EXPECT_TRUE(site.map.start && site.map.goal);
  const auto [sx, sy] = CellOf(site.map, site.map.start->p());
  const auto [gx, gy] = CellOf(site.map, *site.map.goal);
  EXPECT_EQ(dut.at(sx, sy), '.');
  EXPECT_EQ(dut.at(gx, gy), '.');
  // All floor and terrain is one piece: the goal is in it.
  EXPECT_EQ(Reached(dut, sx, sy, ".=gr"), dut.Driveable());
  EXPECT_EQ(std::pair(sx, sy) == std::pair(gx, gy), dut.Count('.') == 1);
  return dut;
}

TEST(SiteGenerator, SameSeedAndEpisodeSameSiteOthersDiffer) {
  for (const SiteKind& kind : SiteKinds()) {
    const std::string generate = std::string("kind: ") + kind.name;
    std::set<std::string> drawings;
    for (std::uint64_t seed = 0; seed < 8; ++seed)
      for (std::uint64_t episode = 0; episode < 8; ++episode) {
        const std::string once = Drawn(generate, seed, episode);
        EXPECT_EQ(Drawn(generate, seed, episode), once);
        drawings.insert(once);
      }
    EXPECT_EQ(drawings.size(), 64u) << kind.name;
  }
}

TEST(SiteGenerator, WithASeedItIsOneSiteThatOfTheCampaignOfThatSeed) {
  const std::string fixed = Drawn("kind: fmea, seed: 7", 1, 0);
  EXPECT_EQ(Drawn("kind: fmea, seed: 7", 2, 5), fixed);
  EXPECT_EQ(Drawn("kind: fmea", 7, 0), fixed);
  EXPECT_NE(Drawn("kind: fmea, seed: 8", 1, 0), fixed);
  const Site read = ReadSite(SiteOf("kind: fmea, seed: 7"), ".");
  const Site drawn = ReadSite(GeneratedSite(SiteOf("kind: fmea"), 7, 0), ".");
  EXPECT_EQ(read.map.occupancy.cells, drawn.map.occupancy.cells);
  EXPECT_EQ(read.map.goal, drawn.map.goal);
}

TEST(SiteGenerator, EverySiteIsOneFloorWithStartAndGoal) {
  for (const SiteKind& kind : SiteKinds())
    for (const char* cells : {"4", "5", "6", "11", "12", "[30, 9]", "[13, 40]"}) {
      const ConfigNode site = SiteOf(std::string("kind: ") + kind.name + ", cells: " + cells);
      SCOPED_TRACE(std::string(kind.name) + " " + cells);
      for (std::uint64_t episode = 0; episode < 120; ++episode)
        ExpectSound(GeneratedSite(site, 6, episode));
    }
}

TEST(SiteGenerator, ASingleCellIsStartAndGoal) {
  for (const char* kind : {"room", "rooms"}) {
    const Picture dut =
        ExpectSound(GeneratedSite(SiteOf(std::string("cells: 3, kind: ") + kind), 1, 0));
    EXPECT_EQ(dut.chars, "###\n#.#\n###\n");
  }
  ExpectSound(GeneratedSite(SiteOf("cells: [3, 4000]"), 1, 0));
}

TEST(SiteGenerator, ALargeCrowdedSiteIsSoundToo) {
  for (const SiteKind& kind : SiteKinds())
    ExpectSound(GeneratedSite(
        SiteOf(std::string("cells: 200, obstacle_density: 0.3, kind: ") + kind.name), 1, 0));
}

// The density counts cells within the walls, to the nearest whole one.
TEST(SiteGenerator, ObstaclesAreExactlyAsDenseAsAsked) {
  for (const SiteKind& kind : SiteKinds())
    for (const double density : {0.0, 0.03, 0.1, 0.25, 0.5})
      for (std::uint64_t episode = 0; episode < 25; ++episode) {
        const std::string generate =
            std::string("cells: [24, 17], kind: ") + kind.name + ", obstacle_density: ";
        const Picture dut =
            ExpectSound(GeneratedSite(SiteOf(generate + FormatDouble(density)), 3, episode));
        const Picture walls(Drawn(generate + "0", 3, episode));
        const int within = 24 * 17 - walls.Count('#');
        EXPECT_EQ(dut.Count('#') - walls.Count('#'), std::lround(density * within));
      }
}

TEST(SiteGenerator, EachHazardAskedForIsThere) {
  const std::string mix =
      "hazards: {glass: 2, drop: 1, raised: [1, 2], rough: 2, cable_cover: 1, groove: 1, mixed: 0}";
  for (const SiteKind& kind : SiteKinds())
    for (std::uint64_t episode = 0; episode < 60; ++episode) {
      const ConfigNode drawn = GeneratedSite(
          SiteOf(std::string("cells: 16, kind: ") + kind.name + ", " + mix), 4, episode);
      SCOPED_TRACE(RowsOf(drawn));
      ExpectSound(drawn);
      int drops = 0, raised = 0;
      std::map<std::string, int> of;
      for (const Hazard& hazard : ReadSite(drawn, ".").map.hazards) {
        ++of[hazard.type];
        if (hazard.type == "step") ++(hazard.height_m < 0 ? drops : raised);
      }
      EXPECT_EQ(of["glass"], 2);
      EXPECT_EQ(of["rough"], 2);
      EXPECT_EQ(of["cable_cover"], 1);
      EXPECT_EQ(of["groove"], 1);
      EXPECT_EQ(drops, 1);
      EXPECT_TRUE(raised == 1 || raised == 2);
    }
}

// Off the strip, what is reached from the start is not all of the floor.
TEST(SiteGenerator, AStripSplitsTheFloor) {
  for (const char* strip : {"cable_cover", "groove"})
    for (std::uint64_t episode = 0; episode < 60; ++episode) {
      const ConfigNode drawn =
          GeneratedSite(SiteOf(std::string("kind: fmea, hazards: {mixed: 0, ") +
                               (strip == std::string("groove") ? "cable_cover" : "groove") +
                               ": 0, " + strip + ": 1}"),
                        5, episode);
      const Picture dut(RowsOf(drawn));
      SCOPED_TRACE(dut.chars);
      const HazardMap map = ReadSite(drawn, ".").map;
      const auto [x, y] = CellOf(map, map.start->p());
      EXPECT_LT(Reached(dut, x, y, "."), dut.Count('.'));
      EXPECT_EQ(Reached(dut, x, y, ".=g"), dut.Driveable());
    }
}

TEST(SiteGenerator, LevelChangesOfKindFmeaLieAtTheBorder) {
  for (std::uint64_t episode = 0; episode < 100; ++episode) {
    const Picture dut(
        Drawn("kind: fmea, hazards: {drop: 2, raised: 1}, cluster_cells: [1, 9]", 5, episode));
    SCOPED_TRACE(dut.chars);
    for (int y = 1; y < dut.height - 1; ++y)
      for (int x = 1; x < dut.width - 1; ++x) {
        if (dut.at(x, y) != 'v' && dut.at(x, y) != '^') continue;
        const int to_border = std::min({x, y, dut.width - 1 - x, dut.height - 1 - y});
        EXPECT_LE(to_border, 3);  // nine cells are at most three deep
      }
  }
}

TEST(SiteGenerator, StartKeepsOffHazardsAndTheGoalIsFar) {
  int across = 0;
  for (std::uint64_t episode = 0; episode < 200; ++episode) {
    const ConfigNode drawn = GeneratedSite(SiteOf("kind: fmea, cells: 13"), 9, episode);
    const Picture dut(RowsOf(drawn));
    SCOPED_TRACE(dut.chars);
    const HazardMap map = ReadSite(drawn, ".").map;
    const auto [x, y] = CellOf(map, map.start->p());
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        EXPECT_THAT(std::string(".#"), HasSubstr(std::string(1, dut.at(x + dx, y + dy))));
    const Vec2 way = *map.goal - map.start->p();
    across += way.lpNorm<1>() >= 4;  // m, of 5 m a side
  }
  EXPECT_GT(across, 180);
}

TEST(SiteGenerator, RoomsAreRoomsWithDoors) {
  for (std::uint64_t episode = 0; episode < 50; ++episode) {
    const Picture dut(Drawn("kind: rooms, obstacle_density: 0", 2, episode));
    SCOPED_TRACE(dut.chars);
    EXPECT_GT(dut.Count('#'), 2 * (30 + 20) - 4 + 20) << "walls within";
    // Walls are one cell thick.
    for (int y = 0; y + 1 < dut.height; ++y)
      for (int x = 0; x + 1 < dut.width; ++x)
        EXPECT_FALSE(dut.at(x, y) == '#' && dut.at(x + 1, y) == '#' && dut.at(x, y + 1) == '#' &&
                     dut.at(x + 1, y + 1) == '#');
  }
}

TEST(SiteGenerator, WhatIsWrittenBesideItStays) {
  const ConfigNode drawn = GeneratedSite(
      SiteOf("cells: 12, inset_m: 0.02, sizes: {drop: {height_m: -0.3}}, hazards: {drop: 1}",
             "name: mine\nstart: {x_m: 1.5, y_m: 1, yaw_deg: 90}\nfloor: {friction: 0.5}\n"
             "hazards:\n- {type: step, height_m: 0.01, polygon_m: [[1, 1], [2, 1], [2, 2]]}\n"),
      1, 0);
  const HazardMap map = ReadSite(drawn, ".").map;
  EXPECT_EQ(map.name, "mine");
  EXPECT_EQ(map.start->x_m, 1.5);
  EXPECT_EQ(map.floor_friction, 0.5);
  EXPECT_EQ(map.inset_m, 0.02);
  ASSERT_EQ(map.hazards.size(), 2u);
  EXPECT_EQ(map.hazards[0].height_m, -0.3);
  EXPECT_EQ(map.hazards[1].id, "step-1");
}

TEST(SiteGenerator, ResolvedItStaysRandomAndMeansTheSame) {
  const std::string more = "hazards:\n- {type: step, polygon_m: [[1, 1], [2, 1], [2, 2]]}\n";
  for (const SiteKind& kind : SiteKinds()) {
    const ConfigNode site = SiteOf(std::string("kind: ") + kind.name, more);
    const std::string text = WriteYaml(ResolveSite(site, ".", "."));
    EXPECT_THAT(text, AllOf(HasSubstr("cluster_cells: "), HasSubstr("door_cells: 2"),
                            HasSubstr("thickness_m: cell"), Not(HasSubstr("rows"))));
    const ConfigNode again = ParseYaml(text, "resolved.yaml");
    EXPECT_EQ(WriteYaml(ResolveSite(again, ".", ".")), text);
    EXPECT_EQ(WriteYaml(ResolveSite(GeneratedSite(again, 3, 4), ".", ".")),
              WriteYaml(ResolveSite(GeneratedSite(site, 3, 4), ".", ".")));
  }
}

TEST(SiteGenerator, ThePageShowsWhatIsDrawn) {
  const std::string page = ReadInputFile(SourceFile("docs/scenario.md"), 1 << 20);
  const std::string line =
      "kind: rooms, cells: [24, 14], hazards: {cable_cover: 1, drop: 1, glass: 1}, seed: 7";
  ASSERT_THAT(page, HasSubstr("generate: {" + line + "}"));
  std::string rows = Drawn(line, 0, 0);
  for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1) rows.insert(at, "    ");
  EXPECT_THAT(page, HasSubstr(rows));
}

TEST(SiteGenerator, ASiteWithoutItStaysAsItIs) {
  const ConfigNode site = ParseYaml("site: 1\ngrid: {rows: \"...\"}\n", "site.yaml");
  EXPECT_EQ(WriteYaml(GeneratedSite(site, 1, 2)), WriteYaml(site));
}

class BrokenGenerateTest : public TempFolder {};

TEST_F(BrokenGenerateTest, IsRefusedInALine) {
  struct Broken {
    const char* generate;
    const char* expected;
  };
  const std::vector<Broken> table = {
      {"kind: romm, seed: 1",
       "site.yaml:2: generate.kind = romm: must be one of room, rooms, fmea, crossing; did you "
       "mean room?"},
      {"kind: room", "site.yaml:2: generate.seed: missing"},
      {"seed: -1", "generate.seed = -1: must be in [0, 2147483647]"},
      {"seed: 1.5", "generate.seed = 1.5: must be a whole number"},
      {"seed: 1, cells: 2",
       "site.yaml:2: generate.cells = 2: must be at least 3: the outer wall is counted, and one "
       "cell of floor lies within it"},
      {"seed: 1, cells: 1", "site.yaml:2: generate.cells = 1: must be at least 3: the outer wall"},
      {"seed: 1, cells: -7",
       "site.yaml:2: generate.cells = -7: must be at least 3: the outer wall"},
      {"seed: 1, cells: [1, 30]",
       "site.yaml:2: generate.cells[0] = 1: must be at least 3: the outer wall"},
      {"seed: 1, cells: [30, 0]",
       "site.yaml:2: generate.cells[1] = 0: must be at least 3: the outer wall"},
      {"seed: 1, cells: [10, 4001]", "generate.cells[1] = 4001: must be at most 4000"},
      {"seed: 1, cells: [4000, 4000], cell_m: 0.05", "must be at most 4000000 cells in all"},
      {"seed: 1, cells: [4000, 400]", "generate.cells"},  // 2 km
      {"seed: 1, cells: [10]", "generate.cells: must be [width, height], or one number"},
      {"seed: 1, cells: {w: 3}", "generate.cells = {...}: must be a whole number"},
      {"seed: 1, cell_m: 0", "generate.cell_m = 0: must be in [0.01, 100]"},
      {"seed: 1, inset_m: 0.3", "generate.inset_m = 0.3: must be less than half of cell_m"},
      {"seed: 1, obstacle_density: 0.6", "generate.obstacle_density = 0.6: must be in [0, 0.5]"},
      {"seed: 1, obstacle_density: nan", "generate.obstacle_density = nan: must be a finite"},
      {"seed: 1, obstacle_densty: 0.1", "did you mean obstacle_density?"},
      {"seed: 1, cluster_cells: [4, 2]", "generate.cluster_cells[1] = 2: must be at least"},
      {"seed: 1, cluster_cells: 0", "generate.cluster_cells = 0: must be in [1, 10000]"},
      {"seed: 1, cluster_cells: [1, 2, 3]", "must be a whole number or a range [least, most]"},
      {"seed: 1, hazards: [glass]", "generate.hazards: must be a map of types to counts"},
      {"seed: 1, hazards: {glas: 1}", "generate.hazards.glas: unknown key; did you mean glass?"},
      {"seed: 1, hazards: {glass: -1}", "generate.hazards.glass = -1: must be in [0, 1000]"},
      {"seed: 1, hazards: {glass: many}", "generate.hazards.glass = many: must be a whole number"},
      {"seed: 1, sizes: {drop: {height_m: 1}}", "generate.sizes.drop.height_m = 1: must be < 0"},
      {"seed: 1, sizes: {dorp: {height_m: 1}}", "generate.sizes.dorp: unknown key; did you mean"},
      {"seed: 1, kind: rooms, room_cells: 1", "generate.room_cells = 1: must be in [2, 4000]"},
      {"seed: 1, kind: rooms, door_cells: 0", "generate.door_cells = 0: must be in [1, 4000]"},
      {"seed: 1, cells: 3, obstacle_density: 0.5",
       "site.yaml:2: generate.obstacle_density = 0.5: no room for so much on 3 x 3 cells"},
      {"seed: 1, cells: 12, hazards: {cable_cover: 9}",
       "generate.hazards.cable_cover = 9: no room for so much on 12 x 12 cells"},
      {"seed: 1, cells: 6, cluster_cells: 30, hazards: {drop: 1}", "generate.hazards.drop = 1: no"},
  };
  for (const Broken& b : table) {
    const auto read = [&] { ReadSite(SiteOf(b.generate), "/nowhere"); };
    EXPECT_THAT(Refusal(read), HasSubstr(b.expected)) << b.generate;
  }
  const auto draw = [&](const char* text) {
    return Refusal([&] { GeneratedSite(ParseYaml(text, "site.yaml"), 1, 0); });
  };
  EXPECT_THAT(draw("site: 1\ngenerate: room\n"), HasSubstr("generate = room: must be a map"));
  EXPECT_THAT(draw("site: 1\ngrid: {rows: \"..\"}\ngenerate: {kind: room}\n"),
              HasSubstr("site.yaml:3: map, grid or generate: a site has one of the three"));
  EXPECT_THAT(draw("site: 1\ngenerate: {cells: 6, hazards: {drop: [17, 20]}}\n"),
              HasSubstr("generate.hazards.drop: no room"));
}

}  // namespace
}  // namespace floorproof
