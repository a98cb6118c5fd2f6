// SPDX-License-Identifier: Apache-2.0
// The highest step that wheels climb at a speed does not depend on the time step. A wheel that
// meets an edge fast sinks into it and is thrown up by its tyre and by the robot's momentum; how
// much is a matter of the tyre's stiffness and damping, which the engine must follow through the
// impact.
//
// Each bundled robot, up to its highest speed, at 4 ms against 2 ms, by bisection to 1 %.
// Tolerance: 5 %. Wrong wheels or friction move a limit by more.
#include <fmt/format.h>

#include "validate/climb.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kShare = 0.05;

class EdgeSpeed final : public Law {
 public:
  std::string_view statement() const override {
    return "the highest step climbed at a speed is the same at 4 ms and at 2 ms";
  }
  std::vector<WrongModel> notices() const override {
    return {kMoreFriction, kLargerWheels, {.gravity_factor = 1.3}};
  }
  bool slow() const override { return true; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const RobotEntry& entry : Robots()) {
      const std::string robot(entry.name);
      const double most_mps = Rig(robot).robot().max_speed_mps;
      for (const double speed_mps : {0.1, 0.3, 0.6, 0.8})
        if (speed_mps <= most_mps) Compare(robot, speed_mps, wrong, rows);
    }
  }

 private:
  static void Compare(const std::string& robot, double speed_mps, const WrongModel& wrong,
                      std::vector<LawRow>& rows) {
    const double fine_mm = 1000 * HighestStep(robot, speed_mps, {.timestep_s = 0.002});
    rows.push_back({fmt::format("edge_speed/{}/{}mps", robot, speed_mps), fine_mm,
                    1000 * HighestStep(robot, speed_mps, {}, wrong), kShare * fine_mm, "mm"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, EdgeSpeed)

}  // namespace floorproof
