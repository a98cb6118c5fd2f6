// SPDX-License-Identifier: Apache-2.0
// What a crowded floor and a large map cost: steps a second of Simulation::Step, the same circle
// driven on each floor, all in turn within one run; the ratios are what counts.
//   bench_cost [ROUNDS]
//
// Floors: a bare room of 10 m; the same with 200 plates of 4 mm, spread over it (the circle crosses
// them), all around the robot or all under it; and a map of 4000 x 4000 cells of 5 cm (200 m
// square): rooms with doors, pillars and random furniture, with a clear hall where the circle is
// driven.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/registry.h"
#include "base/streams.h"
#include "controllers/drive.h"
#include "env/sim/simulation.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kPlates = 200;

double Since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void Fill(HazardMap& map, int x0, int y0, int width, int height, CellState state) {
  for (int iy = std::max(0, y0); iy < std::min(map.occupancy.height, y0 + height); ++iy)
    for (int ix = std::max(0, x0); ix < std::min(map.occupancy.width, x0 + width); ++ix)
      map.occupancy(ix, iy) = state;
}

HazardMap EmptyMap(int cells) {
  HazardMap map;
  map.frame = {cells, cells, 0.05, {-0.025 * cells, -0.025 * cells, 0}};
  map.occupancy = Grid<CellState>(cells, cells);
  return map;
}

// Rooms of 5 m whose walls have a door each, furniture and pillars at random, a hall in the middle.
HazardMap LargeMap() {
  HazardMap map = EmptyMap(4000);
  constexpr int kRoom = 100, kWall = 2, kDoor = 24;
  Stream draw(1, 0, "cost");
  const auto below = [&draw](int n) { return static_cast<int>(draw.Below(n)); };
  for (int y = 0; y < 4000; y += kRoom)
    for (int x = 0; x < 4000; x += kRoom) {
      Fill(map, x, y, kRoom, kWall, CellState::kOccupied);
      Fill(map, x, y, kWall, kRoom, CellState::kOccupied);
      Fill(map, x + 10 + below(kRoom - kDoor - 20), y, kDoor, kWall, CellState::kFree);
      Fill(map, x, y + 10 + below(kRoom - kDoor - 20), kWall, kDoor, CellState::kFree);
      for (int k = 0; k < 12; ++k)
        Fill(map, x + below(kRoom - 12), y + below(kRoom - 12), 2 + below(10), 2 + below(10),
             CellState::kOccupied);
    }
  Fill(map, 1900, 1900, 200, 200, CellState::kFree);
  return map;
}

Hazard Plate(int number, const Vec2& p_W, double half_m) {
  Hazard hazard;
  hazard.id = "plate-" + std::to_string(number);
  hazard.type = "step";
  hazard.hazard_class = HazardClass::kLevelChange;
  hazard.height_m = 0.004;
  const Polygon square = Rectangle(p_W - Vec2(half_m, half_m), p_W + Vec2(half_m, half_m));
  hazard.footprint = {square};
  hazard.solids = {{Solid::Kind::kPrism, square, {}, 0, 0.004}};
  return hazard;
}

HazardMap Spread() {
  HazardMap map = EmptyMap(200);
  for (int i = 0; i < kPlates; ++i)
    map.hazards.push_back(Plate(i, {-4.5 + 0.65 * (i % 15), -4.4 + 0.65 * (i / 15)}, 0.05));
  return map;
}

// Around a robot that turns on the spot: four rings of 50, all of them within a metre.
HazardMap Around() {
  HazardMap map = EmptyMap(200);
  for (int i = 0; i < kPlates; ++i) {
    const double at_m = 0.45 + 0.12 * (i % 4), angle = 2 * kPi * i / kPlates;
    map.hazards.push_back(Plate(i, at_m * Vec2(std::cos(angle), std::sin(angle)), 0.02));
  }
  return map;
}

// Under a robot that turns on the spot: all wheels stand on edges.
HazardMap Under() {
  HazardMap map = EmptyMap(200);
  for (int i = 0; i < kPlates; ++i)
    map.hazards.push_back(Plate(i, {-0.49 + 0.07 * (i % 15), -0.455 + 0.07 * (i / 15)}, 0.02));
  return map;
}

struct Floor {
  std::string name;
  std::size_t against;  // the floor that its ratio is taken to
  BodyTwist twist;
  HazardMap map;
  Scene scene;
  std::unique_ptr<Simulation> sim;
  std::vector<double> wheels, k_steps;
};

void Print(const std::string& robot, std::vector<Floor>& floors, int rounds) {
  constexpr int kSteps = 5000;
  for (int round = 0; round < rounds; ++round)
    for (Floor& floor : floors) {
      floor.sim->Reset({});
      floor.sim->SetWheelSpeeds(floor.wheels);
      const auto begin = Clock::now();
      for (int i = 0; i < kSteps; ++i)
        if (!floor.sim->Step())
          throw InternalError(floor.sim->divergence() + " diverged on " + floor.name);
      floor.k_steps.push_back(kSteps / Since(begin) / 1000);
    }
  for (const Floor& floor : floors) {
    std::vector<double> speeds = floor.k_steps, ratios;
    for (std::size_t i = 0; i < speeds.size(); ++i)
      ratios.push_back(speeds[i] / floors[floor.against].k_steps[i]);
    std::ranges::sort(speeds);
    std::ranges::sort(ratios);
    fmt::print("{:8} {:34} {:6.1f} k steps/s, {:3.0f} % of '{}' (step time x{:.2f})\n", robot,
               floor.name, speeds[speeds.size() / 2], 100 * ratios[ratios.size() / 2],
               floors[floor.against].name, 1 / ratios[ratios.size() / 2]);
  }
}

int Main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const HazardMap large = LargeMap();
  for (const char* name : {"htetro", "beluga"}) {
    const RobotModel robot = ReadRobot(FindRobotFile(name, {}));
    const BodyTwist circle{0.2, 0, 0.1}, turn{0, 0, 0.3};
    std::vector<Floor> floors;
    const auto add = [&](std::string floor, std::size_t against, const BodyTwist& twist,
                         const HazardMap& map) {
      floors.push_back({std::move(floor), against, twist, map, {}, {}, {}, {}});
    };
    add("room of 10 m, circle", 0, circle, EmptyMap(200));
    add("the same, on the spot", 1, turn, EmptyMap(200));
    add("200 plates, spread", 0, circle, Spread());
    add("200 plates around it, on the spot", 1, turn, Around());
    add("200 plates under it, on the spot", 1, turn, Under());
    add("map of 4000 x 4000", 0, circle, large);
    for (Floor& floor : floors) {
      const auto begin = Clock::now();
      floor.scene = BuildScene(floor.map, robot, {}, {});
      fmt::print(
          "{:8} {:34} built in {:.2f} s: {} of {} walls in the model, {} hazard geoms\n", name,
          floor.name, Since(begin), floor.scene.num_wall_geoms,
          std::max<std::size_t>(floor.scene.pool.grid.boxes().size(), floor.scene.num_wall_geoms),
          floor.scene.num_hazard_geoms);
      floor.sim = std::make_unique<Simulation>(floor.scene, floor.map, robot.spec);
      floor.wheels.resize(robot.spec.wheels.size());
      const auto drive = MakePlugin(Drives(), robot.spec.drive, "drive");
      drive->Configure(robot.spec);
      drive->ToWheels(floor.twist, floor.wheels);
    }
    Print(name, floors, rounds);
  }
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
