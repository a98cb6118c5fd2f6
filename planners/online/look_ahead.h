// SPDX-License-Identifier: Apache-2.0
// Drives in thought over the floor around the robot: a step or a plan, and then the rule, until all
// is covered that can be reached there. (A rollout: Bertsekas, Tsitsiklis & Wu, "Rollout algorithms
// for combinatorial optimization", 1997.)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planners/online/thought_floor.h"

namespace floorproof {

class LookAhead {
 public:
  // `around`: how many cells it sees to each side.
  LookAhead(int around, bool diagonals);

  // The robot stands at a cell of `floor`: its surroundings are taken over. Nothing beyond them is
  // entered, though the rule counts neighbours there.
  void Stand(const ThoughtFloor& floor, int at);

  // What the drive costs that begins with these steps, as far as they lead: a way beyond a straight
  // step for each uncovered cell, and much for each cell that is covered for the second time. No
  // more than `most` is counted: that, too, where so much was tried since Stand() that it ends
  // here.
  int CostOf(std::span<const int> begin, int most);
  // The steps of the last drive.
  const std::vector<int>& way() const { return way_; }

 private:
  // Cells gone to and looked at before each step of the robot. On 1,000 x 1,000 known cells all
  // that it would look at takes several times as long, at times; in a room it is hardly ever met.
  static constexpr std::int64_t kMostEffort = 20'000;

  void CountUncovered();
  void Go(int step);

  int side_;
  ThoughtFloor floor_;
  ThoughtFloor::Marks taken_;
  int uncovered_ = 0;  // cells that can be reached
  std::int64_t effort_ = 0;
  int at_ = 0, heading_ = 0, cost_ = 0, left_ = 0;
  std::vector<int> way_, way_out_, todo_;
  std::vector<std::uint8_t> seen_;
};

}  // namespace floorproof
