// SPDX-License-Identifier: Apache-2.0
// Synthetic motion for the detectors' tests: what a robot would have done, without physics.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "env/failures/detector.h"

namespace floorproof {

inline constexpr double kStepS = 0.004;

// A disc of 0.18 m radius and 10 kg on two wheels.
RobotSpec TestRobot();
// Four hazards on an empty floor; index kStepHazard and so on.
HazardMap TestMap();
inline constexpr int kStepHazard = 0, kGlassHazard = 1;

using Trace = std::vector<Sample>;

// Motion from rest at the origin, a constant body twist per piece, followed exactly: as the plan
// wants it.
struct Piece {
  double duration_s = 0;
  BodyTwist twist;
  bool dwelling = false;
};
Trace Drive(const std::vector<Piece>& pieces);

// Runs along x at `speed`, meets a wall at t = 1 s, and then moves along x at `after(t)` (t from
// the impact) while the command stays, or becomes `command_after`.
struct Hit {
  double speed_mps = 0.2;
  double command_after_mps = 0.2;
  double contact_s = 0.02;  // how long the wall is touched
  std::function<double(double)> after;
};
Trace DriveInto(const Hit& hit);

// The same motion seen in a mirror along x.
Trace Mirrored(Trace trace);

// Sets members from time `from_s` on (and until `to_s`).
Trace With(Trace trace, const std::function<void(Sample&)>& change, double from_s = 0,
           double to_s = 1e9);

// In this step a thing (-1: a wall) pushes the body's origin with this force.
void PushedBy(Sample& sample, int hazard, const Vec3& force_W_n);

// A motion that shows a mode's failure and no other's.
Trace FailingTrace(FailureMode mode);

// The events that the detector reports.
std::vector<Event> Judge(Detector& dut, const Trace& trace);
std::unique_ptr<Detector> MakeDetector(std::string_view name, const std::string& yaml = "");

// The floor, robot and context that Judge() uses.
const EpisodeContext& TestContext();

}  // namespace floorproof
