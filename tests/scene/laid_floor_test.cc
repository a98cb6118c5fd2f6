// SPDX-License-Identifier: Apache-2.0
// The compiled scene against the site as it is written: at any place the height that the hazards'
// list says there, and of each hazard the volume that the map holds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/streams.h"
#include "env/map/site.h"
#include "env/scene/scene.h"
#include "tests/hazards/make_hazard.h"

namespace floorproof {
namespace {

// An entry of the list, and what it makes of the floor, told anew from the page on sites.
struct Entry {
  std::string yaml;
  enum class Kind { kStep, kGroove, kCover } kind;
  Polygon outline;  // kStep
  Vec2 from, to;    // else
  double width_m, top_m, height_m;

  double Across(const Vec2& p) const {
    const Vec2 along = (to - from).normalized();
    return std::abs(Cross(along, p - from));
  }
  bool Holds(const Vec2& p) const {
    if (kind == Kind::kStep) return Contains(outline, p);
    const Vec2 way = to - from;
    const double along = (p - from).dot(way) / way.squaredNorm();
    return along >= 0 && along <= 1 && Across(p) <= width_m / 2;
  }
};

double HeightAt(const std::vector<Entry>& list, const Vec2& p) {
  double level_m = 0, ground_m = 0, terrain_m = -1e9;
  for (const Entry& entry : list) {
    if (!entry.Holds(p)) continue;
    if (entry.kind == Entry::Kind::kCover) {
      const double run_m = (entry.width_m - entry.top_m) / 2;
      const double share = std::min(1.0, (entry.width_m / 2 - entry.Across(p)) / run_m);
      terrain_m = std::max(terrain_m, level_m + share * entry.height_m);
      continue;
    }
    ground_m = entry.height_m;
    if (entry.kind == Entry::Kind::kStep) level_m = entry.height_m;
    terrain_m = -1e9;
  }
  return std::max(ground_m, terrain_m);
}

Entry RandomEntry(Stream& draws) {
  Entry entry;
  const Vec2 middle(draws.Uniform(1, 3), draws.Uniform(1, 3));
  const double yaw_rad = draws.Below(2) == 0 ? 0 : draws.Uniform(-kPi, kPi);
  const Pose2 X{middle.x(), middle.y(), yaw_rad};
  entry.kind = static_cast<Entry::Kind>(draws.Below(3));
  entry.from = X * Vec2(-draws.Uniform(0.3, 1), 0);
  entry.to = X * Vec2(draws.Uniform(0.3, 1), 0);
  const std::string line = fmt::format("line_m: [[{}, {}], [{}, {}]]", entry.from.x(),
                                       entry.from.y(), entry.to.x(), entry.to.y());
  entry.height_m = draws.Uniform(0.01, 0.05);
  entry.width_m = draws.Uniform(0.02, 0.15);
  entry.top_m = draws.Uniform(0.1, 0.9) * entry.width_m;
  switch (entry.kind) {
    case Entry::Kind::kStep:
      if (draws.Below(2) == 0) entry.height_m *= -1;
      entry.outline = Rectangle({-0.4, -0.3}, {0.4, 0.3});
      entry.yaml = fmt::format("{{type: step, height_m: {}, polygon_m: [", entry.height_m);
      for (Vec2& p : entry.outline) {
        p = X * p;
        entry.yaml += fmt::format("[{}, {}],", p.x(), p.y());
      }
      entry.yaml.back() = ']';
      entry.yaml += "}";
      break;
    case Entry::Kind::kGroove:
      entry.yaml = fmt::format("{{type: groove, width_m: {}, depth_m: {}, {}}}", entry.width_m,
                               entry.height_m, line);
      entry.height_m *= -1;
      break;
    case Entry::Kind::kCover:
      entry.yaml =
          fmt::format("{{type: cable_cover, width_m: {}, top_width_m: {}, height_m: {}, {}}}",
                      entry.width_m, entry.top_m, entry.height_m, line);
  }
  return entry;
}

double SurfaceAt(const Scene& scene, const mjData* data, const Vec2& p) {
  const mjtNum from[3] = {p.x(), p.y(), 1}, down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 0, 1, 1};
  int geom = -1;
  return 1 -
         mj_ray(scene.model.get(), data, from, down, groups, 1, scene.base_body, &geom, nullptr);
}

double VolumeOf(const mjModel* m, int geom) {
  if (m->geom_type[geom] == mjGEOM_BOX) {
    const mjtNum* s = m->geom_size + 3 * geom;
    return 8 * s[0] * s[1] * s[2];
  }
  const int mesh = m->geom_dataid[geom];
  const float* v = m->mesh_vert + 3 * m->mesh_vertadr[mesh];
  const auto at = [&](int i) { return Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
  double volume = 0;
  for (int f = 0; f < m->mesh_facenum[mesh]; ++f) {
    const int* face = m->mesh_face + 3 * (m->mesh_faceadr[mesh] + f);
    volume += at(face[0]).dot(at(face[1]).cross(at(face[2]))) / 6;
  }
  return volume;
}

TEST(LaidFloor, TheSceneHasTheHeightsOfTheList) {
  const RobotModel robot = ReadRobot(FindRobotFile("beluga", {}));
  Stream draws(7, 0, "floors");
  for (int site = 0; site < 40; ++site) {
    std::vector<Entry> list;
    std::string yaml =
        "site: 1\ngrid: {cell_m: 1, inset_m: 0, rows: \"....\\n....\\n....\\n....\"}\n"
        "hazards:\n";
    for (std::uint64_t i = 0, n = 2 + draws.Below(3); i < n; ++i) {
      list.push_back(RandomEntry(draws));
      yaml += "- " + list.back().yaml + "\n";
    }
    const HazardMap map = ReadSite(ParseYaml(yaml, "site"), ".").map;
    const Scene dut = BuildScene(map, robot, {}, {0.5, 0.5, 0});
    const DataPtr data = MakeData(dut.model.get());
    ForwardEngine(dut.model.get(), data.get());
    int seen = 0;
    for (int k = 0; k < 400; ++k) {
      const Vec2 p(draws.Uniform(0.3, 3.7), draws.Uniform(0.3, 3.7));
      if ((p - Vec2(0.5, 0.5)).norm() < 0.4) continue;  // the robot
      const double height_m = HeightAt(list, p);
      double low = height_m, high = height_m;  // around it: at edges a float's place decides
      for (const Vec2& d : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        low = std::min(low, HeightAt(list, p + 5e-4 * d));
        high = std::max(high, HeightAt(list, p + 5e-4 * d));
      }
      if (high - low > 4e-3) continue;
      ++seen;
      EXPECT_NEAR(SurfaceAt(dut, data.get(), p), height_m, 1e-4 + (high - low))
          << yaml << p.transpose();
    }
    EXPECT_GT(seen, 100);
    for (std::size_t h = 0; h < map.hazards.size(); ++h) {
      Hazard prisms = map.hazards[h];
      std::erase_if(prisms.solids, [](const Solid& s) { return s.kind == Solid::Kind::kCut; });
      double built = 0;
      for (int g = 0; g < dut.model->ngeom; ++g) {
        const GeomRole& role = dut.roles[static_cast<std::size_t>(g)];
        if (role.kind == GeomRole::Kind::kHazard && role.hazard == static_cast<int>(h))
          built += VolumeOf(dut.model.get(), g);
      }
      EXPECT_NEAR(built, Volume(prisms), 1e-6 + 1e-3 * Volume(prisms)) << yaml;
    }
  }
}

}  // namespace
}  // namespace floorproof
