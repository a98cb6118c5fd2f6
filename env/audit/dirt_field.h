// SPDX-License-Identifier: Apache-2.0
// Dirt on a floor, particle by particle: millions of them, found by place.
#pragma once

#include <cstdint>
#include <vector>

#include "base/params.h"
#include "env/core/hazard_map.h"

namespace floorproof {

struct Particle {
  Vec2 p_W = Vec2::Zero();  // its middle, m
  double diameter_m = 0;
};

// The particles in bins: each is a cell of the map, or a square part of one, so it is all floor or
// all wall. A particle takes 6 bytes: its place in its bin, in steps of less than 1 um, and its
// diameter in um, up to 65 mm. Results do not depend on how the memory came to be laid out: within
// a bin, particles stay in the order in which they were laid.
class DirtField {
 public:
  // The floor of this map, clean: any cell that is not wall. Hazards do not count.
  explicit DirtField(const HazardMap& map);

  // Of the bins. Frame G is the map's own.
  const GridFrame& frame() const { return frame_; }
  bool IsFloor(int ix, int iy) const { return floor_.Inside(ix, iy) && floor_(ix, iy); }
  bool IsFloor(const Vec2& p_W) const { return IsFloorInGrid(frame_.ToGrid(p_W)); }
  bool IsFloorInGrid(const Vec2& p_G) const;
  double floor_m2() const;
  std::int64_t size() const { return size_; }

  // Lays one down; false, and nothing is laid, where there is no floor.
  bool Lay(const Particle& particle) {
    return LayInGrid(frame_.ToGrid(particle.p_W), particle.diameter_m);
  }
  bool LayInGrid(const Vec2& p_G, double diameter_m);
  // Memory for so many more in this bin.
  void Reserve(int ix, int iy, std::size_t more);

  // Bin by bin, row by row from the lowest.
  std::vector<Particle> All() const;
  std::int64_t CountIn(int ix, int iy) const {
    return static_cast<std::int64_t>(bins_(ix, iy).size());
  }
  // Asks takes(p_G, diameter_m) of each particle of the bin, in order and once, and removes those
  // of which it says true. O(particles in the bin). It must not change the field.
  template <class Takes>
  void TakeIf(int ix, int iy, const Takes& takes) {
    std::vector<Speck>& bin = bins_(ix, iy);
    std::size_t kept = 0;
    for (const Speck& speck : bin)
      if (!takes(Place(ix, iy, speck), speck.diameter_um * 1e-6)) bin[kept++] = speck;
    size_ -= static_cast<std::int64_t>(bin.size() - kept);
    bin.resize(kept);
  }

 private:
  struct Speck {
    std::uint16_t x = 0, y = 0, diameter_um = 0;
  };
  static constexpr double kSteps = 65536;  // across a bin

  // The middle of its step: never on a bin's border, so rounding puts nothing into a wall.
  Vec2 Place(int ix, int iy, const Speck& speck) const {
    return frame_.cell_m * Vec2(ix + (speck.x + 0.5) / kSteps, iy + (speck.y + 0.5) / kSteps);
  }

  GridFrame frame_;
  Grid<std::uint8_t> floor_;
  Grid<std::vector<Speck>> bins_;
  std::int64_t size_ = 0;
};

// How much dirt lies where, before anybody cleans:
//   density(p) = density_per_m2 + wall_density_per_m2 * 2 w(p)
// w(p) is the share of what surrounds p that is wall, weighted by a bell of standard deviation
// reach_m: 0 in the open, 1/2 at a straight wall, 3/4 in a corner. So a corner holds half as much
// again as a wall. That walls and corners gather dirt is the audit paper's ("the natural tendency
// of dirt accumulation", section 4); this law is an assumption of ours. It needs no corner
// detector, which would see one in every step of a slanted wall that is drawn in cells.
struct DirtParams {
  // 32 particles below a tape of 4 cm2. The paper states no density; this one is chosen together
  // with CleaningParams (env/audit/brush.h).
  double density_per_m2 = 80'000;
  double wall_density_per_m2 = 0;  // the paper's trials began with an even floor (section 6.1)
  double reach_m = 0.1;            // a third of a robot's width: what its brush leaves at a wall
  double least_diameter_m = 0.0005, most_diameter_m = 0.001;  // tea powder (section 6.1)
  void Visit(ParamVisitor& v);
};

inline constexpr std::int64_t kMostParticles = 100'000'000;  // 600 MB

// How many particles LayDirt lays, before they are rounded to a number. O(bins).
double ExpectedParticles(const HazardMap& map, const DirtParams& params);

// Lays dirt on the whole floor of the map, all of it by chance: places by the density above, which
// is taken as even within a bin; diameters evenly between the two. The number is the density's sum
// over the floor, rounded. Draws from Stream(seed, 0, "dirt"). O(particles + bins). Throws
// InputError on a density or diameter that is negative or not finite, a least diameter above the
// most, and more than kMostParticles.
DirtField LayDirt(const HazardMap& map, const DirtParams& params, std::uint64_t seed);

}  // namespace floorproof
