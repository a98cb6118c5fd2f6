// SPDX-License-Identifier: Apache-2.0
// map_server's semantics, and the traps that real maps hold.
#include "env/map/ros_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/map/temp_folder.h"
#include "tests/media/png_maker.h"

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr CellState kFree = CellState::kFree, kWall = CellState::kOccupied,
                    kUnknown = CellState::kUnknown;

struct MapKeys {
  std::string image = "map.pgm", resolution = "0.05", origin = "[0, 0, 0]", negate = "0",
              occupied = "0.65", free = "0.196", extra = "";
};

class RosMapTest : public TempFolder {
 protected:
  RosMap Read(const std::string& image_bytes, const MapKeys& keys = {}) const {
    Save(keys.image, image_bytes);
    return ReadRosMap(SaveYaml(keys));
  }
  std::filesystem::path SaveYaml(const MapKeys& keys) const {
    return Save("map.yaml", "image: " + keys.image + "\nresolution: " + keys.resolution +
                                "\norigin: " + keys.origin + "\nnegate: " + keys.negate +
                                "\noccupied_thresh: " + keys.occupied +
                                "\nfree_thresh: " + keys.free + "\n" + keys.extra);
  }
  // One row of greys as P2.
  static std::string Row(const std::vector<int>& greys) {
    std::string text = "P2 " + std::to_string(greys.size()) + " 1 255\n";
    for (const int g : greys) text += std::to_string(g) + " ";
    return text;
  }
  static std::string Png(int color_type, const std::vector<unsigned>& samples, unsigned width) {
    return MakePng({.width = width, .height = 1, .color_type = color_type, .samples = samples});
  }
};

TEST_F(RosMapTest, BlackIsWallWhiteIsFreeBetweenIsUnknown) {
  const RosMap dut = Read(Row({0, 89, 90, 128, 205, 206, 254, 255}));
  // p = 1 - grey / 255: wall above 0.65 (grey < 89.25), free below 0.196 (grey > 205.02).
  EXPECT_THAT(dut.occupancy.cells,
              ElementsAre(kWall, kWall, kUnknown, kUnknown, kUnknown, kFree, kFree, kFree));
  EXPECT_THAT(dut.warnings, IsEmpty());
}

// The top row of the image is the far side of the floor.
//   image:  #..      cells:  y = 1   # . .
//           ..?              y = 0   . . ?
TEST_F(RosMapTest, OriginIsTheLowerLeftCorner) {
  const RosMap dut =
      Read("P2 3 2 255\n0 254 254\n254 254 205\n", {.resolution = "0.5", .origin = "[-1, 2, 0]"});
  EXPECT_EQ(dut.occupancy(0, 1), kWall);
  EXPECT_EQ(dut.occupancy(2, 0), kUnknown);
  EXPECT_EQ(dut.occupancy(0, 0), kFree);
  EXPECT_EQ(dut.frame.ToCell({-1 + 0.01, 2 + 0.01}), (Cell{0, 0}));
  EXPECT_EQ(dut.frame.ToCell({-1 + 1.49, 2 + 0.99}), (Cell{2, 1}));
}

TEST_F(RosMapTest, OriginYawTurnsTheWholeMap) {
  const RosMap dut = Read(Row({0, 254, 205}), {.resolution = "1", .origin = "[5, 0, 1.5707963]"});
  // A row along world y: cell (2, 0) lies at y = 2.5, left of the row's edge.
  const Vec2 p = dut.frame.Center(2, 0);
  EXPECT_NEAR(p.x(), 5 - 0.5, 1e-6);
  EXPECT_NEAR(p.y(), 2.5, 1e-6);
  EXPECT_EQ(dut.frame.ToCell({4.5, 2.5}), (Cell{2, 0}));
}

