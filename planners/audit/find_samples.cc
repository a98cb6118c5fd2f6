// SPDX-License-Identifier: Apache-2.0
// The paper gives neither the intervals, which it calls proportional to the robot's footprint, nor
// R_b, R_c and the number of random places. Chosen here: one robot's width between places, and
// distances by which at least one row of them lies along each wall, however it falls on the
// lattice.
#include "planners/audit/find_samples.h"

#include <algorithm>
#include <cmath>

#include "base/streams.h"
#include "env/geometry/distance.h"
#include "planners/audit/features.h"

namespace floorproof {
namespace {

constexpr std::size_t kEvery = 2;  // cells between the points of the boundary that are measured to

// The intervals in cells, and the first column and row.
struct Lattice {
  int du, dv, x0, y0;
};

// The paper does not say where its lattice lies. Here it lies so that the robot reaches as many of
// the places as it can, and as few as can be are out of its reach. Of equals, the first.
Lattice PlaceLattice(const Room& room, const Grid<float>& reach, int du, int dv) {
  // From the room's own edge: where a map begins must make no difference.
  int x0 = reach.width, y0 = reach.height;
  for (int iy = 0; iy < reach.height; ++iy)
    for (int ix = 0; ix < reach.width; ++ix)
      if (room.inside(ix, iy)) x0 = std::min(x0, ix), y0 = std::min(y0, iy);
  Grid<int> score(du, dv);
  for (int iy = y0; iy < reach.height; ++iy)
    for (int ix = x0; ix < reach.width; ++ix)
      if (room.inside(ix, iy)) score((ix - x0) % du, (iy - y0) % dv) += reach(ix, iy) > 0 ? 1 : -1;
  const auto best = static_cast<int>(std::ranges::max_element(score.cells) - score.cells.begin());
  return {du, dv, x0 + best % du, y0 + best / du};
}

// add(p_C): a point drawn from each du x dv of the grid, which lie around the lattice's cells, in
// cells. Some begin before the grid, where its first rows and columns would else be in none.
template <class Add>
void Jitter(const Lattice& lattice, int width, int height, std::uint64_t seed, const Add& add) {
  Stream random(seed, 0, "audit_jitter");
  const auto first = [](int origin, int interval) {  // in (-interval, 0]
    const int before = (origin - interval / 2) % interval;
    return before > 0 ? before - interval : before;
  };
  for (int y = first(lattice.y0, lattice.dv); y < height; y += lattice.dv)
    for (int x = first(lattice.x0, lattice.du); x < width; x += lattice.du) {
      const double u = random.Uniform(), v = random.Uniform();
      add(Vec2(x + lattice.du * u, y + lattice.dv * v));
    }
}

// Distance to the nearest of these cells, which may lie off the grid by one, in cells.
Grid<float> DistanceTo(const std::vector<Cell>& cells, std::size_t every, int width, int height) {
  Grid<std::uint8_t> set(width + 2, height + 2);
  for (std::size_t i = 0; i < cells.size(); i += every) set(cells[i].ix + 1, cells[i].iy + 1) = 1;
  return DistanceToCentres(set);
}

bool OneColour(const Grid<std::uint8_t>& pixels) {
  return std::ranges::all_of(pixels.cells, [&](auto p) { return p == pixels.cells.front(); });
}

}  // namespace

void SampleParams::Visit(ParamVisitor& visit) {
  const Bounds interval = AtLeast(0.05);
  visit("du_m", du_m, interval,
        "along a row of the map, from place to place; none: the robot's width");
  visit("dv_m", dv_m, interval, "along a column; none: du_m");
  visit("boundary_m", boundary_m, Positive(),
        "R_b: of the room's boundary; none: half the robot's width and the longer interval");
  visit("corner_m", corner_m, Positive(), "R_c: of a sharp corner; none: boundary_m");
  visit("random_share", random_share, Between(0, 1),
        "of the places on the rest of the floor, at least one of them unless it is 0");
  visit("jitter", jitter,
        "each place lies by chance in its du x dv of the lattice: then the score of the floor near "
        "walls has an interval");
}

FoundSamples FindSamples(const Room& room, const Grid<float>& reach, double width_m,
                         const SampleParams& params, std::uint64_t seed) {
  FoundSamples found;
  if (OneColour(room.pixels)) {
    found.why = "the map is free all over: it has no walls and corners to sample at";
    return found;
  }
  const std::vector<Cell> boundary = BoundaryOf(room);
  if (boundary.empty()) {
    found.why = "no contour was found that could be the room's boundary";
    return found;
  }
  for (const Cell c : boundary) found.boundary_W.push_back(room.frame.Center(c));
  const double cell_m = room.frame.cell_m;
  const double du_m = params.du_m.value_or(width_m), dv_m = params.dv_m.value_or(du_m);
  const double boundary_m = params.boundary_m.value_or(width_m / 2 + std::max(du_m, dv_m));
  const double corner_m = params.corner_m.value_or(boundary_m);
  const int width = room.inside.width, height = room.inside.height;
  const Grid<float> to_boundary = DistanceTo(boundary, kEvery, width, height);
  const Grid<float> to_corner = DistanceTo(CornersOf(room), 1, width, height);

  const auto within = [cell_m](float cells, double limit_m) {
    return static_cast<double>(cells) * cell_m < limit_m;
  };
  const auto kinds_at = [&](int ix, int iy) {
    return SampleKinds{.boundary = within(to_boundary(ix + 1, iy + 1), boundary_m),
                       .corner = within(to_corner(ix + 1, iy + 1), corner_m)};
  };
  double inside = 0, near_walls = 0, elsewhere = 0;  // cells
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix) {
      if (!room.inside(ix, iy)) continue;
      ++inside;
      const auto reached = static_cast<double>(reach(ix, iy));
      (kinds_at(ix, iy).near_walls() ? near_walls : elsewhere) += reached;
    }
  const double whole = std::max(inside, 1.0);
  found.parts = {near_walls / whole, elsewhere / whole, params.jitter};

