// SPDX-License-Identifier: Apache-2.0
#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

BadInput Site(const std::string& name, const std::string& from, const std::string& to,
              std::vector<std::string> named) {
  return {name,
          {"plan", "scenario.yaml", "--out", "o"},
          {{"site.yaml", Replaced(GoodFiles().at("site.yaml"), from, to)}},
          std::move(named)};
}
BadInput Drawing(const std::string& name, const std::string& from, const std::string& to,
                 std::vector<std::string> named) {
  return {name,
          {"plan", "drawn.yaml", "--out", "o"},
          {{"drawn.yaml", Replaced(GoodFiles().at("drawn.yaml"), from, to)}},
          std::move(named)};
}

}  // namespace

std::vector<BadInput> SiteCases() {
  const std::string glass = "line_m: [[2.0, 1.0], [2.0, 2.0]]";
  const std::string step = "[[3.0, 0.5], [3.2, 0.5], [3.2, 2.5]]";
  return {
      Site("VersionTwo", "site: 1", "site: 2", {"site.yaml:1: site = 2", "must be 1"}),
      Site("NoVersion", "site: 1\n", "", {"site.yaml", "site", "missing"}),
      Site("NeitherMapNorGrid", "map: map.yaml\n", "",
           {"site.yaml", "map, grid or generate", "one of the three"}),
      Site("MapAndGrid", "unknown: wall", "grid: {rows: \"..\"}",
           {"site.yaml:4", "map, grid or generate", "one of the three"}),
      Site("UnknownKey",
           "hazards:", "hazzards:", {"site.yaml:", "hazzards", "did you mean hazards?"}),
      Site("UnknownPolicy", "unknown: wall", "unknown: lava",
           {"site.yaml:4: unknown = lava", "wall or free"}),
      Site("NegativeFriction", "friction: 0.8", "friction: -0.8",
           {"site.yaml:5: floor.friction = -0.8", "(0, 5]"}),
      Site("MissingMap", "map: map.yaml", "map: mapp.yaml",
           {"site.yaml:3: map = mapp.yaml", "no such file"}),
      Trusted(Site("MapIsADevice", "map: map.yaml", "map: /dev/zero",
                   {"/dev/zero", "a pipe or a device"})),
      Site("MapIsAnImage", "map: map.yaml", "map: map.png",
           {"map.png", "is the map's image: name its .yaml"}),
      Site("MapClimbsOut", "map: map.yaml", "map: ./../../map.yaml",
           {"site.yaml:3: map = ./../../map.yaml", "leaves its folder"}),
      Site("MapIsNoMap", "map: map.yaml", "map: ../../../../../../../../etc/passwd",
           {"etc/passwd"}),
      Site("UnknownHazard", "type: glass", "type: gras",
           {"site.yaml:7: hazards[0].type = gras", "did you mean glass?"}),
      Site("HazardsAreAMap", "  - {type: glass, id: door, " + glass + ", height_m: 2.0}\n  - ",
           "  sill: ", {"site.yaml:7: hazards", "must be a list"}),
      Site("UnknownHazardKey", "height_m: 2.0", "heigth_m: 2.0",
           {"site.yaml:7: hazards[0].heigth_m", "did you mean height_m?"}),
      Site("NegativeHeight", "height_m: 2.0", "height_m: -2.0",
           {"site.yaml:7: hazards[0].height_m = -2.0", "must be"}),
      Site("NoWidth", "height_m: 2.0", "thickness_m: 0",
           {"site.yaml:7: hazards[0].thickness_m = 0", "must be"}),
      Site("CarpetOverAPit", "hazards:\n",
           "hazards:\n  - {type: step, polygon_m: [[2, 1], [3, 1], [3, 2], [2, 2]], height_m: "
           "-0.3}\n"
           "  - {type: carpet, id: rug, polygon_m: [[1.5, 1], [3, 1], [3, 2], [1.5, 2]]}\n",
           {"site.yaml:8: hazards[1].polygon_m = [[1.5, 1], [3, 1], [3, 2], [1.5, 2]]",
            "bends over edges of at most 20 mm; the floors beneath this one differ by 300 mm"}),
      Site("NotANumber", "height_m: 0.01", "height_m: .NaN",
           {"site.yaml:8: hazards[1].height_m = .NaN", "must be a number"}),
      Site("ALineOfOnePoint", glass, "line_m: [[2.0, 1.0]]",
           {"site.yaml:7: hazards[0].line_m", "list of 2 to"}),
      Site("ALineWithoutLength", glass, "line_m: [[2.0, 1.0], [2.0, 1.0]]",
           {"site.yaml:7: hazards[0].line_m[1]", "same point"}),
      Site("APointOfThree", glass, "line_m: [[2.0, 1.0, 0.0], [2.0, 2.0]]",
           {"site.yaml:7: hazards[0].line_m[0]", "must be a point [x, y]"}),
      Site("ALineForAPolygon", "polygon_m: " + step, "line_m: [[0, 0], [1, 1]]",
           {"site.yaml:8: hazards[1].line_m", "placed by polygon_m"}),
      Site("CrossingEdges", step, "[[3, 0], [4, 1], [4, 0], [3, 1]]",
           {"site.yaml:8: hazards[1].polygon_m", "cross or touch"}),
      Site("APolygonWithoutArea", step, "[[3, 0], [4, 0], [5, 0]]",
           {"site.yaml:8: hazards[1].polygon_m"}),
      Site("AFarAwayPolygon", step, "[[3, 0], [1e30, 0], [5, 1]]",
           {"site.yaml:8: hazards[1].polygon_m[1] = 1e30", "[-1e+06, 1e+06]"}),
      Site("TheSameIdTwice", "id: sill", "id: door", {"site.yaml:", "id = door", "two hazards"}),
      Drawing("UnevenRows", "#....#\n      #....#", "#....#\n      #...#",
              {"drawn.yaml:9: grid.rows[2] = #...#", "has 5 characters, the top row 6"}),
      Drawing("UnknownCharacter", "#....#", "#..x.#",
              {"drawn.yaml:8: grid.rows[1] = #..x.#", "unknown character at column 4"}),
      Drawing("NoCell", "cell_m: 0.5", "cell_m: 0",
              {"drawn.yaml:5: grid.cell_m = 0", "[0.01, 100]"}),
      Drawing("NegativeCell", "cell_m: 0.5", "cell_m: -0.5", {"drawn.yaml:5: grid.cell_m = -0.5"}),
      Drawing("HugeCell", "cell_m: 0.5", "cell_m: 1e9", {"drawn.yaml:5: grid.cell_m = 1e9"}),
      Drawing("HugeFloor", "cell_m: 0.5\n    rows: |\n      ######",
              "cell_m: 100\n    rows: |\n      " + std::string(5000, '#') + "\n     ",
              {"drawn.yaml:"}),
      Drawing("UnknownSize", "groove: {", "grove: {",
              {"drawn.yaml:11: grid.sizes.grove", "did you mean groove?"}),
      Drawing("NegativeSize", "width_m: 0.02", "width_m: -0.02",
              {"drawn.yaml:11: grid.sizes.groove.width_m = -0.02"}),
      Drawing("StartOffTheMap", "{x_m: 1.0", "{x_m: 7.0",
              {"drawn.yaml:12: start", "lies off the map"}),
      Drawing("NoFreeCell", "#....#\n      #....#", "######\n      ######",
              {"drawn.yaml:", "start", "lies in a wall"}),
  };
}

}  // namespace floorproof