// 205 is what map savers write for unknown, and p = 50/255 = 0.19608 is just not below 0.196.
TEST_F(RosMapTest, Grey205HangsOnTheFreeThreshold) {
  EXPECT_EQ(Read(Row({205}), {.free = "0.196"}).occupancy(0, 0), kUnknown);
  EXPECT_EQ(Read(Row({205}), {.free = "0.19607"}).occupancy(0, 0), kUnknown);
  const RosMap loose = Read(Row({205, 205, 254}), {.free = "0.25"});
  EXPECT_THAT(loose.occupancy.cells, ElementsAre(kFree, kFree, kFree));
  ASSERT_THAT(loose.warnings, SizeIs(1));
  EXPECT_THAT(loose.warnings[0], HasSubstr("in 2 cells"));
  EXPECT_THAT(loose.warnings[0], HasSubstr("map.yaml: grey 205"));
}

TEST_F(RosMapTest, ThresholdsThemselvesAreUnknown) {
  // 204 is p = 0.2 and 51 is p = 0.8, exactly: neither below nor above.
  const RosMap dut = Read(Row({204, 205, 51, 50}), {.occupied = "0.8", .free = "0.2"});
  EXPECT_THAT(dut.occupancy.cells, ElementsAre(kUnknown, kFree, kUnknown, kWall));
}

TEST_F(RosMapTest, NegateTurnsBlackAndWhiteRound) {
  for (const char* yes : {"1", "true", "True"})
    EXPECT_THAT(Read(Row({0, 255}), {.negate = yes}).occupancy.cells, ElementsAre(kFree, kWall))
        << yes;
  for (const char* no : {"0", "false"})
    EXPECT_THAT(Read(Row({0, 255}), {.negate = no}).occupancy.cells, ElementsAre(kWall, kFree))
        << no;
}

TEST_F(RosMapTest, EveryImageFormGivesTheSameCells) {
  const std::vector<CellState> expected = {kWall, kUnknown, kFree, kFree};
  EXPECT_EQ(Read(Row({0, 128, 254, 255})).occupancy.cells, expected);
  EXPECT_EQ(Read(std::string("P5 4 1 255\n\0\x80\xfe\xff", 15)).occupancy.cells, expected);
  EXPECT_EQ(Read("P3 4 1 255\n0 0 0 128 128 128 254 254 254 255 255 255").occupancy.cells,
            expected);
  const MapKeys png{.image = "map.png"};
  EXPECT_EQ(Read(Png(0, {0, 128, 254, 255}, 4), png).occupancy.cells, expected);
  EXPECT_EQ(
      Read(Png(2, {0, 0, 0, 128, 128, 128, 254, 254, 254, 255, 255, 255}, 4), png).occupancy.cells,
      expected);
  PngSpec palette{
      .width = 4, .height = 1, .bit_depth = 2, .color_type = 3, .samples = {0, 1, 2, 3}};
  palette.palette = std::string("\0\0\0\x80\x80\x80\xfe\xfe\xfe\xff\xff\xff", 12);
  EXPECT_EQ(Read(MakePng(palette), png).occupancy.cells, expected);
  std::vector<uchar> bmp;
  const cv::Mat row = (cv::Mat_<uchar>(1, 4) << 0, 128, 254, 255);
  cv::imencode(".bmp", row, bmp);
  EXPECT_EQ(Read(std::string(bmp.begin(), bmp.end()), {.image = "map.bmp"}).occupancy.cells,
            expected);
}

TEST_F(RosMapTest, ColoursAreAveraged) {
  // (255 + 0 + 0) / 3 = 85: p = 2/3 > 0.65; (255 + 255 + 0) / 3 = 170: unknown.
  const RosMap dut = Read(Png(2, {255, 0, 0, 255, 255, 0, 255, 255, 255}, 3), {.image = "map.png"});
  EXPECT_THAT(dut.occupancy.cells, ElementsAre(kWall, kUnknown, kFree));
}

