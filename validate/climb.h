// SPDX-License-Identifier: Apache-2.0
// A robot driven against the edge of a raised floor.
#pragma once

#include <string>
#include <utility>

#include "validate/bisect.h"
#include "validate/rig.h"

namespace floorproof {

// Where the edge lies, from the rig's origin, and how far the origin must come for the last wheel
// to stand on top; forward, or to the left.
struct ClimbPlace {
  double edge_m = 0, end_m = 0;
};
// So far before the rim of the first wheels of `rig`, in the pose in which it was put.
ClimbPlace PlaceEdge(Rig& rig, bool sideways, double run_up_m = 0.005);

// The raised floor: half a plane, from the edge on.
Hazard Ledge(double height_m, double edge_m, bool sideways);

// Drives on until all wheels are on top (true), or until it has not moved forward by a millimetre
// in the time that 6 cm take (false).
bool Climbs(Rig& rig, double end_m, bool sideways, double speed_mps);

// The highest edge that the rigs of `make_rig` climb at this place, between `low_m` and `high_m`.
// make_rig(options) builds a rig with these hazards, on its way.
template <class MakeRig>
double HighestClimbed(double low_m, double high_m, double resolution_m, const ClimbPlace& place,
                      bool sideways, double speed_mps, const MakeRig& make_rig) {
  return Bisect(low_m, high_m, resolution_m, [&](double height_m) {
    RigOptions options;
    options.hazards.push_back(Ledge(height_m, place.edge_m, sideways));
    Rig rig = make_rig(std::move(options));
    return Climbs(rig, place.end_m, sideways, speed_mps);
  });
}

// The highest step that a robot climbs forward at a commanded speed, m; after a run-up, with
// neither tracker nor detectors. It is searched up to 1.2 times the radius of the wheels, to 0.25 %
// of that radius.
double HighestStep(const std::string& robot, double speed_mps, const PhysicsParams& physics,
                   const WrongModel& wrong = {});

}  // namespace floorproof
