// SPDX-License-Identifier: Apache-2.0
// Where to sample: "audit-sampling", section 4.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/params.h"
#include "env/core/sample_place.h"
#include "planners/audit/room.h"

namespace floorproof {

struct SampleParams {
  std::optional<double> du_m, dv_m;
  std::optional<double> boundary_m, corner_m;
  double random_share = 0.05;
  bool jitter = false;

  void Visit(ParamVisitor& visit);
};

struct FoundSamples {
  std::string why;                  // there are none; else empty
  std::vector<SamplePlace> places;  // row by row from the least y on; all marked as not reachable
  std::vector<Vec2> boundary_W;     // of cells along the room's boundary, in order
  // General sample locations, and of them those of each kind, which may be several at once.
  int general = 0, boundary = 0, corner = 0, random = 0;
  SampledParts parts;
};

// The general sample locations are a lattice of free cells inside the room, at the intervals `du_m`
// and `dv_m` along the rows and columns of its grid, to whole cells; how it lies is chosen by what
// the robot reaches (`reach`: SensorReach). Places are those of them
// near the boundary, those near corners, and a few random ones of the rest (Eq. 1). `width_m`: of
// the robot, after which the intervals are chosen where they are not given. The paper's
// "proportional to the robot footprint".
//
// With `jitter` each location lies anywhere by chance in the du x dv of floor that is nearest to
// its place in the lattice (stratified random sampling), and is none if that is no floor of the
// room. Then any piece of the floor is as likely to be looked at as any other, and the mean over
// the places near walls is that of the floor near walls.
FoundSamples FindSamples(const Room& room, const Grid<float>& reach, double width_m,
                         const SampleParams& params, std::uint64_t seed);

}  // namespace floorproof
