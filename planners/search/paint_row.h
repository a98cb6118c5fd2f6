// SPDX-License-Identifier: Apache-2.0
// The inner loop of AnyAngleField: distances from one root to the places of a row.
//
// Four at a time where the processor has SSE2; the bytes are the same without, because IEEE 754
// rounds a square root the one right way. Float, because it is what the memory costs that counts;
// what differs by a few roundings counts as equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace floorproof {

// Four places of a row side by side. Rows begin with a block.
struct alignas(32) PlaceBlock {
  static constexpr int kPlaces = 4;
  float distance[kPlaces];     // from the source, cells
  std::int32_t root[kPlaces];  // that each is seen from
};

// Whether a distance is less by more than roundings.
inline constexpr float kLess = 1 - 5e-7F;
inline bool IsLess(float distance, float than) { return distance < than * kLess; }

struct RowRoot {
  std::int32_t root;  // its number
  float distance;     // from the source to the root, cells
  int ix, rows;       // its column, and how many rows it lies from the row that is painted
  float margin;       // cells
};
// Where the root is better than others, or worse by less than the margin; nowhere: first > last.
struct PaintedRow {
  int first, last;
};

// Reaches the places x1 .. x2 of a row from a root. `row`: the row's first block.
inline PaintedRow PaintRow(const RowRoot& from, int x1, int x2, PlaceBlock* row) {
  PaintedRow painted{x2 + 1, -1};
  const float dy2 = static_cast<float>(from.rows) * static_cast<float>(from.rows);
#ifdef __SSE2__
  const __m128 base = _mm_set1_ps(from.distance), square = _mm_set1_ps(dy2);
  const __m128 margin = _mm_set1_ps(from.margin), less = _mm_set1_ps(kLess);
  const __m128 root = _mm_castsi128_ps(_mm_set1_epi32(from.root));
  const __m128i before = _mm_set1_epi32(x1 - 1), behind = _mm_set1_epi32(x2 + 1);
  const __m128i ix = _mm_set1_epi32(from.ix);
  __m128i x = _mm_add_epi32(_mm_set1_epi32(x1 & ~3), _mm_set_epi32(3, 2, 1, 0));
  for (int begin = x1 & ~3; begin <= x2; begin += 4, x = _mm_add_epi32(x, _mm_set1_epi32(4))) {
    PlaceBlock& block = row[begin / 4];
    const __m128 dx = _mm_cvtepi32_ps(_mm_sub_epi32(x, ix));
    const __m128 now = _mm_add_ps(base, _mm_sqrt_ps(_mm_add_ps(_mm_mul_ps(dx, dx), square)));
    const __m128 inside =
        _mm_castsi128_ps(_mm_and_si128(_mm_cmpgt_epi32(x, before), _mm_cmpgt_epi32(behind, x)));
    const __m128 old = _mm_load_ps(block.distance);
    const __m128 near = _mm_and_ps(_mm_cmplt_ps(_mm_sub_ps(now, margin), old), inside);
    const int bits = _mm_movemask_ps(near);
    if (bits == 0) continue;
    if (painted.last < 0) painted.first = begin + __builtin_ctz(static_cast<unsigned>(bits));
    painted.last = begin + 31 - __builtin_clz(static_cast<unsigned>(bits));
    const __m128 better = _mm_and_ps(_mm_cmplt_ps(now, _mm_mul_ps(old, less)), inside);
    if (_mm_movemask_ps(better) == 0) continue;
    const auto store = [&](float* at, __m128 fresh, __m128 kept) {
      _mm_store_ps(at, _mm_or_ps(_mm_and_ps(better, fresh), _mm_andnot_ps(better, kept)));
    };
    store(block.distance, now, old);
    auto* roots = reinterpret_cast<float*>(block.root);
    store(roots, root, _mm_load_ps(roots));
  }
#else
  for (int x = x1; x <= x2; ++x) {
    PlaceBlock& block = row[x / 4];
    const auto dx = static_cast<float>(x - from.ix);
    const float now = from.distance + std::sqrt(dx * dx + dy2), old = block.distance[x % 4];
    if (!(now - from.margin < old)) continue;
    painted.first = std::min(painted.first, x);
    painted.last = x;
    if (!IsLess(now, old)) continue;
    block.distance[x % 4] = now;
    block.root[x % 4] = from.root;
  }
#endif
  return painted;
}

}  // namespace floorproof
