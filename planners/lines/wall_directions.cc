// SPDX-License-Identifier: Apache-2.0
// Directions: beside a wall the distance to it grows square to the wall. A cell between walls,
// where the distance has a ridge, or beside a corner, does not count. Main direction: the one along
// which the borders of the walls line up best, which cells' staircases do not falsify.
#include "planners/lines/wall_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "planners/search/index.h"

namespace floorproof {
namespace {

constexpr int kBins = 90;
using Bins = std::array<double, kBins>;

Bins Histogram(const Grid<float>& room) {
  Bins bins{};
  for (int iy = 2; iy + 2 < room.height; ++iy)
    for (int ix = 2; ix + 2 < room.width; ++ix) {
      const float m = room(ix, iy);
      if (m < 1.0f || m > 8.0f) continue;
      const float gx = room(ix + 2, iy) - room(ix - 2, iy);
      const float gy = room(ix, iy + 2) - room(ix, iy - 2);
      if (gx * gx + gy * gy < 12.0f) continue;  // a ridge between walls, or beside a corner
      const double turn = std::atan2(static_cast<double>(gy), static_cast<double>(gx)) / (kPi / 2);
      const double bin = (turn - std::floor(turn)) * kBins;
      ++bins[static_cast<std::size_t>(std::lround(bin)) % kBins];
    }
  return bins;
}

double& At(Bins& bins, int i) { return bins[Z((i % kBins + kBins) % kBins)]; }

std::vector<int> Peaks(Bins bins) {
  Bins smoothed{};
  for (int i = 0; i < kBins; ++i)
    for (int k = -2; k <= 2; ++k) smoothed[Z(i)] += (3 - std::abs(k)) * At(bins, i + k);
  const double total = std::accumulate(smoothed.begin(), smoothed.end(), 0.0);
  std::vector<int> peaks;
  while (peaks.size() < kMaxDirections) {
    const auto best = std::max_element(smoothed.begin(), smoothed.end());
    if (*best <= 0 || *best < 0.06 * total / 5) break;
    peaks.push_back(static_cast<int>(best - smoothed.begin()));
    for (int k = -7; k <= 7; ++k) At(smoothed, peaks.back() + k) = 0;
  }
  if (peaks.empty()) peaks.push_back(0);
  return peaks;
}

// The wall cells beside a free one, thinned out evenly if there are very many.
std::vector<Vec2> Border(const Grid<std::uint8_t>& walls) {
  constexpr std::size_t kMaxPoints = 200000;
  std::vector<Vec2> border;
  for (int iy = 1; iy + 1 < walls.height; ++iy)
    for (int ix = 1; ix + 1 < walls.width; ++ix)
      if (walls(ix, iy) &&
          !(walls(ix - 1, iy) && walls(ix + 1, iy) && walls(ix, iy - 1) && walls(ix, iy + 1)))
        border.push_back(Vec2(ix, iy));
  const std::size_t every = border.size() / kMaxPoints + 1;
  std::vector<Vec2> some;
  for (std::size_t i = 0; i < border.size(); i += every) some.push_back(border[i]);
  return some;
}

// How sharp the profiles of the points across this direction and along it are: the sum of the
// squared counts of bins one cell wide. Points on straight lines along the direction share a bin.
double Alignment(const std::vector<Vec2>& points, double direction_rad) {
  const Vec2 along(std::cos(direction_rad), std::sin(direction_rad)), across(-along.y(), along.x());
  double sum = 0;
  std::vector<int> count;
  for (const Vec2& axis : {along, across}) {
    double low = 0;
    for (const Vec2& p : points) low = std::min(low, axis.dot(p));
    count.clear();
    for (const Vec2& p : points) {
      const auto bin = static_cast<std::size_t>(axis.dot(p) - low + 0.5);
      if (bin >= count.size()) count.resize(bin + 1);
      ++count[bin];
    }
    for (const int n : count) sum += static_cast<double>(n) * n;
  }
  return sum;
}

}  // namespace

std::vector<double> WallDirections(const Grid<float>& room) {
  std::vector<double> directions;
  for (const int peak : Peaks(Histogram(room))) directions.push_back(peak * (kPi / 2) / kBins);
  return directions;
}

double MainWallDirection(const Grid<std::uint8_t>& walls) {
  const std::vector<Vec2> border = Border(walls);
  double best_deg = 0, best = Alignment(border, 0);
  const auto look = [&](double deg) {
    const double alignment = Alignment(border, deg * kPi / 180);
    if (alignment > best) best = alignment, best_deg = deg;
  };
  for (int deg = -44; deg <= 45; ++deg) look(deg);
  const double rough_deg = best_deg;
  for (int k = -9; k <= 9; ++k) look(rough_deg + 0.1 * k);
  // A scan of much furniture has no direction that is plainly the best.
  constexpr double kPlainly = 1.5;
  if (best < kPlainly * Alignment(border, 0)) return 0;
  return std::remainder(best_deg * kPi / 180, kPi / 2);
}

}  // namespace floorproof
