// SPDX-License-Identifier: Apache-2.0
// Plans over real maps: seconds of one core, coverage, length against sweepable area / tool width,
// turns.
//   bench_plan_maps FOLDER [PLANNER] [KEY=VALUE ...]
// FOLDER holds one folder a map, each with map.yaml. For every map two tools, a disc of 0.30 m with
// a circle of 0.18 m kept clear and one of 0.50 m with 0.35 m, each with and without edges. The
// start is the widest place of the largest connected floor. Each plan is measured against its own
// clear shape, and the least distance from its segments to a wall by a ruler of its own.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "env/core/coverage.h"
#include "env/map/site.h"
#include "planners/planner.h"

namespace floorproof {
namespace {

struct Tool {
  double width_m, radius_m;
};
constexpr Tool kTools[] = {{0.30, 0.18}, {0.50, 0.35}};

// The cell with the most room in the largest 8-connected part of the floor that a circle fits on.
Vec2 WidestPlace(const HazardMap& map, double radius_m, double step_m) {
  const ClearanceField field = ComputeClearance(map, step_m);
  const auto fits = [&](Cell c) {
    return field.frame.Inside(c) && static_cast<double>(field.distance_m(c)) >= radius_m;
  };
  Grid<std::uint8_t> seen(field.frame.width, field.frame.height);
  Cell best;
  std::size_t most = 0;
  for (int iy = 0; iy < seen.height; ++iy)
    for (int ix = 0; ix < seen.width; ++ix) {
      if (seen(ix, iy) || !fits({ix, iy})) continue;
      std::vector<Cell> part = {{ix, iy}};
      seen(ix, iy) = 1;
      Cell widest = part[0];
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Cell at = part[i];
        if (field.distance_m(at) > field.distance_m(widest)) widest = at;
        for (int k = 0; k < 9; ++k) {
          const Cell next{at.ix + k % 3 - 1, at.iy + k / 3 - 1};
          if (!fits(next) || seen(next)) continue;
          seen(next) = 1;
          part.push_back(next);
        }
      }
      if (part.size() > most) most = part.size(), best = widest;
    }
  return field.frame.Center(best);
}

double LeastClearance(const HazardMap& map, const Path& path, double reach_m) {
  const double cell = map.frame.cell_m;
  const int reach = static_cast<int>(std::ceil(reach_m / cell)) + 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 a = path[i - 1].p_W, d = path[i].p_W - a;
    const int steps = std::max(1, static_cast<int>(std::ceil(d.norm() / 0.01)));
    for (int s = 0; s <= steps; ++s) {
      const Vec2 p = map.frame.ToGrid(a + d * s / steps) / cell;
      const int cx = static_cast<int>(std::floor(p.x())), cy = static_cast<int>(std::floor(p.y()));
      for (int iy = cy - reach; iy <= cy + reach; ++iy)
        for (int ix = cx - reach; ix <= cx + reach; ++ix) {
          if (!map.IsWall(ix, iy)) continue;
          const double dx = std::max({0.0, ix - p.x(), p.x() - ix - 1});
          const double dy = std::max({0.0, iy - p.y(), p.y() - iy - 1});
          least = std::min(least, std::hypot(dx, dy) * cell);
        }
    }
  }
  return least;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
}

struct Totals {
  std::vector<double> seconds, coverage, ratio, short_of_clear;
};

void PlanOne(const std::string& name, const HazardMap& map, const Tool& tool, bool edges,
             const std::string& planner, const ConfigNode& extra, Totals& totals) {
  RobotSpec robot;
  robot.step_m = 0.01;
  ConfigNode params = extra;
  params.Add("tool_width_m", ConfigNode::Scalar(FormatDouble(tool.width_m)));
  params.Add("radius_m", ConfigNode::Scalar(FormatDouble(tool.radius_m)));
  params.Add("edges", ConfigNode::Scalar(edges ? "true" : "false"));
  const auto dut = MakePlugin(Planners(), planner, "planner");
  ReadParams(params, "plan.", *dut);
  const Vec2 start = WidestPlace(map, tool.radius_m, robot.step_m);

  const std::clock_t begin = std::clock();
  const PlanResult plan = dut->Plan({map, robot, {start.x(), start.y(), 0}, std::nullopt, 0});
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (plan.status != PlanStatus::kSuccess) {
    fmt::print("{:15} {:.2f} {}\n", name, tool.width_m, plan.message);
    totals.coverage.push_back(0);
    return;
  }
  const SweepArea area = ComputeSweepArea(map, plan.clear, plan.tool, robot.step_m, start);
  const PathCoverage swept = MeasureCoverage(area, plan.tool, plan.path);
  const double length = Length(plan.path), ratio = length * tool.width_m / area.area_m2();
  const double clearance = LeastClearance(map, plan.path, tool.radius_m + 0.1);
  const double short_of = (tool.radius_m - clearance) / area.frame.cell_m;
  fmt::print("{:15} {:.2f} {:5} {:6.2f} {:9.2f} {:8.2f} {:7.3f} {:8.0f} {:6} {:7.3f} {:6.2f}\n",
             name, tool.width_m, edges ? "yes" : "no", seconds, 100 * swept.coverage,
             100 * swept.overlap, ratio, length, CountTurns(plan.path), clearance, short_of);
  std::cout.flush();
  totals.seconds.push_back(seconds);
  totals.coverage.push_back(swept.coverage);
  totals.ratio.push_back(ratio);
  totals.short_of_clear.push_back(short_of);
}

int Main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: bench_plan_maps FOLDER [PLANNER] [KEY=VALUE ...]\n";
    return 2;
  }
  const std::string planner = argc > 2 ? argv[2] : "boustrophedon";
  ConfigNode extra = ConfigNode::Map();
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    const auto equals = word.find('=');
    if (equals == std::string::npos) throw InputError(word + ": must be KEY=VALUE");
    extra.Add(word.substr(0, equals), ConfigNode::Scalar(word.substr(equals + 1)));
  }
  std::vector<std::filesystem::path> maps;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
    if (std::filesystem::exists(entry.path() / "map.yaml")) maps.push_back(entry.path());
  std::sort(maps.begin(), maps.end());

  for (const bool edges : {false, true}) {
    fmt::print("{:15} {:4} {:5} {:>6} {:>9} {:>8} {:>7} {:>8} {:>6} {:>7} {:>6}\n", "map", "tool",
               "edges", "s", "coverage%", "overlap%", "ratio", "length_m", "turns", "clear_m",
               "short");
    Totals totals;
    for (const auto& folder : maps) {
      const RosMap ros = ReadRosMap(folder / "map.yaml");
      HazardMap map;
      map.frame = ros.frame;
      map.occupancy = ros.occupancy;
      for (const Tool& tool : kTools)
        PlanOne(folder.filename().string(), map, tool, edges, planner, extra, totals);
    }
    if (totals.ratio.empty()) continue;
    fmt::print(
        "coverage: least {:.2f} %, median {:.2f} %; ratio: median {:.3f}, most {:.3f}; most "
        "seconds {:.2f}; most short of the clear radius: {:.2f} fine cells\n\n",
        100 * *std::min_element(totals.coverage.begin(), totals.coverage.end()),
        100 * Median(totals.coverage), Median(totals.ratio),
        *std::max_element(totals.ratio.begin(), totals.ratio.end()),
        *std::max_element(totals.seconds.begin(), totals.seconds.end()),
        *std::max_element(totals.short_of_clear.begin(), totals.short_of_clear.end()));
  }
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