  const auto cells = [&](double interval_m) {
    const double most = std::max(width, height);  // one place in the lattice then
    return std::max(1, static_cast<int>(std::lround(std::min(interval_m / cell_m, most))));
  };
  const Lattice lattice = PlaceLattice(room, reach, cells(du_m), cells(dv_m));
  std::vector<SamplePlace> rest;
  const auto add = [&](const Vec2& p_C) {
    const int ix = static_cast<int>(std::floor(p_C.x())),
              iy = static_cast<int>(std::floor(p_C.y()));
    if (!room.inside.Inside(ix, iy) || !room.inside(ix, iy)) return;
    ++found.general;
    SamplePlace place;
    place.p_W = room.frame.X_WG * (cell_m * p_C);
    place.kinds = kinds_at(ix, iy);
    found.boundary += place.kinds.boundary;
    found.corner += place.kinds.corner;
    (place.kinds.near_walls() ? found.places : rest).push_back(place);
  };
  if (params.jitter)
    Jitter(lattice, width, height, seed, add);
  else
    for (int iy = lattice.y0; iy < height; iy += lattice.dv)
      for (int ix = lattice.x0; ix < width; ix += lattice.du) add(Vec2(ix + 0.5, iy + 0.5));
  Stream random(seed, 0, "audit_samples");
  const auto wanted =
      static_cast<std::size_t>(std::ceil(params.random_share * static_cast<double>(rest.size())));
  for (std::size_t i = 0; i < wanted; ++i) {
    std::swap(rest[i], rest[i + random.Below(rest.size() - i)]);
    rest[i].kinds.random = true;
    found.places.push_back(rest[i]);
  }
  found.random = static_cast<int>(wanted);
  const Pose2 X_GW = room.frame.X_WG.Inverse();
  std::ranges::stable_sort(found.places, [&](const SamplePlace& a, const SamplePlace& b) {
    const Vec2 p = X_GW * a.p_W, q = X_GW * b.p_W;
    const auto row = [cell_m](const Vec2& at) { return std::lround(at.y() / cell_m - 0.5); };
    return row(p) != row(q) ? row(p) < row(q) : p.x() < q.x();
  });
  return found;
}

}  // namespace floorproof
