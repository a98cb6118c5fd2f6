// SPDX-License-Identifier: Apache-2.0
// Sites: what a file says is what the map holds, and a resolved file says the same again.
#include "env/map/site.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/params.h"
#include "base/quantity.h"
#include "tests/map/temp_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kDesignsExample = R"(site: 1
name: staircase hall
grid:
  cell_m: 0.5
  inset_m: 0.03
  rows: |
    #########
    #...=...#
    #.G.=.v.#
    #########
unknown: wall
floor: {friction: 0.8}
hazards:
  - {type: glass, id: door, line_m: [[1.0, 2.0], [3.0, 2.0]], height_m: 2.0, thickness_m: 0.010, restitution: 0.3}
  - {type: step, polygon_m: [[1, 1], [2, 1], [1, 2]], height_m: 0.015}
  - {type: groove, line_m: [[1, 1], [2, 1]], width_m: 0.020, depth_m: 0.010}
  - {type: cable_cover, line_m: [[1, 1], [2, 1], [2, 1.5]], width_m: 0.13, top_width_m: 0.05, height_m: 0.020}
  - {type: blind_object, polygon_m: [[1, 1], [2, 1], [1, 2]], height_m: 0.5}
  - {type: rough, polygon_m: [[1, 1], [2, 1], [1, 2]], amplitude_m: 0.003, wavelength_m: 0.05, friction: 0.6}
)";

