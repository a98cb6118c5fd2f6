// SPDX-License-Identifier: Apache-2.0
// Particles are laid as a binomial process: their number is fixed, each falls by itself. First it
// is drawn how many fall into each bin, then where in it, so that memory is taken once and walked
// through in order.
//
// The bell that weighs the walls around a place is three moving averages, along rows and along
// columns (a B-spline: round to a few per cent). Its sums are whole numbers, so they are exact.
// Beyond the map all is wall. The bell's width is met to within a tenth, from two bins on.
#include "env/audit/dirt_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/streams.h"
#include "env/core/coverage.h"

namespace floorproof {
namespace {

// Half widths, in bins, of three moving averages whose variance is nearest to the bell's: an
// average over 2 r + 1 bins has the variance r (r + 1) / 3.
std::array<int, 3> HalfWidths(double sd_bins) {
  const auto variance = [](int r) { return r * (r + 1) / 3.0; };
  int r = 0;
  while (3 * variance(r + 1) <= sd_bins * sd_bins) ++r;
  const double missing = sd_bins * sd_bins - 3 * variance(r);
  const auto wider = std::lround(missing / (variance(r + 1) - variance(r)));
  return {r + (wider > 0), r + (wider > 1), r + (wider > 2)};
}

// The sum over 2 r + 1 values of a line, for each that is so far from its ends; the others are left
// as they are.
void SumAlong(std::size_t first, std::size_t stride, int length, int r, std::vector<double>& line,
              Grid<double>& grid) {
  line.clear();
  for (int i = 0; i < length; ++i)
    line.push_back(grid.cells[first + static_cast<std::size_t>(i) * stride]);
  double sum = 0;
  for (int i = 0; i < length; ++i) {
    sum += line[static_cast<std::size_t>(i)];
    if (i < 2 * r) continue;
    grid.cells[first + static_cast<std::size_t>(i - r) * stride] = sum;
    sum -= line[static_cast<std::size_t>(i - 2 * r)];
  }
}

// w of dirt_field.h, of each bin.
Grid<double> WallShare(const DirtField& field, double reach_m) {
  const GridFrame& frame = field.frame();
  const std::array<int, 3> half_widths = HalfWidths(reach_m / frame.cell_m);
  // Wall all around, so wide that what SumAlong leaves out at the ends is not asked for.
  const int around = half_widths[0] + half_widths[1] + half_widths[2];
  Grid<double> sums(frame.width + 2 * around, frame.height + 2 * around, 1);
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix)
      if (field.IsFloor(ix, iy)) sums(ix + around, iy + around) = 0;
  std::vector<double> line;
  double most = 1;
  for (const int r : half_widths) {
    const auto stride = static_cast<std::size_t>(sums.width);
    for (int iy = 0; iy < sums.height; ++iy)
      SumAlong(sums.Index(0, iy), 1, sums.width, r, line, sums);
    for (int ix = 0; ix < sums.width; ++ix)
      SumAlong(sums.Index(ix, 0), stride, sums.height, r, line, sums);
    most *= (2.0 * r + 1) * (2.0 * r + 1);
  }
  Grid<double> share(frame.width, frame.height);
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) share(ix, iy) = sums(ix + around, iy + around) / most;
  return share;
}

// Particles expected in all bins up to each, in the bins' order.
std::vector<double> Expected(const DirtField& field, const DirtParams& params) {
  const GridFrame& frame = field.frame();
  const double bin_m2 = frame.cell_m * frame.cell_m;
  Grid<double> share;
  if (params.wall_density_per_m2 > 0) share = WallShare(field, params.reach_m);
  std::vector<double> up_to;
  double sum = 0;
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      double density = params.density_per_m2;
      if (!share.cells.empty()) density += params.wall_density_per_m2 * 2 * share(ix, iy);
      if (field.IsFloor(ix, iy)) sum += density * bin_m2;
      up_to.push_back(sum);
    }
  return up_to;
}

void Check(const DirtParams& params) {
  const auto refuse_unless = [](bool right, const char* what) {
    if (!right) throw InputError(std::string("dirt: ") + what);
  };
  const auto is_some = [](double value) { return std::isfinite(value) && value >= 0; };
  refuse_unless(is_some(params.density_per_m2) && is_some(params.wall_density_per_m2),
                "a density must be >= 0");
  refuse_unless(params.reach_m > 0 && params.reach_m <= 1, "reach_m must be in (0, 1]");
  refuse_unless(params.least_diameter_m > 0 && params.most_diameter_m <= 0.065 &&
                    params.least_diameter_m <= params.most_diameter_m,
                "diameters must be > 0 and <= 0.065 m, the least not above the most");
}

}  // namespace

