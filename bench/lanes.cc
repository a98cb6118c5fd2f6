// SPDX-License-Identifier: Apache-2.0
// What a planner of unknown floors makes of floors as they are, without physics: a robot that
// follows its navigator's way exactly and draws its map with a lidar. For every scenario: coverage,
// the way over that of the plan that boustrophedon makes knowing the map, the dead ends, the least
// distance of the robot's centre from a wall, and the planner's step in CPU time: median, 99th
// percentile, longest.
//   bench_lanes SCENARIO...
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include "base/streams.h"
#include "env/core/coverage.h"
#include "planners/lines/held_yaw.h"
#include "run/episode/make_navigator.h"
#include "run/episode/make_plan.h"
#include "run/scenario/agents.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

constexpr double kStep_m = 0.025;  // from scan to scan
constexpr int kBeams = 90;
constexpr double kLook_s = 0.1;

// Passes the calls on, and times them.
class Timed final : public OnlinePlanner {
 public:
  Timed(std::unique_ptr<OnlinePlanner> planner, std::vector<double>& step_s)
      : planner_(std::move(planner)), step_s_(step_s) {}
  void Visit(ParamVisitor& v) override { planner_->Visit(v); }
  const OnlineParams& params() const override { return planner_->params(); }
  void Start(const OnlineTask& task) override { planner_->Start(task); }
  OnlineStep Next(const OnlineInput& input) override {
    const std::clock_t asked = std::clock();
    const OnlineStep step = planner_->Next(input);
    step_s_.push_back(static_cast<double>(std::clock() - asked) / CLOCKS_PER_SEC);
    return step;
  }
  std::vector<std::pair<std::string, double>> figures() const override {
    return planner_->figures();
  }

 private:
  std::unique_ptr<OnlinePlanner> planner_;
  std::vector<double>& step_s_;
};

// A lidar over a grid of walls.
class GridLidar {
 public:
  GridLidar(const HazardMap& map, double step_m)
      : frame_(FineFrame(map.frame)),
        walls_(ObstacleMask(map, step_m, frame_)),
        noise_(1, 0, "lidar") {}

  void Scan(const Pose2& X_WB, LidarScan& scan) {
    scan.fresh = true;
    scan.angle_rad.resize(kBeams);
    scan.range_m.resize(kBeams);
    for (std::size_t i = 0; i < kBeams; ++i) {
      scan.angle_rad[i] = 2 * kPi * static_cast<double>(i) / kBeams;
      const double range_m = Range(X_WB.p(), X_WB.yaw_rad + scan.angle_rad[i]);
      scan.range_m[i] = range_m + (0.005 + 0.005 * range_m) * noise_.Normal();
    }
  }

 private:
  double Range(const Vec2& from_W, double angle_rad) const {
    const Vec2 from_G = frame_.ToGrid(from_W);
    const Vec2 way = frame_.X_WG.Inverse().Rotate(Vec2(std::cos(angle_rad), std::sin(angle_rad)));
    constexpr double kMost_m = 25, kStride_m = 0.004;
    for (double r = 0; r < kMost_m; r += kStride_m) {
      const Vec2 p = (from_G + r * way) / frame_.cell_m;
      const Cell c = {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
      if (!walls_.Inside(c)) return std::numeric_limits<double>::infinity();
      if (walls_(c)) return r;
    }
    return std::numeric_limits<double>::infinity();
  }

  GridFrame frame_;
  Grid<std::uint8_t> walls_;
  Stream noise_;
};

struct Found {
  double length_m = 0, coverage = 0, least_gap_m = std::numeric_limits<double>::infinity();
  double dead_ends = 0;
  std::vector<double> step_s;
};

Found Drive(const Scenario& s) {
  Found found;
  Agents agents = MakeAgents(s.spec);
  Timed online(std::move(agents.online), found.step_s);
  const RobotSpec& robot = s.world.robot.spec;
  const HazardMap known = KnownFloor(s.world), truth = TrueFloor(s.world);
  const SweepArea area =
      ComputeSweepArea(truth, robot.clear, robot.tool, robot.step_m, s.world.start.p());
  CoverageMeter meter(area, robot.tool);
  const auto navigator = MakeNavigator(s.spec, s.world, &online, {}, known);
  Mapper mapper = *agents.mapper;
  mapper.Start(known.frame, robot, true);
  GridLidar lidar(truth, robot.step_m);
  const ClearanceField gaps = ComputeClearance(truth, robot.step_m);
  const bool holds = HoldYaw(known, s.world.start, robot.clear, robot.tool).yaw_rad.has_value();

  Observation sensed;
  Estimate estimate;
  estimate.X_WB = s.world.start;
  std::size_t segment = 0;
  bool at_end = true;
  for (int idle = 0; idle < 1000;) {
    sensed.t_s += kLook_s;
    lidar.Scan(estimate.X_WB, sensed.scan);
    mapper.Update(sensed, estimate);
    meter.Add(estimate.X_WB);
    found.least_gap_m = std::min(found.least_gap_m, gaps.At(estimate.X_WB.p()));
    const PathChange change =
        navigator->Update({sensed.t_s, estimate, &mapper.map(), segment, at_end});
    mapper.ForgetChanges();
    if (at_end && navigator->leads() != Navigator::Leads::kOn) break;
    if (change != PathChange::kNone) segment = 0;
    ++idle;
    const Path& path = navigator->path();
    for (double left_m = kStep_m; left_m > 0 && segment + 1 < path.size();) {
      const Vec2 way_W = path[segment + 1].p_W - estimate.X_WB.p();
      const double way_m = way_W.norm(), gone_m = std::min(left_m, way_m);
      if (gone_m > 0) {
        idle = 0;
        const Vec2 p_W = estimate.X_WB.p() + way_W / way_m * gone_m;
        estimate.X_WB = {p_W.x(), p_W.y(),
                         holds ? s.world.start.yaw_rad : std::atan2(way_W.y(), way_W.x())};
      }
      found.length_m += gone_m;
      left_m -= gone_m;
      if (gone_m == way_m) ++segment;
    }
    at_end = segment + 1 >= path.size();
    if (at_end) segment = path.size() < 2 ? 0 : path.size() - 2;
  }
  found.coverage = meter.coverage();
  for (const auto& [name, value] : online.figures())
    if (name == "dead_ends") found.dead_ends = value;
  return found;
}

void Run(const char* file) {
  const std::vector<Override> truth = {{"randomise", "null"}, {"estimator", "truth"}};
  std::vector<Override> unknown = truth;
  unknown.push_back({"plan.planner", "frontier_coverage"});
  Scenario s = ReadScenario(file, unknown);
  std::vector<Override> beforehand = truth;
  beforehand.push_back({"plan.planner", "boustrophedon"});
  const double plan_m = Length(MakePlan(ReadScenario(file, beforehand)).path);
  Found found = Drive(s);
  std::ranges::sort(found.step_s);
  const auto ms = [&](double share) {
    return 1e3 * found.step_s[static_cast<std::size_t>(
                     share * static_cast<double>(found.step_s.size() - 1))];
  };
  fmt::print(
      "{:14} {:7} covered {:5.1f} %, way x {:.3f}, dead ends {:4.0f}, least {:3.0f} mm; step "
      "median {:.2f} ms, 99 % {:.2f}, longest {:.1f}\n",
      s.world.site.map.name, s.spec.robot_name, 100 * found.coverage, found.length_m / plan_m,
      found.dead_ends, 1000 * found.least_gap_m, ms(0.5), ms(0.99), ms(1));
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) floorproof::Run(argv[i]);
}
