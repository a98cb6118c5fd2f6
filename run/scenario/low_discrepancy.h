// SPDX-License-Identifier: Apache-2.0
// A Sobol sequence, shifted at random: points that fill a cube more evenly than independent draws.
//
// Sobol (1967), with the direction numbers of Joe and Kuo (2008). Of the first 2^k points each
// interval [j, j + 1) / 2^k of each coordinate holds exactly one. The shift is a digital one
// (exclusive or with a random number, L'Ecuyer and Lemieux 2002): it keeps that, and makes each
// point by itself uniform. Not done: scrambling (Owen), which would lower the error of smooth means
// further.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace floorproof {

inline constexpr std::size_t kMostDimensions = 1000;

// Point `index` of the sequence that begins at 0, as 64 binary digits behind the point, a number a
// coordinate. Found directly, whatever the index; `dimensions` at most kMostDimensions.
std::vector<std::uint64_t> SobolPoint(std::uint64_t index, std::size_t dimensions);

// A coordinate moved by a digital shift, in (0, 1): never 0 nor 1, where quantiles may be infinite.
double Shifted(std::uint64_t coordinate, std::uint64_t shift);

}  // namespace floorproof
