// SPDX-License-Identifier: Apache-2.0
// Rough ground (C4 of the hTetro FMEA paper, Table 1): cobbles, a coarse mat, broken tiles.
//
// Bumps stand on a square lattice of pitch wavelength_m. The lattice is fixed to the world, so
// areas that touch share it. Each bump is a frustum of a square pyramid, 0.9 pitch wide at the
// floor and half that on top, so its flanks are ramps and not kerbs. Heights are uniform in [0.3,
// 1] amplitude_m and hashed from the bump's place in the lattice: the floor is the same on every
// run. A height profile therefore has one dominant wavelength, and amplitude_m as its highest
// point. Bumps that would cross the polygon's border are left out. No source gives spectra of
// indoor floors, so these numbers are assumptions.
#include <cmath>
#include <cstdint>

#include "env/geometry/box.h"
#include "env/hazards/hazard_type.h"
#include "env/hazards/robot_scale.h"

namespace floorproof {
namespace {

constexpr int kMaxBumps = 2000;  // each is a geom of its own in the scene
constexpr double kBaseShare = 0.9, kTopShare = 0.45, kLowest = 0.3;

// Uniform in [0, 1), from a lattice place (SplitMix64's finaliser).
double Hash(std::int64_t i, std::int64_t j) {
  auto z = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15U +
           static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fU;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

class Rough : public HazardType {
 public:
  void Visit(ParamVisitor& v) override {
    v("amplitude_m", amplitude_m_, Between(kLeastSize_m, 0.2),
      "height of the highest bump over the floor");
    v("wavelength_m", wavelength_m_, {0.01, 2, false}, "distance from bump to bump");
  }
  Placement placement() const override { return Placement::kPolygon; }

  std::vector<KeyRange> Ranges(const RobotSpec& robot) const override {
    const double most_m = 1.5 * EdgeScale(robot, "rough");  // its bumps are ramps
    return {{"amplitude_m", {{most_m / 20, most_m}}, true}, {"wavelength_m", {{0.06, 0.2}}}};
  }

  Hazard Make(const std::vector<Vec2>& place) const override {
    Hazard hazard;
    hazard.hazard_class = HazardClass::kTerrain;
    hazard.footprint = {place};
    hazard.height_m = amplitude_m_;
    // Robots turn on it, too, and start from between its bumps, which takes more than the ladder's
    // straight drive: an assumption.
    constexpr double kStraightShare = 0.8;
    hazard.sizes = {{{"rough", amplitude_m_ / kStraightShare}}};
    hazard.solids = Bumps(place);
    hazard.material.rgba = {0.50f, 0.48f, 0.44f, 1.0f};
    return hazard;
  }

 private:
  std::vector<Solid> Bumps(const Polygon& place) const {
    const auto [low, high] = BoxAround(place);
    const double bumps = std::abs(SignedArea(place)) / (wavelength_m_ * wavelength_m_);
    // The second bound keeps the search below short in a polygon that is mostly empty box.
    if (bumps > kMaxBumps || (high - low).prod() / (wavelength_m_ * wavelength_m_) > 1e6)
      throw InputError({}, "wavelength_m", FormatDouble(wavelength_m_),
                       "gives more than " + std::to_string(kMaxBumps) +
                           " bumps on this area; take a longer one or a smaller area");
    std::vector<Solid> solids;
    const auto first = [&](double v) {
      return static_cast<std::int64_t>(std::floor(v / wavelength_m_));
    };
    for (std::int64_t j = first(low.y()); j <= first(high.y()); ++j)
      for (std::int64_t i = first(low.x()); i <= first(high.x()); ++i) {
        const Vec2 center =
            wavelength_m_ * Vec2(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
        const Polygon base = Square(center, kBaseShare * wavelength_m_ / 2);
        const double depth = -SignedDistance(place, center);
        const bool deep_inside = depth > kBaseShare * wavelength_m_ / std::sqrt(2.0);
        if (depth < 0 || (!deep_inside && !HoldsSquare(place, base))) continue;
        const double height = amplitude_m_ * (kLowest + (1 - kLowest) * Hash(i, j));
        solids.push_back(
            {Solid::Kind::kPrism, base, Square(center, kTopShare * wavelength_m_ / 2), 0, height});
      }
    return solids;
  }

  static Polygon Square(const Vec2& center, double half) {
    return Rectangle(center - Vec2(half, half), center + Vec2(half, half));
  }
  static bool HoldsSquare(const Polygon& place, const Polygon& square) {
    const double whole = std::abs(SignedArea(square));
    return Area(Intersection({{square, {}}}, {place})) > whole * (1 - 1e-9);
  }

  double amplitude_m_ = 0.005;
  double wavelength_m_ = 0.1;
};

}  // namespace

FP_DEFINE_PLUGIN(HazardType, Rough)

}  // namespace floorproof
