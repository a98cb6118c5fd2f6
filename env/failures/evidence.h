// SPDX-License-Identifier: Apache-2.0
// What the detectors share: which hazard is to blame, and the making of an event.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "env/core/event.h"
#include "env/failures/detector.h"

namespace floorproof {

// Who did it. Things that lie side by side are told apart by what their contacts did to the robot:
// a mat under a wheel is not the wall that holds it. The effect of each thing fades with kFade_s;
// the one to blame has the most. A failure is often established seconds after its cause. The level
// on which the robot was set down carries it as the base floor would, and its edge alone has an
// effect.
class HazardMemory {
 public:
  // The effect that a touch has in a step, as a share of the robot's weight; not positive: none.
  using Effect = double (*)(const RobotSpec& robot, const Sample& sample, const Touch& touch);

  // Holds the robot back against what is commanded.
  static double Holds(const RobotSpec& robot, const Sample& sample, const Touch& touch);
  // Pushes it off its path, or turns it.
  static double PushesOff(const RobotSpec& robot, const Sample& sample, const Touch& touch);
  // Tilts it towards the side to which it leans.
  static double Tilts(const RobotSpec& robot, const Sample& sample, const Touch& touch);

  explicit HazardMemory(Effect effect) : effect_(effect) {}

  void Start(const EpisodeContext& context);
  void Update(const Sample& sample);

  // The id of what had the most effect at since_s or later, "wall" for the map's own. Where nothing
  // had any: of the gap or the slippery floor met last since then. Else "".
  std::string Recall(double since_s) const;

 private:
  static constexpr double kFade_s = 3, kLeast = 0.01;
  struct Entry {
    int hazard = -1;
    double impulse_s = 0, t_s = -std::numeric_limits<double>::infinity();
    double At(double t_s) const;
  };

  Effect effect_;
  const HazardMap* map_ = nullptr;
  const RobotSpec* robot_ = nullptr;
  double timestep_s_ = 0, now_s_ = 0;
  double floor_m_ = 0;   // on which it was set down
  bool starts_ = false;  // no sample was seen yet
  std::array<Entry, 2 * Sample::kMaxTouches> entries_;
  Entry passive_;  // what has an effect without a push
};

// An event at this sample's time and pose, with the mode's effect.
Event MakeEvent(FailureMode mode, std::string_view kind, const Sample& sample, std::string hazard,
                double value, double threshold);

}  // namespace floorproof
