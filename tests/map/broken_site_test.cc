// SPDX-License-Identifier: Apache-2.0
// What is wrong with a site is said in one line: file, line, key, value, rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "env/map/site.h"
#include "tests/map/temp_folder.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

class BrokenSiteTest : public TempFolder {
 protected:
  static std::string Refused(const std::string& text) {
    return Refusal([&] { ReadSite(ParseYaml(text, "site.yaml"), "/nowhere"); });
  }
};

struct Broken {
  std::string text;
  const char* expected;
};

TEST_F(BrokenSiteTest, OfTheSiteItself) {
  const std::string grid = "site: 1\ngrid: {rows: \"....\"}\n";
  const std::vector<Broken> table = {
      {"", "site: must be a map of keys"},
      {"- 1", "site: must be a map of keys"},
      {"grid: {rows: \"...\"}", "site: missing; write site: 1"},
      {"site: 2\ngrid: {rows: \"...\"}", "site.yaml:1: site = 2: must be 1"},
      {"site: 1", "map, grid or generate: a site has one of the three"},
      {"site: 1\nmap: a.yaml\ngrid: {rows: \"..\"}",
       "map, grid or generate: a site has one of the three"},
      {grid + "hazzards: []", "site.yaml:3: hazzards: unknown key; did you mean hazards?"},
      {grid + "generate: {kind: room}", "site.yaml:3: map, grid or generate: a site has one of"},
      {grid + "unknown: floor", "site.yaml:3: unknown = floor: must be wall or free"},
      {grid + "unknown: [wall]", "site.yaml:3: unknown = [...]: must be text"},
      {grid + "floor: {friction: 0}", "site.yaml:3: floor.friction = 0: must be in (0, 5]"},
      {grid + "floor: {fricton: 1}", "floor.fricton: unknown key; did you mean friction?"},
      {grid + "floor: 0.8", "site.yaml:3: floor = 0.8: must be a map of keys"},
      {grid + "start: {x_m: 1}", "start.y_m: missing"},
      {grid + "start:\n", "start.x_m: missing"},
      {grid + "start: {x_m: 1, y_m: nan, yaw_deg: 0}", "start.y_m = nan: must be a finite number"},
      {grid + "start: {x_m: 1, y_m: 9}", "site.yaml:3: start = (1, 9): lies off the map"},
      {grid + "goal: {x_m: -0.1, y_m: 0.2}", "goal = (-0.1, 0.2): lies off the map"},
      {grid + "goal: {x_m: 1, y_m: 0.2, yaw_deg: 3}", "goal.yaw_deg: unknown key"},
      {"site: 1\nmap: none.yaml", "none.yaml: no such file"},
      {"site: 1\nmap: \"\"", "site.yaml:2: map = \"\": must name a file"},
      {"site: 1\nmap: {image: a.pgm}", "site.yaml:2: map = {...}: must be text"},
      {"site: 1\nmap: a/../../b.yaml", "map = a/../../b.yaml: leaves its folder"},
      {"site: 1\nmap: ./../b.yaml", "leaves its folder"},
  };
  for (const Broken& b : table) EXPECT_THAT(Refused(b.text), HasSubstr(b.expected)) << b.text;
  // Said plainly, leaving is allowed (and here fails only for want of the file).
  EXPECT_THAT(Refused("site: 1\nmap: ../b.yaml"), HasSubstr("b.yaml: no such file"));
}

