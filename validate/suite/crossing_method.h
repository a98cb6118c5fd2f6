// SPDX-License-Identifier: Apache-2.0
// Methods in which a robot drives straight over something that lies across its way and that it
// knows of. It is told where it is: what is tested is wheels, motors and belly.
#pragma once

#include "validate/suite/bench_floor.h"

namespace floorproof {

class CrossingMethod : public Method {
 public:
  MethodDrive LayOut(const MethodRun& run) const override;

 protected:
  // How far it reaches, square to its edge, m; 0: a floor that goes on.
  virtual double Length(double size) const = 0;
  // Its keys; `toward_deg`: square to its edge, away from the robot, from the world's x.
  virtual std::string HazardKeys(double size, double toward_deg) const = 0;
  // Between the way and the edge; 90: square to it.
  virtual double angle_deg() const { return 90; }
  // How far the robot goes on beyond, m, where the floor goes on.
  virtual double beyond_m() const { return 0; }
};

}  // namespace floorproof
