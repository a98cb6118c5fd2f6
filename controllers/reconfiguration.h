// SPDX-License-Identifier: Apache-2.0
// Folding a robot of blocks from one shape into another.
//
// The path through the hinges' angles is searched once (A* on a lattice of 15 degrees, one hinge
// per step), so that no two blocks run into each other. It is then driven at a bounded rate with a
// rest at each bend: a reference, plus feedback in proportion to the distance from it. Where a
// block lags behind, the reference waits for it. Assumes free floor around the robot; the wheels of
// the moving blocks must be driven along (Drive::ToWheels).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "env/core/blocks.h"

namespace floorproof {

// The ends and bends of a way from one shape's angles to another's; empty when there is none. Both
// ends lie on the lattice.
using HingeWay = std::vector<std::vector<double>>;
HingeWay FoldingWay(const RobotSpec& robot, std::span<const double> from_rad,
                    std::span<const double> to_rad);

// Whether two blocks overlap by more than a little, the hinges standing so.
bool BlocksCollide(const RobotSpec& robot, std::span<const double> hinge_rad);

class Reconfiguration {
 public:
  // Holds the shape that the robot starts in. May allocate; the rest may not.
  void Start(const RobotSpec& robot);
  // From now on along this way, which outlives the folding.
  void Fold(const HingeWay& way);
  // One control period: what the hinges should do, given where they are.
  HingeState Update(const HingeState& now, double dt_s);
  bool done() const { return way_ == nullptr; }
  // What folding along this way takes where nothing holds the hinges, s.
  double Duration(const HingeWay& way) const;

 private:
  double LegLength(const HingeWay& way, std::size_t leg) const;

  int n_ = 0;
  double max_rate_radps_ = 0;
  std::array<double, HingeState::kMax> hold_rad_{};  // the reference
  const HingeWay* way_ = nullptr;
  std::size_t leg_ = 0;  // the reference is between bends leg_ and leg_ + 1,
  double s_rad_ = 0;     // this far along, at
  double v_radps_ = 0;
};

}  // namespace floorproof