TEST_F(BrokenSiteTest, OfADrawing) {
  const auto drawn = [](const std::string& rows, const std::string& more = "") {
    return "site: 1\ngrid:\n  cell_m: 0.5\n  rows: |\n" + rows + more;
  };
  const std::vector<Broken> table = {
      {"site: 1\ngrid: 3", "site.yaml:2: grid: must be a map of keys"},
      {"site: 1\ngrid: {cell_m: 0.5}", "grid.rows: must be the drawing"},
      {"site: 1\ngrid: {rows: [a, b]}", "site.yaml:2: grid.rows: must be the drawing"},
      {"site: 1\ngrid:\n  rows: #...\n", "grid.rows: must be the drawing"},
      {"site: 1\ngrid: {rows: \"\"}", "must have a row of at least one character"},
      {drawn("    ....\n    ..x.\n    ....\n"), "site.yaml:6: grid.rows[1] = ..x.: unknown char"},
      {drawn("    ....\n    ..x.\n"), "at column 3 (known: .#G?v^=gr)"},
      {drawn("    ....\n    .....\n"), "site.yaml:6: grid.rows[1] = .....: has 5 characters, the"},
      {drawn("    ....\n\n    ....\n"), "site.yaml:6: grid.rows[1]: has 0 characters"},
      {drawn("    ..\n", "  cell_n: 1\n"),
       "site.yaml:6: grid.cell_n: unknown key; did you mean cell_m"},
      {"site: 1\ngrid: {cell_m: -1, rows: \"..\"}", "grid.cell_m = -1: must be in [0.01, 100]"},
      {"site: 1\ngrid: {cell_m: inf, rows: \"..\"}", "grid.cell_m = inf"},
      {"site: 1\ngrid: {cell_m: 0.5, inset_m: 0.25, rows: \"..\"}", "grid.inset_m = 0.25: must be"},
      {"site: 1\ngrid: {cell_m: 0.5, inset_m: -1, rows: \"..\"}",
       "grid.inset_m = -1: must be >= 0"},
      {"site: 1\ngrid: {cell_m: 100, rows: \"" + std::string(2000, '.') + "\"}",
       "the floor measures 200000 m x 100 m"},
      {drawn("    ..\n", "  sizes: {gras: {}}\n"),
       "grid.sizes.gras: unknown key; did you mean glass"},
      {drawn("    ..\n", "  sizes: [1]\n"), "site.yaml:6: grid.sizes: must be a map of keys"},
      {drawn("    ..\n", "  sizes: {drop: 3}\n"), "grid.sizes.drop: must be a map of keys"},
      {drawn("    ..\n", "  sizes: {drop: {height_m: 0.1}}\n"), "must be < 0: v is a drop"},
      {drawn("    ..\n", "  sizes: {raised: {height_m: -0.1}}\n"), "must be > 0: ^ is raised"},
      {drawn("    ..\n", "  sizes: {groove: {depth_m: 0}}\n"),
       "grid.sizes.groove.depth_m = 0: must"},
      {drawn("    ..\n", "  sizes: {groove: {known: maybe}}\n"),
       "groove.known = maybe: must be true"},
      {drawn("    ==\n", "  sizes: {cable_cover: {top_width_m: 1}}\n"),
       "site.yaml:6: grid.sizes.cable_cover.top_width_m = 1: must be at most width_m, 0.13"},
      {drawn("    rr\n", "  sizes: {rough: {wavelength_m: 0.01}}\n"), "more than 2000 bumps"},
  };
  for (const Broken& b : table) EXPECT_THAT(Refused(b.text), HasSubstr(b.expected)) << b.text;
}

