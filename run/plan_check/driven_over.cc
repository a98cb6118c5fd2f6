// SPDX-License-Identifier: Apache-2.0
#include "run/plan_check/driven_over.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "env/geometry/box.h"
#include "env/geometry/convex.h"
#include "run/plan_check/obstacles.h"
#include "run/plan_check/plan_sweep.h"
#include "run/scenario/floors.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

class Meeting {
 public:
  Meeting(const HazardMap& floor, const RobotSpec& robot)
      : X_GW_(floor.frame.X_WG.Inverse()),
        others_(Obstacles::OthersOf(floor, robot)),
        met_(floor.hazards.size()),
        end_m_(met_.size()) {}

  void Look(const SweptPiece& piece) {
    std::set<int> hazards;
    for (Polygon part : piece.parts_W) {
      for (Vec2& p : part) p = X_GW_ * p;
      const auto [low, high] = BoxAround(part);
      others_.Near(low, high, [&](const Obstacles::Part& other) {
        if (!hazards.contains(other.hazard) &&
            Separate(part, other.polygon_G).distance_m < -Obstacles::kTouch_m)
          hazards.insert(other.hazard);
      });
    }
    for (const int hazard : hazards) Meet(static_cast<std::size_t>(hazard), piece);
  }

  std::vector<DrivenOver> Found() const {
    std::vector<DrivenOver> found;
    for (const DrivenOver& met : met_)
      if (met.times > 0) found.push_back(met);
    return found;
  }

 private:
  void Meet(std::size_t hazard, const SweptPiece& piece) {
    DrivenOver& met = met_[hazard];
    met.hazard = hazard;
    if (met.times == 0 || piece.along_m > end_m_[hazard] + Obstacles::kSameStretch_m) ++met.times;
    met.over_m += piece.length_m;
    end_m_[hazard] = piece.along_m + piece.length_m;
  }

  Pose2 X_GW_;
  Obstacles others_;
  std::vector<DrivenOver> met_;
  std::vector<double> end_m_;
};

}  // namespace

std::vector<DrivenOver> FindDrivenOver(const World& world, const PlanResult& plan) {
  const HazardMap floor = TrueFloor(world);
  const auto& hazards = floor.hazards;
  if (hazards.empty()) return {};
  Meeting meeting(floor, world.robot.spec);
  SweepPlan(world.robot, world.start, plan.path,
            [&](const SweptPiece& piece) { meeting.Look(piece); });
  std::vector<DrivenOver> found = meeting.Found();
  std::ranges::stable_sort(found, [&](const DrivenOver& a, const DrivenOver& b) {
    return std::tuple(hazards[a.hazard].known, -a.over_m, -a.times) <
           std::tuple(hazards[b.hazard].known, -b.over_m, -b.times);
  });
  return found;
}

}  // namespace floorproof
