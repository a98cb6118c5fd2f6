// SPDX-License-Identifier: Apache-2.0
// Online planners on drawn floors of cells, without a scenario.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planners/online/online_planner.h"
#include "run/episode/cell_world.h"

namespace floorproof::testing {

constexpr double kCell_m = 0.5;

// The top row first; '#' is blocked, 'S' where the robot stands.
struct CellFloor {
  explicit CellFloor(const std::vector<std::string>& rows)
      : frame{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), kCell_m, {}},
        blocked(frame.width, frame.height) {
    for (int iy = 0; iy < frame.height; ++iy)
      for (int ix = 0; ix < frame.width; ++ix) {
        const char c =
            rows[static_cast<std::size_t>(frame.height - 1 - iy)][static_cast<std::size_t>(ix)];
        blocked(ix, iy) = c == '#';
        if (c == 'S') start = {ix, iy};
      }
  }
  GridFrame frame;
  Grid<std::uint8_t> blocked;
  Cell start;
};

// A drive, step by step.
class CellRun {
 public:
  CellRun(OnlinePlanner& planner, const CellFloor& floor, std::uint64_t seed = 0)
      : world(floor.frame, floor.blocked, floor.start, planner.params().radius_m),
        known(floor.frame),
        planner_(planner) {
    known.changed.emplace();
    Look();
    planner.Start({floor.frame, estimate_.X_WB, {}, {}, kCell_m, seed});
  }

  // Asks once, and goes there: a planner goes only where it knows the floor to be free.
  OnlineStep Step() {
    world.Sense(known);
    const OnlineStep step = planner_.Next({known, *known.changed, estimate_});
    known.changed->clear();
    if (step.kind != OnlineStep::Kind::kTarget) return step;
    const Cell to = world.frame().ToCell(step.target_W);
    EXPECT_EQ(known.At(to), CellState::kFree) << to.ix << ", " << to.iy;
    EXPECT_TRUE(world.Step(to)) << to.ix << ", " << to.iy;
    Look();
    way.push_back(world.here());
    return step;
  }
  // Until it ends, or for so many steps.
  OnlineStep Run(std::int64_t steps = 1'000'000) {
    OnlineStep last;
    while (steps-- > 0) {
      last = Step();
      if (last.kind != OnlineStep::Kind::kTarget || ::testing::Test::HasFailure()) break;
    }
    return last;
  }

  CellWorld world;
  KnownMap known;
  std::vector<Cell> way;

 private:
  void Look() {
    const Vec2 p_W = world.frame().Center(world.here());
    estimate_.X_WB = {p_W.x(), p_W.y(), 0};
  }

  OnlinePlanner& planner_;
  Estimate estimate_;
};

// `params`: YAML's inside of a map, as "radius_m: 1".
inline std::unique_ptr<OnlinePlanner> MakeOnline(const std::string& name,
                                                 const std::string& params = "") {
  auto planner = MakePlugin(OnlinePlanners(), name, "planner");
  ReadParams(ParseYaml("{" + params + "}", "params"), "", *planner);
  return planner;
}

inline std::ostream& operator<<(std::ostream& out, const Cell& c) {
  return out << c.ix << "," << c.iy;
}

}  // namespace floorproof::testing