void DirtParams::Visit(ParamVisitor& v) {
  const Bounds density = Between(0, 1e15);  // far more than is laid, and sums stay finite
  v("density_per_m2", density_per_m2, density, "particles on a square metre of open floor");
  v("wall_density_per_m2", wall_density_per_m2, density,
    "particles that a square metre at a straight wall holds more");
  v("reach_m", reach_m, {0, 1, true}, "how far from walls they gather");
  v("least_diameter_m", least_diameter_m, {0, 0.065, true}, "of the smallest particles");
  v("most_diameter_m", most_diameter_m, {0, 0.065, true}, "of the largest particles");
}

DirtField::DirtField(const HazardMap& map)
    : frame_(FineFrame(map.frame)),
      floor_(frame_.width, frame_.height),
      bins_(frame_.width, frame_.height) {
  const int k = map.frame.width > 0 ? frame_.width / map.frame.width : 1;
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix) floor_(ix, iy) = !map.IsWall(ix / k, iy / k);
}

bool DirtField::IsFloorInGrid(const Vec2& p_G) const {
  const Vec2 p = p_G / frame_.cell_m;
  // Not a number is nowhere.
  if (!(p.x() >= 0 && p.y() >= 0 && p.x() < frame_.width && p.y() < frame_.height)) return false;
  return floor_(static_cast<int>(p.x()), static_cast<int>(p.y())) != 0;
}

double DirtField::floor_m2() const {
  const auto bins = std::count(floor_.cells.begin(), floor_.cells.end(), std::uint8_t{1});
  return static_cast<double>(bins) * frame_.cell_m * frame_.cell_m;
}

bool DirtField::LayInGrid(const Vec2& p_G, double diameter_m) {
  if (!IsFloorInGrid(p_G)) return false;
  const Vec2 p = p_G / frame_.cell_m;
  const int ix = static_cast<int>(p.x()), iy = static_cast<int>(p.y());
  const auto step = [](double part) { return static_cast<std::uint16_t>(part * kSteps); };
  const double um = std::clamp(std::round(diameter_m * 1e6), 0.0, 65535.0);
  bins_(ix, iy).push_back({step(p.x() - ix), step(p.y() - iy), static_cast<std::uint16_t>(um)});
  ++size_;
  return true;
}

void DirtField::Reserve(int ix, int iy, std::size_t more) {
  bins_(ix, iy).reserve(bins_(ix, iy).size() + more);
}

std::vector<Particle> DirtField::All() const {
  std::vector<Particle> all;
  all.reserve(static_cast<std::size_t>(size_));
  for (int iy = 0; iy < frame_.height; ++iy)
    for (int ix = 0; ix < frame_.width; ++ix)
      for (const Speck& speck : bins_(ix, iy))
        all.push_back({frame_.X_WG * Place(ix, iy, speck), speck.diameter_um * 1e-6});
  return all;
}

double ExpectedParticles(const HazardMap& map, const DirtParams& params) {
  const std::vector<double> up_to = Expected(DirtField(map), params);
  return up_to.empty() ? 0.0 : up_to.back();
}

DirtField LayDirt(const HazardMap& map, const DirtParams& params, std::uint64_t seed) {
  Check(params);
  DirtField field(map);
  const std::vector<double> up_to = Expected(field, params);
  const double expected = up_to.empty() ? 0.0 : up_to.back();
  if (!(expected <= static_cast<double>(kMostParticles)))
    throw InputError("dirt: more than 100 million particles on this floor");
  Stream random(seed, 0, "dirt");
  std::vector<std::uint32_t> falls(up_to.size());
  for (std::int64_t i = std::llround(expected); i > 0; --i) {
    auto bin = up_to.end();
    while (bin == up_to.end())  // rounding may lead there
      bin = std::upper_bound(up_to.begin(), up_to.end(), random.Uniform() * expected);
    ++falls[static_cast<std::size_t>(bin - up_to.begin())];
  }
  // The middles of the bins' own steps: no place on a border, which rounding could put into a wall.
  const auto part = [&random] { return (static_cast<double>(random.Below(65536)) + 0.5) / 65536; };
  const GridFrame& frame = field.frame();
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      const auto bin = static_cast<std::size_t>(iy) * static_cast<std::size_t>(frame.width) +
                       static_cast<std::size_t>(ix);
      field.Reserve(ix, iy, falls[bin]);
      for (std::uint32_t i = 0; i < falls[bin]; ++i) {
        const double x = part(), y = part();
        field.LayInGrid(frame.cell_m * Vec2(ix + x, iy + y),
                        random.Uniform(params.least_diameter_m, params.most_diameter_m));
      }
    }
  return field;
}

}  // namespace floorproof