TEST_F(BrokenSiteTest, OfHazards) {
  const auto hazards = [](const std::string& list) {
    return "site: 1\ngrid: {rows: \"....\"}\nhazards:\n" + list;
  };
  const std::string square = "polygon_m: [[0, 0], [1, 0], [1, 1], [0, 1]]";
  const std::vector<Broken> table = {
      {"site: 1\ngrid: {rows: \"....\"}\nhazards: {a: 1}", "site.yaml:3: hazards: must be a list"},
      {hazards("- step\n"), "site.yaml:4: hazards[0]: must be a map of keys"},
      {hazards("- {id: a}\n"), "hazards[0].type: missing"},
      {hazards("- {type: stp, " + square + "}\n"),
       "hazards[0].type = stp: unknown; did you mean step?"},
      {hazards("- {type: [step]}\n"), "hazards[0].type = [...]: must be text"},
      {hazards("- {type: step, " + square + "}\n- {type: step}\n"),
       "site.yaml:5: hazards[1].polygon_m: missing"},
      {hazards("- {type: step, line_m: [[0, 0], [1, 0]]}\n"), "a step is placed by polygon_m"},
      {hazards("- {type: glass, " + square + "}\n"), "a glass is placed by line_m"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 0]]}\n"), "must be a list of 3 to"},
      {hazards("- {type: step, polygon_m: 4}\n"), "must be a list of 3 to"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 0], [1]]}\n"),
       "hazards[0].polygon_m[2]: must be a point [x, y]"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 0], [1, .inf]]}\n"), "polygon_m[2] = .inf"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 0], [1, 1e7]]}\n"), "polygon_m[2] = 1e7"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 1], [1, 0], [0, 1]]}\n"), "cross or touch"},
      {hazards("- {type: step, polygon_m: [[0, 0], [1, 0], [2, 0]]}\n"), "polygon_m: "},
      {hazards("- {type: step, polygon_m: [[0, 0], [0, 0], [2, 0], [1, 1]]}\n"),
       "polygon_m[1]: is the same point as the one before"},
      {hazards("- {type: step, " + square + ", height_m: 0}\n"),
       "site.yaml:4: hazards[0].height_m = 0: must be at least"},
      {hazards("- {type: step, " + square + ", height_m: 3}\n"),
       "height_m = 3: must be in [-2, 2]"},
      {hazards("- {type: step, " + square + ", hight_m: 1}\n"),
       "hazards[0].hight_m: unknown key; did you mean height_m?"},
      {hazards("- {type: step, " + square + ", known: 1}\n"), "known = 1: must be true or false"},
      {hazards("- {type: step, " + square + ", friction: -1}\n"),
       "friction = -1: must be in (0, 5]"},
      {hazards("- {type: step, " + square + ", restitution: 1.5}\n"),
       "restitution = 1.5: must be in"},
      {hazards("- {type: step, " + square + ", id: \"\"}\n"), "hazards[0].id: must be 1 to 64"},
      {hazards("- {type: step, " + square + ", id: wall}\n"), "hazards[0].id = wall: must be 1 to"},
      {hazards("- {type: step, " + square + ", id: \"a,b\"}\n"), "without comma"},
      {hazards("- {type: step, " + square +
               ", id: a}\n- {type: glass, id: a, line_m: [[0, 0], [1, 0]]}"),
       "id = a: two hazards have this id"},
      {hazards("- {type: groove, line_m: [[0, 0]]}\n"), "must be a list of 2 to"},
      {hazards("- {type: groove, line_m: [[0, 0], [1, 0], [0.1, 0.01]]}\n"),
       "bends by more than 150"},
      {hazards("- {type: groove, line_m: [[0, 0], [0.01, 0], [0.01, 1]], width_m: 0.2}\n"),
       "lie too close for a bend of this width_m"},
      {hazards("- {type: cable_cover, line_m: [[0, 0], [1, 0]], top_width_m: 0.2}\n"),
       "hazards[0].top_width_m = 0.2: must be at most width_m"},
      {hazards("- {type: rough, polygon_m: [[0, 0], [9, 0], [9, 9]]}\n"), "more than 2000 bumps"},
      {hazards("- {type: rough, polygon_m: [[0, 0], [1e6, 1e6], [1e6, 999999]]}\n"), "bumps"},
  };
  for (const Broken& b : table) EXPECT_THAT(Refused(b.text), HasSubstr(b.expected)) << b.text;
}

TEST_F(BrokenSiteTest, EveryMessageIsOneLine) {
  for (const std::string text :
       {"site: \"1\\n2\"", "site: 1\ngrid: {rows: \".\\n\\x07\"}", "site: 1\n? [a, b]\n: 3",
        "site: 1\nsite: 1", "\t", "site: 1\n}"}) {
    const std::string said = Refused(text);
    EXPECT_NE(said, "accepted") << text;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

// Any byte of a good site changed or cut off: read or refused, never a crash.
TEST_F(BrokenSiteTest, MutatedSitesAreReadOrRefused) {
  const std::string good =
      "site: 1\ngrid:\n  cell_m: 0.5\n  rows: |\n    #G=v^\n    .g?r.\nfloor: {friction: 0.8}\n"
      "hazards:\n- {type: groove, line_m: [[0, 0], [1, 0], [1, 0.5]], width_m: 0.02}\n"
      "- {type: step, polygon_m: [[0, 0], [1, 0], [1, 1]], height_m: -0.1}\n";
  ASSERT_EQ(Refused(good), "accepted");
  int refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    EXPECT_NO_THROW(Refused(good.substr(0, i)));
    for (const char c : {'-', '9', ':', '\n', '[', 'v'}) {
      std::string changed = good;
      changed[i] = c;
      refused += Refused(changed) != "accepted";
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace floorproof