class SiteTest : public TempFolder {
 protected:
  static Site Read(const std::string& text) { return ReadSite(ParseYaml(text, "site.yaml"), "."); }
  static std::string Rows(const std::string& more) {
    return "site: 1\ngrid:\n  cell_m: 1\n  rows: |\n    ......\n    ......\n    ......\n" + more;
  }
  void SaveMap() const {
    Save("map.pgm", "P2 3 2 255\n0 254 254\n254 254 205\n");
    Save("map.yaml",
         "image: map.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n"
         "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }
  static std::vector<std::string> Ids(const HazardMap& map) {
    std::vector<std::string> ids;
    for (const Hazard& h : map.hazards) ids.push_back(h.id);
    return ids;
  }
  static double Area(const Hazard& hazard) {
    double area = 0;
    for (const Solid& s : hazard.solids) area += SignedArea(s.base);
    return area;
  }
};

TEST_F(SiteTest, TheDesignsExampleReads) {
  const Site dut = Read(kDesignsExample);
  EXPECT_EQ(dut.map.name, "staircase hall");
  EXPECT_EQ(dut.map.frame.width, 9);
  EXPECT_EQ(dut.map.frame.height, 4);
  EXPECT_DOUBLE_EQ(dut.map.inset_m, 0.03);
  // Characters first, in reading order; then the list.
  EXPECT_THAT(Ids(dut.map), ElementsAre("cable_cover-0", "glass-0", "step-0", "door", "step-1",
                                        "groove-0", "cable_cover-1", "blind_object-0", "rough-0"));
  EXPECT_EQ(dut.map.hazards.back().material.friction, 0.6);
  EXPECT_DOUBLE_EQ(dut.map.hazards[3].material.restitution, 0.3);
  EXPECT_THAT(dut.warnings, ElementsAre(HasSubstr("groove-0 lies across the edge"),
                                        HasSubstr("cable_cover-1 lies across the edge")));
}

TEST_F(SiteTest, DefaultsAreTheDesigns) {
  const Site dut = Read("site: 1\ngrid: {rows: \"...\"}\n");
  EXPECT_DOUBLE_EQ(dut.map.inset_m, 0.03);
  EXPECT_DOUBLE_EQ(dut.map.floor_friction, 0.8);
  EXPECT_TRUE(dut.map.unknown_is_wall);
  EXPECT_EQ(dut.map.name, "site");
  EXPECT_FALSE(dut.map.start.has_value());
}

TEST_F(SiteTest, ARosMapKeepsItsOriginAndHasNoInset) {
  SaveMap();
  const Site dut = ReadSiteFile(
      Save("hall.yaml",
           "site: 1\nmap: map.yaml\nunknown: free\nstart: {x_m: 0, y_m: 2.2, yaw_deg: 90}\n"
           "goal: {x_m: 0.4, y_m: 2.9}\nhazards:\n- {type: step, polygon_m: [[-1, 2], [0, 2], [0, "
           "3]]}\n"));
  EXPECT_EQ(dut.map.name, "hall");
  EXPECT_DOUBLE_EQ(dut.map.inset_m, 0);
  EXPECT_TRUE(dut.map.IsWall(0, 1));
  EXPECT_FALSE(dut.map.IsWall(2, 0));  // unknown
  EXPECT_TRUE(dut.map.IsWall(3, 0));   // beyond the map
  EXPECT_DOUBLE_EQ(dut.map.start->yaw_rad, kPi / 2);
  EXPECT_EQ(*dut.map.goal, Vec2(0.4, 2.9));
  EXPECT_THAT(dut.files_read,
              ElementsAre(folder_ / "hall.yaml", folder_ / "map.yaml", folder_ / "map.pgm"));
}

TEST_F(SiteTest, UnknownHazardsAreNotInTheKnownPart) {
  const Site dut = Read(
      Rows("hazards:\n"
           "- {type: step, polygon_m: [[1, 1], [2, 1], [2, 2]], height_m: 0.04, known: false}\n"
           "- {type: step, polygon_m: [[3, 1], [4, 1], [4, 2]], height_m: 0.04}\n"));
  EXPECT_THAT(Ids(KnownPart(dut.map)), ElementsAre("step-1"));
}

TEST_F(SiteTest, WrittenIdsComeFirstAndDefaultsPassThemOver) {
  const Site dut =
      Read(Rows("hazards:\n"
                "- {type: step, polygon_m: [[1, 1], [2, 1], [2, 2]]}\n"
                "- {type: step, id: step-0, polygon_m: [[3, 1], [4, 1], [4, 2]]}\n"));
  EXPECT_THAT(Ids(dut.map), ElementsAre("step-1", "step-0"));
}

//   +-------+      a 3 x 3 platform with a pit of 1 x 1 in its middle, written after it:
//   |  +-+  |      the platform keeps 8 m^2 of solid, the pit's floor lies open,
//   |  +-+  |      and a planner that does not know the pit sees a whole platform
//   +-------+
TEST_F(SiteTest, TheLaterLevelWinsAndFootprintsStayWhole) {
  const std::string platform =
      "- {type: step, id: platform, polygon_m: [[1, 0], [4, 0], [4, 3], [1, 3]], height_m: 0.1}\n";
  const std::string pit =
      "- {type: step, id: pit, polygon_m: [[2, 1], [3, 1], [3, 2], [2, 2]], height_m: -0.2, "
      "known: false}\n";
  const Site dut = Read(Rows("hazards:\n" + platform + pit));
  EXPECT_NEAR(Area(dut.map.hazards[0]), 8, 1e-9);
  EXPECT_NEAR(Area(dut.map.hazards[1]), 1, 1e-9);
  EXPECT_NEAR(SignedArea(dut.map.hazards[0].footprint.at(0)), 9, 1e-9);
  for (const Solid& s : dut.map.hazards[0].solids) {
    EXPECT_TRUE(IsConvex(s.base));
    EXPECT_FALSE(Contains(s.base, {2.5, 1.5}));
  }
  // The other way round the platform buries the pit.
  const Site buried = Read(Rows("hazards:\n" + pit + platform));
  EXPECT_THAT(buried.map.hazards[0].solids, IsEmpty());
  EXPECT_NEAR(Area(buried.map.hazards[1]), 9, 1e-9);
}

TEST_F(SiteTest, APitWithAnIslandIsCutAroundIt) {
  const Site dut =
      Read(Rows("hazards:\n"
                "- {type: step, polygon_m: [[1, 0], [4, 0], [4, 3], [1, 3]], height_m: -0.2}\n"
                "- {type: step, polygon_m: [[2, 1], [3, 1], [3, 2], [2, 2]], height_m: 0.05}\n"));
  EXPECT_NEAR(Area(dut.map.hazards[0]), 8, 1e-9);
  for (const Solid& s : dut.map.hazards[0].solids) EXPECT_EQ(s.kind, Solid::Kind::kCut);
}

TEST_F(SiteTest, PolygonsMayGoEitherWayRoundAndBeClosed) {
  const Site dut =
      Read(Rows("hazards:\n"
                "- {type: blind_object, polygon_m: [[1, 1], [1, 2], [2, 2], [2, 1]]}\n"
                "- {type: blind_object, polygon_m: [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]}\n"));
  for (const Hazard& h : dut.map.hazards) {
    EXPECT_THAT(h.footprint.at(0), SizeIs(4));
    EXPECT_DOUBLE_EQ(SignedArea(h.footprint.at(0)), 1);
  }
}

// A cover on a platform lies on it, one across its edge is told of; a groove is cut into the
// platform, whichever of them is written first.
TEST_F(SiteTest, CoversAndGroovesGoByTheFloorBeneath) {
  const std::string platform =
      "- {type: step, height_m: 0.1, polygon_m: [[1, 0.5], [2, 0.5], [2, 1], [1, 1]]}\n";
  const std::string groove =
      "- {type: groove, width_m: 0.1, depth_m: 0.02, line_m: [[1.5, 0.4], [1.5, 1.1]]}\n";
  const auto volume = [](const Hazard& h) {
    double area = 0;
    for (const Solid& s : h.solids) area += std::abs(SignedArea(s.base));
    return area;
  };
  const Site on = Read(Rows("hazards:\n" + platform +
                            "- {type: cable_cover, width_m: 0.1, top_width_m: 0.05, height_m: "
                            "0.02, line_m: [[1.2, 0.75], [1.8, 0.75]]}\n"));
  EXPECT_TRUE(on.warnings.empty());
  EXPECT_DOUBLE_EQ(on.map.hazards[1].solids.at(0).z_low_m, 0.1);
  EXPECT_DOUBLE_EQ(on.map.hazards[1].solids.at(0).z_high_m, 0.12);

  const Site across = Read(Rows("hazards:\n" + platform +
                                "- {type: cable_cover, id: c, width_m: 0.1, top_width_m: 0.05, "
                                "height_m: 0.02, line_m: [[0.8, 0.75], [1.8, 0.75]]}\n"));
  EXPECT_THAT(across.warnings, ElementsAre(HasSubstr("c lies across the edge")));

  for (const std::string& list : {platform + groove, groove + platform}) {
    const Site cut = Read(Rows("hazards:\n" + list));
    EXPECT_EQ(cut.map.hazards[0].type, "step");
    EXPECT_NEAR(volume(cut.map.hazards[0]), 0.5 - 0.05, 1e-9);
    EXPECT_NEAR(volume(cut.map.hazards[1]), 0.07, 1e-9);
  }
}

// A carpet bends over what other hazards lie on the floor, and lies in a pit or on a platform.
TEST_F(SiteTest, ACarpetBendsOverLowEdgesAlone) {
  const std::string carpet =
      "- {type: carpet, id: rug, polygon_m: [[0.8, 0.6], [1.8, 0.6], [1.8, 0.9], [0.8, 0.9]]}\n";
  const auto step = [](double height_m, const std::string& from_m) {
    return "- {type: step, height_m: " + FormatDouble(height_m) + ", polygon_m: [[" + from_m +
           ", 0.5], [2, 0.5], [2, 1], [" + from_m + ", 1]]}\n";
  };
  const std::string across = "line_m: [[1.3, 0.4], [1.3, 1.1]]}\n";
  for (const std::string& beneath :
       {std::string(), "- {type: threshold, " + across, "- {type: cable_cover, " + across,
        "- {type: groove, depth_m: 0.1, width_m: 0.03, " + across, step(-0.3, "0.5"),
        step(0.1, "0.5"), step(0.02, "1.2"), step(-0.02, "1.2")})
    for (const std::string& list : {beneath + carpet, carpet + beneath})
      EXPECT_NO_THROW(Read(Rows("hazards:\n" + list))) << list;
  for (const double height_m : {-0.3, 0.3, 0.021, -0.021})
    for (const std::string& list : {step(height_m, "1.2") + carpet, carpet + step(height_m, "1.2")})
      EXPECT_THAT(Refusal([&] { Read(Rows("hazards:\n" + list)); }),
                  HasSubstr("a carpet bends over edges of at most 20 mm; the floors beneath this "
                            "one differ by " +
                            LengthText(std::abs(height_m))))
          << list;
}

TEST_F(SiteTest, AHazardOffTheMapIsWarnedOf) {
  const Site dut =
      Read(Rows("hazards:\n- {type: step, id: far, polygon_m: [[100, 1], [101, 1], [101, 2]]}\n"));
  EXPECT_THAT(dut.warnings, ElementsAre(HasSubstr("far lies off the map")));
}

TEST_F(SiteTest, ResolvedSaysEveryDefaultAndMeansTheSame) {
  const ConfigNode node = ParseYaml(kDesignsExample, "site.yaml");
  const std::string text = WriteYaml(ResolveSite(node, ".", "."));
  for (const char* key : {"inset_m: 0.03", "known: true", "amplitude_m: 0.003", "friction: none",
                          "thickness_m: cell", "id: \"step-1\"", "depth_m: 0.03"})
    EXPECT_THAT(text, HasSubstr(key));
  const Site before = ReadSite(node, "."), after = ReadSite(ParseYaml(text, "r.yaml"), ".");
  EXPECT_EQ(before.map.occupancy.cells, after.map.occupancy.cells);
  EXPECT_EQ(Ids(before.map), Ids(after.map));
  for (std::size_t i = 0; i < before.map.hazards.size(); ++i) {
    const Hazard &a = before.map.hazards[i], &b = after.map.hazards[i];
    EXPECT_EQ(a.material.friction, b.material.friction);
    EXPECT_EQ(a.material.restitution, b.material.restitution);
    ASSERT_EQ(a.solids.size(), b.solids.size());
    for (std::size_t k = 0; k < a.solids.size(); ++k) EXPECT_EQ(a.solids[k].base, b.solids[k].base);
  }
  // Resolved again: itself, to the byte.
  EXPECT_EQ(WriteYaml(ResolveSite(ParseYaml(text, "r.yaml"), ".", ".")), text);
}

TEST_F(SiteTest, ResolvedPathsHoldFromTheOutputFolder) {
  SaveMap();
  fs::create_directories(folder_ / "out" / "run");
  const ConfigNode node =
      ParseYaml("site: 1\nmap: map.yaml\nstart: {x_m: 0, y_m: 2.3}\n", "s.yaml");
  const ConfigNode resolved = ResolveSite(node, folder_, folder_ / "out" / "run");
  EXPECT_EQ(resolved.Find("map")->scalar, "../../map.yaml");
  EXPECT_EQ(ReadSite(resolved, folder_ / "out" / "run").map.frame.width, 3);
  const std::string text = WriteYaml(resolved);
  EXPECT_EQ(WriteYaml(ResolveSite(ParseYaml(text, "s.yaml"), folder_ / "out" / "run",
                                  folder_ / "out" / "run")),
            text);
}

}  // namespace
}  // namespace floorproof
