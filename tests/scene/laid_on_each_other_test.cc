// SPDX-License-Identifier: Apache-2.0
// Every hazard that shapes the floor, laid on every other, in either order of the file: how high
// the floor is then, by rays through the built scene.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <map>
#include <string>

#include "base/config.h"
#include "env/map/site.h"
#include "env/scene/robot_model.h"
#include "env/scene/scene.h"

namespace floorproof {
namespace {

// What lies beneath covers x 1 to 5 m; what is laid, y 2 to 3 m of all of it.
std::string Polygon(bool beneath) {
  return beneath ? "polygon_m: [[1, 1], [5, 1], [5, 4], [1, 4]]"
                 : "polygon_m: [[0.7, 2], [5.3, 2], [5.3, 3], [0.7, 3]]";
}

struct Kind {
  std::string keys;
  double height_m = 0;  // of its top, over what it lies on
  bool line = false;
};
// Floors, and what lies on them.
const std::map<std::string, Kind> kFloors = {{"dock", {"type: step, height_m: 0.1", 0.1}},
                                             {"pit", {"type: step, height_m: -0.1", -0.1}},
                                             {"rug", {"type: carpet, height_m: 0.006", 0.006}}};
const std::map<std::string, Kind> kCovers = {
    {"carpet", {"type: carpet, height_m: 0.004", 0.004}},
    {"threshold", {"type: threshold, height_m: 0.04, bevel: 0, width_m: 0.6", 0.04, true}},
    {"cable_cover",
     {"type: cable_cover, height_m: 0.02, width_m: 0.6, top_width_m: 0.4", 0.02, true}},
    {"groove", {"type: groove, depth_m: 0.03, width_m: 0.6", -0.03, true}},
};

double FloorAt(const Scene& scene, double x_m, double y_m) {
  const mjModel* m = scene.model.get();
  const DataPtr d = MakeData(m);
  ForwardEngine(m, d.get());
  constexpr mjtByte kMet[mjNGROUP] = {0, 0, 0, 0, 1, 1};
  const mjtNum from[3] = {x_m, y_m, 1}, down[3] = {0, 0, -1};
  int geom = -1;
  return 1 - mj_ray(m, d.get(), from, down, kMet, 1, -1, &geom, nullptr);
}

Site SiteOf(const std::string& hazards) {
  std::string rows;
  for (int i = 0; i < 6; ++i) rows += "    ..........\n";
  return ReadSite(
      ParseYaml("site: 1\ngrid:\n  cell_m: 1\n  rows: |\n" + rows + "hazards:\n" + hazards,
                "site.yaml"),
      {});
}

TEST(LaidOnEachOther, EachIsAsHighAsItSaysOverWhatIsBeneath) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  for (const auto& [floor, below] : kFloors)
    for (const auto& [cover, above] : kCovers)
      for (const bool cover_first : {false, true}) {
        SCOPED_TRACE(cover + " on " + floor + (cover_first ? ", written before it" : ""));
        const std::string a = fmt::format("  - {{id: below, {}, {}}}\n", below.keys, Polygon(true));
        const std::string b =
            fmt::format("  - {{id: above, {}, {}}}\n", above.keys,
                        above.line ? "line_m: [[1.5, 2.5], [4.5, 2.5]]"
                                   : "polygon_m: [[1.5, 2.2], [4.5, 2.2], [4.5, 2.8], [1.5, 2.8]]");
        const Site site = SiteOf(cover_first ? b + a : a + b);
        const Scene scene = BuildScene(site.map, robot, {}, Pose2{8, 3, 0});
        // A rug takes nothing off a groove's depth.
        const double on_m = cover == "groove" && floor == "rug" ? 0 : below.height_m;
        EXPECT_NEAR(FloorAt(scene, 3, 2.5), on_m + above.height_m, 1e-6);
        EXPECT_NEAR(FloorAt(scene, 3, 1.5), below.height_m, 1e-6) << "beside it";
        EXPECT_NEAR(FloorAt(scene, 7, 2.5), 0, 1e-6) << "elsewhere";
      }
}

// A strip that leads over the edge lies on both floors.
TEST(LaidOnEachOther, AcrossAnEdgeEachPartLiesOnItsOwnFloor) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  for (const auto& [cover, above] : kCovers) {
    if (!above.line) continue;
    for (const bool cover_first : {false, true}) {
      SCOPED_TRACE(cover);
      const std::string a =
          fmt::format("  - {{id: below, type: step, height_m: 0.1, {}}}\n", Polygon(true));
      const std::string b =
          fmt::format("  - {{id: above, {}, line_m: [[3, 2.5], [7, 2.5]]}}\n", above.keys);
      const Scene scene =
          BuildScene(SiteOf(cover_first ? b + a : a + b).map, robot, {}, Pose2{8, 4.5, 0});
      EXPECT_NEAR(FloorAt(scene, 4, 2.5), 0.1 + above.height_m, 1e-6);
      EXPECT_NEAR(FloorAt(scene, 6, 2.5), above.height_m, 1e-6);
    }
  }
}

}  // namespace
}  // namespace floorproof
