// SPDX-License-Identifier: Apache-2.0
// What risk costs: RF of 1000 x 1000 cells with 10,000 hazards, against the bare transforms of a
// convolution of that size; plans over 200 x 200 cells, against the conventional planner's.
//   bench_risk models/fmea/htetro.yaml
#include <fmt/core.h>

#include <chrono>
#include <limits>
#include <opencv2/core.hpp>

#include "base/streams.h"
#include "env/scene/robot_model.h"
#include "planners/planner.h"
#include "planners/risk/risk_map.h"
#include "run/scenario/fmea_file.h"

namespace floorproof {
namespace {

template <class Work>
double LeastSeconds(int rounds, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count());
  }
  return least;
}

// Hazards of all four classes, each a cell; the corners stay free.
HazardMap Strewn(int side, int hazards, const char* stream) {
  Stream random(0, 0, stream);
  const auto below = [&] {
    return static_cast<int>(random.Below(static_cast<std::uint64_t>(side)));
  };
  HazardMap map;
  constexpr double kCell_m = 0.5;
  map.frame = {side, side, kCell_m, {}};
  map.occupancy = Grid<CellState>(side, side, CellState::kFree);
  Grid<std::uint8_t> taken(side, side);
  taken(0, 0) = taken(side - 1, side - 1) = 1;
  for (int placed = 0; placed < hazards;) {
    const int ix = below(), iy = below();
    if (taken(ix, iy)++) continue;
    ++placed;
    const auto hazard_class = static_cast<HazardClass>(random.Below(4));
    if (hazard_class == HazardClass::kBlindObject) {
      map.occupancy(ix, iy) = CellState::kOccupied;
      continue;
    }
    Hazard& hazard = map.hazards.emplace_back();
    hazard.hazard_class = hazard_class;
    const Vec2 low(ix * kCell_m, iy * kCell_m);
    hazard.footprint = {Rectangle(low, low + Vec2(kCell_m, kCell_m))};
  }
  return map;
}

void BenchRiskMap(const RobotSpec& robot, const FmeaTables& tables) {
  constexpr int kSide = 1000, kRounds = 5;
  const HazardMap map = Strewn(kSide, 10'000, "million");
  const double ours_s = LeastSeconds(kRounds, [&] { ComputeRisk(map, robot, tables); });
  const int size = cv::getOptimalDFTSize(2 * kSide);
  cv::Mat1d a(size, size, 1.0), b(size, size, 1.0);
  const double bare_s = LeastSeconds(kRounds, [&] {
    cv::dft(a, a);
    cv::dft(b, b);
    cv::dft(a, a, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  });
  fmt::print("RF of {0} x {0} cells: {1:.3f} s, {2:.2f} of three bare transforms\n", kSide, ours_s,
             ours_s / bare_s);
}

void BenchPlanners(const RobotSpec& robot, const FmeaTables& tables) {
  constexpr int kSide = 200, kRounds = 3;
  const HazardMap map = Strewn(kSide, 1200, "hall");
  const RiskMap risk = ComputeRisk(map, robot, tables);
  const double corner = 0.25, far = kSide * 0.5 - corner;
  double conventional_s = 0;
  for (const char* name : {"path_transform", "fmea_path_transform", "risk_coverage"}) {
    const auto planner = MakePlugin(Planners(), name, "planner");
    PlanResult plan;
    const double s = LeastSeconds(kRounds, [&] {
      plan = planner->Plan({map, robot, {corner, corner, 0}, Vec2(far, far), 0, &risk});
    });
    if (conventional_s == 0) conventional_s = s;
    fmt::print("{} over {} x {} cells: {}, {:.3f} s, {:.1f} of path_transform\n", name, kSide,
               kSide, Name(plan.status), s, s / conventional_s);
  }
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  using namespace floorproof;
  if (argc != 2) {
    fmt::print(stderr, "usage: bench_risk TABLES.yaml\n");
    return 2;
  }
  const RobotSpec robot = ReadRobot(FindRobotFile("htetro", {})).spec;
  const FmeaTables tables = ReadFmeaTables(argv[1]);
  BenchRiskMap(robot, tables);
  BenchPlanners(robot, tables);
}
