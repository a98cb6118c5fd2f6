// SPDX-License-Identifier: Apache-2.0
// Every hazard that shapes the floor, laid on every other, in either order of the file: how high
// the floor is then, by rays through the built scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "base/config.h"
#include "env/map/site.h"
#include "env/scene/robot_model.h"
#include "env/scene/scene.h"
#include "tests/scene/surface_at.h"

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
    {"threshold", {"type: threshold, height_m: 0.018, bevel: 0, width_m: 0.6", 0.018, true}},
    {"cable_cover",
     {"type: cable_cover, height_m: 0.02, width_m: 0.6, top_width_m: 0.4", 0.02, true}},
    {"groove", {"type: groove, depth_m: 0.03, width_m: 0.6", -0.03, true}},
};

Site SiteOf(const std::string& hazards) {
  std::string rows;
  for (int i = 0; i < 6; ++i) rows += "    ..........\n";
  return ReadSite(
      ParseYaml("site: 1\ngrid:\n  cell_m: 1\n  rows: |\n" + rows + "hazards:\n" + hazards,
                "site.yaml"),
      {});
}

// A site's scene, with a robot out of the way.
struct Built {
  explicit Built(const Site& site)
      : robot(ReadRobot(FindRobotFile("beluga", {}))),
        scene(BuildScene(site.map, robot, {}, Pose2{8, 4.5, 0})),
        data(MakeData(scene.model.get())) {
    ForwardEngine(scene.model.get(), data.get());
  }
  double At(double x_m, double y_m) const { return SurfaceAt(scene, data.get(), {x_m, y_m}); }
  RobotModel robot;
  Scene scene;
  DataPtr data;
};

TEST(LaidOnEachOther, EachIsAsHighAsItSaysOverWhatIsBeneath) {
  for (const auto& [floor, below] : kFloors)
    for (const auto& [cover, above] : kCovers)
      for (const bool cover_first : {false, true}) {
        SCOPED_TRACE(cover + " on " + floor + (cover_first ? ", written before it" : ""));
        const std::string a = fmt::format("  - {{id: below, {}, {}}}\n", below.keys, Polygon(true));
        const std::string b =
            fmt::format("  - {{id: above, {}, {}}}\n", above.keys,
                        above.line ? "line_m: [[1.5, 2.5], [4.5, 2.5]]"
                                   : "polygon_m: [[1.5, 2.2], [4.5, 2.2], [4.5, 2.8], [1.5, 2.8]]");
        const Built dut(SiteOf(cover_first ? b + a : a + b));
        // A rug takes nothing off a groove's depth.
        const double on_m = cover == "groove" && floor == "rug" ? 0 : below.height_m;
        EXPECT_NEAR(dut.At(3, 2.5), on_m + above.height_m, 1e-6);
        EXPECT_NEAR(dut.At(3, 1.5), below.height_m, 1e-6) << "beside it";
        EXPECT_NEAR(dut.At(7, 2.5), 0, 1e-6) << "elsewhere";
      }
}

// A strip that leads over the edge lies on both floors.
TEST(LaidOnEachOther, AcrossAnEdgeEachPartLiesOnItsOwnFloor) {
  for (const auto& [cover, above] : kCovers) {
    if (!above.line) continue;
    for (const bool cover_first : {false, true}) {
      SCOPED_TRACE(cover);
      const std::string a =
          fmt::format("  - {{id: below, type: step, height_m: 0.1, {}}}\n", Polygon(true));
      const std::string b =
          fmt::format("  - {{id: above, {}, line_m: [[3, 2.5], [7, 2.5]]}}\n", above.keys);
      const Built dut(SiteOf(cover_first ? b + a : a + b));
      EXPECT_NEAR(dut.At(4, 2.5), 0.1 + above.height_m, 1e-6);
      EXPECT_NEAR(dut.At(6, 2.5), above.height_m, 1e-6);
    }
  }
}

}  // namespace
}  // namespace floorproof