// Nav2: "average in alpha with color channels in Trinary mode".
TEST_F(RosMapTest, TrinaryCountsAlphaAsAFourthColour) {
  const MapKeys keys{.image = "map.png"};
  // Opaque: black (0+0+0+255)/4 = 63.75, p = 0.75; 205 becomes 217.5, p = 0.147.
  // Transparent: white (765+0)/4 = 191.25, p = 0.25; black 0, p = 1.
  const std::vector<unsigned> grey_alpha = {0, 255, 205, 255, 254, 255, 255, 0, 0, 0};
  std::vector<unsigned> rgba;
  for (std::size_t i = 0; i < grey_alpha.size(); i += 2)
    rgba.insert(rgba.end(), {grey_alpha[i], grey_alpha[i], grey_alpha[i], grey_alpha[i + 1]});
  const RosMap la = Read(Png(4, grey_alpha, 5), keys), color = Read(Png(6, rgba, 5), keys);
  EXPECT_THAT(la.occupancy.cells, ElementsAre(kWall, kFree, kFree, kUnknown, kWall));
  EXPECT_EQ(color.occupancy.cells, la.occupancy.cells);
  ASSERT_THAT(la.warnings, SizeIs(1));
  EXPECT_THAT(la.warnings[0], HasSubstr("alpha"));
}

TEST_F(RosMapTest, ScaleTakesWhatIsNotOpaqueAsUnknown) {
  const MapKeys keys{.image = "map.png", .extra = "mode: scale\n"};
  const RosMap dut = Read(Png(4, {0, 255, 0, 254, 255, 255, 255, 0, 128, 255}, 5), keys);
  EXPECT_THAT(dut.occupancy.cells, ElementsAre(kWall, kUnknown, kFree, kUnknown, kUnknown));
  // Between the thresholds the scale rounds: 205 lies 0.02 % above free and becomes 0.
  EXPECT_THAT(Read(Row({205, 200}), {.extra = "mode: scale\n"}).occupancy.cells,
              ElementsAre(kFree, kUnknown));
}

TEST_F(RosMapTest, RawIsPercent) {
  const RosMap dut = Read(Row({0, 10, 40, 70, 100, 101, 255}), {.extra = "mode: raw\n"});
  EXPECT_THAT(dut.occupancy.cells,
              ElementsAre(kFree, kFree, kUnknown, kWall, kWall, kUnknown, kUnknown));
  EXPECT_THAT(Read(Row({0, 100}), {.negate = "1", .extra = "mode: raw\n"}).warnings, SizeIs(1));
}

TEST_F(RosMapTest, ImageIsFoundFromTheMapsFolderOrByAbsolutePath) {
  std::filesystem::create_directory(folder_ / "images");
  EXPECT_EQ(Read(Row({0}), {.image = "images/a.pgm"}).image, folder_ / "images/a.pgm");
  const auto absolute = Save("b.pgm", Row({254}));
  EXPECT_EQ(ReadRosMap(SaveYaml({.image = absolute.string()})).occupancy(0, 0), kFree);
}

TEST_F(RosMapTest, ForeignKeysArePassedOver) {
  EXPECT_EQ(Read(Row({254}), {.extra = "map_id: lobby\nregions: [1, {a: b}]\n"}).occupancy(0, 0),
            kFree);
}

TEST_F(RosMapTest, HugeAndMostlyUnknown) {
  std::string p5 = "P5 4000 4000 255\n" + std::string(16'000'000, '\xcd');
  for (int i = 0; i < 4000; i += 2) p5[p5.size() - 1 - 4001U * static_cast<unsigned>(i)] = '\xfe';
  const RosMap dut = Read(p5);
  EXPECT_EQ(std::ranges::count(dut.occupancy.cells, kFree), 2000);
  EXPECT_EQ(std::ranges::count(dut.occupancy.cells, kUnknown), 16'000'000 - 2000);
}

struct Broken {
  const char* name;
  MapKeys keys;
  const char* expected;
};

