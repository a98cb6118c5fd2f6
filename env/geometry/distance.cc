// SPDX-License-Identifier: Apache-2.0
// Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled Functions", 2012: first along
// columns, then along each row, as the lower envelope of parabolas. A row is cut at its set cells,
// because no source behind a set cell can be the nearest. So a grid that is mostly set costs
// little.
#include "env/geometry/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace floorproof {
namespace {

constexpr double kEps = 1e-6;  // of a cell: a centre on the disc's edge lies within it
constexpr int kFar = 1 << 28;  // "no source in this column", in cells

// Lower envelope of parabolas with minima at increasing integer positions.
class Envelope {
 public:
  explicit Envelope(std::size_t max_sources) : sources_(max_sources) {}
  void Clear() { n_ = 0; }
  void Add(int position, double value) {
    const double p = position;
    const double key = value + p * p;
    double from = -std::numeric_limits<double>::infinity();
    while (n_ > 0) {
      const Source& last = sources_[n_ - 1];
      from = (key - last.key) / (2 * (p - last.position));
      if (from > last.from) break;
      from = -std::numeric_limits<double>::infinity();
      --n_;
    }
    sources_[n_++] = {p, key, from};
  }
  // Least value at `position`; calls must come with increasing positions.
  double At(int position) {
    const double x = position;
    while (cursor_ + 1 < n_ && sources_[cursor_ + 1].from <= x) ++cursor_;
    const Source& s = sources_[cursor_];
    return s.key + x * (x - 2 * s.position);
  }
  bool Rewind() { return cursor_ = 0, n_ > 0; }

 private:
  struct Source {
    double position, key /* value + position^2 */, from /* first x where it is the least */;
  };
  std::vector<Source> sources_;
  std::size_t n_ = 0, cursor_ = 0;
};

// What a set cell's distance is measured to.
enum class Target { kArea, kCentre };

// Rows to the nearest set cell in the same column.
Grid<int> ColumnDistance(const Grid<std::uint8_t>& set, bool border_is_set) {
  Grid<int> rows(set.width, set.height);
  const auto w = static_cast<std::size_t>(set.width);
  std::vector<int> run(w, border_is_set ? 0 : kFar);
  for (int iy = 0; iy < set.height; ++iy) {
    const std::uint8_t* s = &set.cells[set.Index(0, iy)];
    int* out = &rows.cells[set.Index(0, iy)];
    for (std::size_t i = 0; i < w; ++i) out[i] = run[i] = s[i] ? 0 : run[i] + 1;
  }
  std::fill(run.begin(), run.end(), border_is_set ? 0 : kFar);
  for (int iy = set.height - 1; iy >= 0; --iy) {
    int* out = &rows.cells[set.Index(0, iy)];
    for (std::size_t i = 0; i < w; ++i) {
      run[i] = std::min(run[i] + 1, out[i]);
      out[i] = run[i];
    }
  }
  return rows;
}

// Positions and lengths below are in half cells, so that borders between cells are integers too.
Grid<float> Distance(const Grid<std::uint8_t>& set, bool border_is_set, Target target) {
  Grid<float> distance(set.width, set.height, std::numeric_limits<float>::infinity());
  if (set.width == 0 || set.height == 0) return distance;
  const Grid<int> rows = ColumnDistance(set, border_is_set);
  Envelope envelope(static_cast<std::size_t>(set.width) + 2);
  const bool to_area = target == Target::kArea;
  const auto squared = [to_area](int n_rows) {
    const double d = to_area ? 2.0 * n_rows - 1 : 2.0 * n_rows;
    return d * d;
  };
  for (int iy = 0; iy < set.height; ++iy) {
    const int* row = &rows.cells[set.Index(0, iy)];
    float* out = &distance.cells[set.Index(0, iy)];
    for (int begin = 0, end; begin < set.width; begin = end) {
      if (row[begin] == 0) {
        out[begin] = 0;
        end = begin + 1;
        continue;
      }
      for (end = begin + 1; end < set.width && row[end] != 0;) ++end;
      envelope.Clear();
      if (begin > 0 || border_is_set) envelope.Add(2 * begin - (to_area ? 1 : 2), 0);
      for (int i = begin; i < end; ++i) {
        if (to_area) {  // the nearer side of a cell is the border between it and its neighbour
          const int nearest = i + 1 < end ? std::min(row[i], row[i + 1]) : kFar;
          if (nearest < kFar) envelope.Add(2 * i + 1, squared(nearest));
        } else if (row[i] < kFar) {
          envelope.Add(2 * i, squared(row[i]));
        }
      }
      if (end < set.width || border_is_set) envelope.Add(2 * end - (to_area ? 1 : 0), 0);
      const bool any = envelope.Rewind();
      for (int i = begin; i < end; ++i) {
        double least = any ? envelope.At(2 * i) : std::numeric_limits<double>::infinity();
        if (row[i] < kFar) least = std::min(least, squared(row[i]));
        out[i] = static_cast<float>(std::sqrt(least) / 2);
      }
    }
  }
  return distance;
}

}  // namespace

Grid<float> DistanceToSet(const Grid<std::uint8_t>& set, bool border_is_set) {
  return Distance(set, border_is_set, Target::kArea);
}

Grid<float> DistanceToCentres(const Grid<std::uint8_t>& set) {
  return Distance(set, false, Target::kCentre);
}

void DilateDisc(const Grid<std::uint8_t>& set, double radius, Grid<std::uint8_t>& out) {
  int x0 = set.width, x1 = -1, y0 = set.height, y1 = -1;
  for (int iy = 0; iy < set.height; ++iy)
    for (int ix = 0; ix < set.width; ++ix)
      if (set(ix, iy)) {
        x0 = std::min(x0, ix), x1 = std::max(x1, ix);
        y0 = std::min(y0, iy), y1 = iy;
      }
  if (x1 < 0) return;
  const int margin = static_cast<int>(std::ceil(radius));
  x0 = std::max(0, x0 - margin), x1 = std::min(set.width - 1, x1 + margin);
  y0 = std::max(0, y0 - margin), y1 = std::min(set.height - 1, y1 + margin);
  Grid<std::uint8_t> crop(x1 - x0 + 1, y1 - y0 + 1);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) crop(ix - x0, iy - y0) = set(ix, iy);
  const Grid<float> distance = DistanceToCentres(crop);
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix)
      if (distance(ix - x0, iy - y0) <= radius + kEps) out(ix, iy) = 1;
}

}  // namespace floorproof
