// SPDX-License-Identifier: Apache-2.0
// The compiled scene against the site as it is written: at any place the height that the hazards'
// list says there, and of each hazard the volume that the map holds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/streams.h"
#include "env/hazards/strip.h"
#include "env/map/site.h"
#include "env/scene/scene.h"
#include "tests/hazards/make_hazard.h"
#include "tests/scene/surface_at.h"

namespace floorproof {
namespace {

// An entry of the list, and what it makes of the floor, told anew from the page on sites.
struct Entry {
  std::string yaml;
  enum class Kind { kStep, kGroove, kCover, kBumps } kind;
  std::vector<Vec2> place;  // the outline, or the line
  std::vector<Polygon> outlines;
  double width_m = 0, top_m = 0, height_m = 0;
  std::vector<Solid> bumps;  // upright frustums on squares

  bool Holds(const Vec2& p) const {
    return std::ranges::any_of(outlines, [&](const Polygon& o) { return Contains(o, p); });
  }
  // Of what lies here, over its floor; 0 beside it.
  double Rise(const Vec2& p) const {
    double rise_m = 0;
    const auto taper = [&](double foot_m, double roof_m, double off_m, double high_m) {
      if (off_m < foot_m)
        rise_m = std::max(rise_m, high_m * std::min(1.0, (foot_m - off_m) / (foot_m - roof_m)));
    };
    if (kind == Kind::kCover)
      for (std::size_t i = 0; i < outlines.size(); ++i) {
        const Vec2 along = (place[i + 1] - place[i]).normalized();
        if (Contains(outlines[i], p))
          taper(width_m / 2, top_m / 2, std::abs(Cross(along, p - place[i])), height_m);
      }
    for (const Solid& bump : bumps) {
      const Vec2 middle = (bump.base[0] + bump.base[2]) / 2;
      taper(bump.base[2].x() - middle.x(), bump.top[2].x() - middle.x(),
            (p - middle).cwiseAbs().maxCoeff(), bump.z_high_m);
    }
    return rise_m;
  }
  double ToBorder(const Vec2& p) const {
    double least_m = 1e9;
    for (const Polygon& o : outlines) least_m = std::min(least_m, std::abs(SignedDistance(o, p)));
    for (const Solid& b : bumps) least_m = std::min(least_m, std::abs(SignedDistance(b.base, p)));
    return least_m;
  }
};

// Of steps the later one wins. On them lies terrain, as a bridge over a groove before it; a groove
// is cut into them.
double HeightAt(const std::vector<Entry>& list, const Vec2& p) {
  double level_m = 0;
  for (const Entry& entry : list)
    if (entry.kind == Entry::Kind::kStep && entry.Holds(p)) level_m = entry.height_m;
  double ground_m = level_m, terrain_m = -1e9;
  for (const Entry& entry : list) {
    if (entry.kind == Entry::Kind::kCover || entry.kind == Entry::Kind::kBumps) {
      const double rise_m = entry.Rise(p);
      if (rise_m > 0) terrain_m = std::max(terrain_m, level_m + rise_m);
    } else if (entry.kind == Entry::Kind::kGroove && entry.Holds(p)) {
      ground_m = level_m + entry.height_m;
      terrain_m = -1e9;
    }
  }
  return std::max(ground_m, terrain_m);
}

std::string Listed(const std::vector<Vec2>& place) {
  std::string text = "[";
  for (const Vec2& p : place) text += fmt::format("[{}, {}],", p.x(), p.y());
  text.back() = ']';
  return text;
}

// A regular polygon, a star, or a rectangle, around 0.
Polygon RandomOutline(Stream& draws, bool neat) {
  if (neat || draws.Below(4) == 0) {
    const double least_m = neat ? 0.05 : 0.01;
    const Vec2 half(draws.Uniform(least_m, 0.8), draws.Uniform(least_m, 0.8));
    return Rectangle(-half, half);
  }
  const int corners = 3 + static_cast<int>(draws.Below(6));
  const bool star = draws.Below(4) == 0;
  Polygon outline = RegularPolygon(Vec2::Zero(), draws.Uniform(0.1, 1), star ? 10 : corners);
  for (std::size_t i = 1; star && i < outline.size(); i += 2) outline[i] *= 0.5;
  return outline;
}

// With `neat`, on a raster of 5 cm and square to it, so that borders lie on one another.
Entry RandomEntry(Stream& draws, bool neat) {
  Entry entry;
  const double x_m = draws.Uniform(3.3, 4.7), y_m = draws.Uniform(3.3, 4.7);
  const Pose2 X{x_m, y_m, neat ? 0 : draws.Uniform(-kPi, kPi)};
  const std::uint64_t kind = draws.Below(8);
  entry.kind = kind < 3   ? Entry::Kind::kStep
               : kind < 4 ? Entry::Kind::kGroove
               : kind < 7 ? Entry::Kind::kCover
                          : Entry::Kind::kBumps;
  const bool outlined = entry.kind == Entry::Kind::kStep || entry.kind == Entry::Kind::kBumps;
  if (outlined) {
    entry.place = RandomOutline(draws, neat);
  } else {
    entry.place = {{-draws.Uniform(0.3, 1.5), 0}, {draws.Uniform(0.3, 1.5), 0}};
    if (draws.Below(3) == 0) entry.place.emplace_back(entry.place[1].x(), draws.Uniform(0.3, 1));
  }
  for (Vec2& p : entry.place) {
    p = X * p;
    if (neat) p = (p * 20).array().round() / 20;
  }
  entry.height_m = draws.Uniform(0.005, 0.05);
  entry.width_m = neat ? 0.1 : draws.Uniform(0.02, 0.15);
  entry.top_m = draws.Uniform(0.1, 0.9) * entry.width_m;
  entry.outlines = outlined ? std::vector<Polygon>{entry.place}
                            : StripAlong(entry.place, entry.width_m, "width_m");
  const std::string place = (outlined ? "polygon_m: " : "line_m: ") + Listed(entry.place);
  switch (entry.kind) {
    case Entry::Kind::kStep:
      if (draws.Below(2) == 0) entry.height_m *= -1;
      entry.yaml = fmt::format("{{type: step, height_m: {}, {}}}", entry.height_m, place);
      break;
    case Entry::Kind::kGroove:
      entry.yaml = fmt::format("{{type: groove, width_m: {}, depth_m: {}, {}}}", entry.width_m,
                               entry.height_m, place);
      entry.height_m *= -1;
      break;
    case Entry::Kind::kCover:
      entry.yaml =
          fmt::format("{{type: cable_cover, width_m: {}, top_width_m: {}, height_m: {}, {}}}",
                      entry.width_m, entry.top_m, entry.height_m, place);
      break;
    case Entry::Kind::kBumps:
      const std::string keys =
          fmt::format("amplitude_m: {}, wavelength_m: {}", entry.height_m, 0.05 + entry.width_m);
      entry.yaml = fmt::format("{{type: rough, {}, {}}}", keys, place);
      entry.bumps = MakeOf("rough", "{" + keys + "}", entry.place).solids;
  }
  return entry;
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

struct Built {
  HazardMap map;
  Scene scene;
  DataPtr data;
  explicit Built(const std::string& yaml)
      : map(ReadSite(ParseYaml(yaml, "site"), ".").map),
        scene(BuildScene(map, ReadRobot(FindRobotFile("beluga", {})), {}, {0.6, 0.6, 0})),
        data(MakeData(scene.model.get())) {
    ForwardEngine(scene.model.get(), data.get());
  }
};

const std::string kRoom = "site: 1\ngrid: {cell_m: 8, inset_m: 0, rows: \".\"}\nhazards:\n";

// By how much the scene is off the list at worst, in a raster and over each cover, but for what
// lies within 1 mm of a border.
double WorstError(const std::vector<Entry>& list, const Built& dut, Stream& draws, Vec2& where) {
  double worst_m = 0;
  int seen = 0;
  const auto look = [&](const Vec2& p) {
    for (const Entry& entry : list)
      if (entry.ToBorder(p) < 1e-3) return;
    ++seen;
    const double off_m = std::abs(SurfaceAt(dut.scene, dut.data.get(), p) - HeightAt(list, p));
    if (off_m > worst_m) worst_m = off_m, where = p;
  };
  constexpr double kRaster_m = 0.08;
  for (double x = 1.2; x < 6.8; x += kRaster_m)
    for (double y = 1.2; y < 6.8; y += kRaster_m)
      look({x + draws.Uniform(0, kRaster_m), y + draws.Uniform(0, kRaster_m)});
  for (const Entry& entry : list)
    for (int k = 0; entry.kind == Entry::Kind::kCover && k < 300; ++k) {
      const std::size_t i = draws.Below(entry.outlines.size());
      const Vec2 way = entry.place[i + 1] - entry.place[i], left(-way.y(), way.x());
      const double along = draws.Uniform(), across = draws.Uniform(-0.5, 0.5);
      look(entry.place[i] + along * way + across * entry.width_m * left.normalized());
    }
  EXPECT_GT(seen, 1000);
  return worst_m;
}

TEST(LaidFloor, TheSceneHasTheHeightsOfTheList) {
  Stream draws(7, 0, "floors");
  for (int site = 0; site < 60; ++site) {
    std::vector<Entry> list;
    std::string yaml = kRoom;
    for (std::uint64_t i = 0, n = 2 + draws.Below(5); i < n; ++i) {
      list.push_back(RandomEntry(draws, site % 3 == 0));
      yaml += "- " + list.back().yaml + "\n";
    }
    const Built dut(yaml);
    Vec2 where = Vec2::Zero();
    EXPECT_LT(WorstError(list, dut, draws, where), 3e-4) << where.transpose() << "\n" << yaml;
    for (std::size_t h = 0; h < dut.map.hazards.size(); ++h) {
      Hazard prisms = dut.map.hazards[h];
      std::erase_if(prisms.solids, [](const Solid& s) { return s.kind == Solid::Kind::kCut; });
      double built = 0;
      for (int g = 0; g < dut.scene.model->ngeom; ++g) {
        const GeomRole& role = dut.scene.roles[static_cast<std::size_t>(g)];
        if (role.kind == GeomRole::Kind::kHazard && role.hazard == static_cast<int>(h))
          built += VolumeOf(dut.scene.model.get(), g);
      }
      EXPECT_NEAR(built, Volume(prisms), 1e-6 + 1e-3 * Volume(prisms)) << yaml;
    }
  }
}

// A drawn platform and pit begin as far within their cells as they are drawn back: there the cover
// leaves the base floor, and not at the cells' border.
TEST(LaidFloor, ACoverLiesOnDrawnFloorsAsTheyAreBuilt) {
  const Built dut(
      "site: 1\ngrid: {cell_m: 1, inset_m: 0.1, rows: \"......\\n..^v..\\n......\",\n"
      "  sizes: {raised: {height_m: 0.05}, drop: {height_m: -0.05}}}\n"
      "hazards: [{type: cable_cover, line_m: [[1, 1.5], [5, 1.5]], height_m: 0.02}]\n");
  const auto at = [&](double x_m) { return SurfaceAt(dut.scene, dut.data.get(), {x_m, 1.5}); };
  EXPECT_NEAR(at(1.95), 0.02, 1e-4);
  EXPECT_NEAR(at(2.05), 0.02, 1e-4);
  EXPECT_NEAR(at(2.15), 0.07, 1e-4);
  EXPECT_NEAR(at(3.5), -0.03, 1e-4);
  EXPECT_NEAR(at(3.95), 0.02, 1e-4);
}

}  // namespace
}  // namespace floorproof