TEST_F(RosMapTest, WhatIsWrongIsSaidWithFileLineKeyAndRule) {
  Save("map.pgm", Row({254}));
  Save("wide.pgm", "P5 3000 3000 255\n" + std::string(9'000'000, '\xfe'));
  std::filesystem::create_directory(folder_ / "elsewhere");
  const std::vector<Broken> table = {
      {"image missing", {.image = "no.pgm"}, "map.yaml:1: image = "},
      {"image missing, rule", {.image = "no.pgm"}, "no such file"},
      {"image elsewhere", {.image = "/home/somebody/map.pgm"}, "write image: map.pgm"},
      {"image empty", {.image = "\"\""}, "image = \"\": must name a file"},
      {"image a list", {.image = "[a]"}, "map.yaml:1: image = [...]: must be text"},
      {"image a folder", {.image = "elsewhere"}, "is a folder"},
      {"image the yaml", {.image = "map.yaml"}, "not an image"},
      {"resolution zero", {.resolution = "0"}, "map.yaml:2: resolution = 0: must be in"},
      {"resolution negative", {.resolution = "-0.05"}, "map.yaml:2: resolution = -0.05"},
      {"resolution nan", {.resolution = "nan"}, "map.yaml:2: resolution = nan"},
      {"resolution infinite", {.resolution = "inf"}, "map.yaml:2: resolution = inf"},
      {"resolution text", {.resolution = "5cm"}, "resolution = 5cm: must be a number"},
      {"resolution empty", {.resolution = ""}, "map.yaml:2: resolution"},
      {"too large a floor", {.image = "wide.pgm", .resolution = "1"}, "3000 m x 3000 m"},
      {"origin short", {.origin = "[0, 0]"}, "map.yaml:3: origin: must be [x, y, yaw]"},
      {"origin a number", {.origin = "0"}, "map.yaml:3: origin"},
      {"origin nan", {.origin = "[0, .nan, 0]"}, "map.yaml:3: origin[1]"},
      {"origin beyond", {.origin = "[0, 1e9, 0]"}, "origin[1] = 1e9: must be in"},
      {"negate", {.negate = "2"}, "map.yaml:4: negate = 2: must be 0, 1, true or false"},
      {"occupied", {.occupied = "65"}, "map.yaml:5: occupied_thresh = 65: must be in [0, 1]"},
      {"free", {.free = "-0.1"}, "map.yaml:6: free_thresh = -0.1: must be in [0, 1]"},
      {"swapped", {.occupied = "0.2", .free = "0.65"}, "must be at most occupied_thresh, 0.2"},
      {"mode", {.extra = "mode: trinari"}, "map.yaml:7: mode = trinari: must be trinary, scale or"},
      {"twice", {.extra = "negate: 1"}, "negate: the key stands twice"},
      {"syntax", {.extra = "]"}, "map.yaml:7"},
  };
  for (const Broken& broken : table) {
    const std::string said = Refusal([&] { ReadRosMap(SaveYaml(broken.keys)); });
    EXPECT_THAT(said, HasSubstr(broken.expected)) << broken.name;
    EXPECT_EQ(said.find('\n'), std::string::npos) << broken.name;
  }
}

TEST_F(RosMapTest, AMissingKeyIsNamedAndItsMisspellingToo) {
  Save("map.pgm", Row({254}));
  const std::string all =
      "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n";
  EXPECT_EQ(ReadRosMap(Save("map.yaml", all)).occupancy(0, 0), kFree);
  for (const std::string key :
       {"image", "resolution", "origin", "occupied_thresh", "free_thresh"}) {
    std::string text = all;
    text.insert(text.find(key) + 2, "x");
    const std::string said = Refusal([&] { ReadRosMap(Save("map.yaml", text)); });
    EXPECT_THAT(said, HasSubstr(key + ": missing")) << key;
    EXPECT_THAT(said, HasSubstr("is " + key.substr(0, 2) + "x" + key.substr(2) + " it")) << key;
  }
  EXPECT_THAT(Refusal([&] { ReadRosMap(Save("map.yaml", "- a\n- b\n")); }),
              HasSubstr("is not a ROS map"));
  EXPECT_THAT(Refusal([&] { ReadRosMap(folder_ / "none.yaml"); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace floorproof
