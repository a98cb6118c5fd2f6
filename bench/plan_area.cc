// SPDX-License-Identifier: Apache-2.0
// What a plan costs against the area: drawn rooms of 500 to 4000 cells a side, with pillars, walls
// with doors and clutter, planned for by a disc of 0.45 m; and a hall of 400 m x 200 m for a tool
// of 0.3 m. Seconds of one core, and how many times as many as the next smaller room takes for four
// times its area (4: linear). Then the most memory that was held.
//   bench_plan_area [PLANNER]
#include <fmt/core.h>
#include <sys/resource.h>

#include <iostream>

#include "base/streams.h"
#include "bench/cpu_time.h"
#include "env/core/coverage.h"
#include "planners/planner.h"

namespace floorproof {
namespace {

void Fill(HazardMap& map, int x, int y, int w, int h, CellState state) {
  for (int iy = std::max(0, y); iy < std::min(map.frame.height, y + h); ++iy)
    for (int ix = std::max(0, x); ix < std::min(map.frame.width, x + w); ++ix)
      map.occupancy(ix, iy) = state;
}

HazardMap Room(int width, int height, int pillars_every, int wall_every) {
  HazardMap map;
  map.frame = {width, height, 0.05, {}};
  map.occupancy = Grid<CellState>(width, height);
  const CellState wall = CellState::kOccupied, free = CellState::kFree;
  Fill(map, 0, 0, width, height, wall);
  Fill(map, 2, 2, width - 4, height - 4, free);
  for (int y = pillars_every / 2; y + 80 < height; y += pillars_every)
    for (int x = pillars_every / 2; x + 80 < width; x += pillars_every)
      Fill(map, x, y, 12, 12, wall);
  for (int y = wall_every; wall_every > 0 && y + 200 < height; y += wall_every) {
    Fill(map, 0, y, width, 3, wall);
    for (int x = 100; x + 100 < width; x += 400) Fill(map, x, y, 40, 3, free);
  }
  Stream random(1, 0, "room");
  const auto below = [&](int n) {
    return static_cast<int>(random.Below(static_cast<std::uint64_t>(n)));
  };
  for (int i = 0; i < width / 200 * (height / 200); ++i) {
    const int x = 20 + below(width - 60), y = 20 + below(height - 60);
    const int w = 4 + below(16), h = 4 + below(16);
    Fill(map, x, y, w, h, wall);
  }
  Fill(map, 10, 10, 60, 60, free);
  return map;
}

// Seconds of one core.
double PlanOne(const std::string& planner, const HazardMap& map, double tool_width_m,
               double radius_m, double smaller_s) {
  RobotSpec robot;
  robot.step_m = 0.01;
  ConfigNode params = ConfigNode::Map();
  params.Add("tool_width_m", ConfigNode::Scalar(FormatDouble(tool_width_m)));
  params.Add("radius_m", ConfigNode::Scalar(FormatDouble(radius_m)));
  const auto dut = MakePlugin(Planners(), planner, "planner");
  ReadParams(params, "plan.", *dut);
  const double begin = CpuSeconds();
  const PlanResult plan = dut->Plan({map, robot, {2, 2, 0}, std::nullopt, 0});
  const double seconds = CpuSeconds() - begin;
  fmt::print("{:5} x {:4} {:9.1f} {:10.0f} {:8.2f} {:>8}\n", map.frame.width, map.frame.height,
             1e-6 * map.frame.width * map.frame.height, Length(plan.path), seconds,
             smaller_s > 0 ? fmt::format("{:.2f}", seconds / smaller_s) : "");
  std::cout.flush();
  return seconds;
}

int Main(int argc, char** argv) {
  const std::string planner = argc > 1 ? argv[1] : "boustrophedon";
  fmt::print("{:12} {:>9} {:>10} {:>8} {:>8}\n", "cells", "millions", "length_m", "s", "ratio");
  double seconds = 0;
  for (const int side : {500, 1000, 2000, 4000})
    seconds = PlanOne(planner, Room(side, side, 320, 800), 0.45, 0.36, seconds);
  PlanOne(planner, Room(8000, 4000, 480, 0), 0.3, 0.36, 0);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  fmt::print("at most {:.2f} GB were held\n", static_cast<double>(used.ru_maxrss) / 1e6);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  try {
    return floorproof::Main(argc, argv);
  } catch (const floorproof::InputError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
