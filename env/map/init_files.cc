// SPDX-License-Identifier: Apache-2.0
#include "env/map/init_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/config.h"
#include "base/params.h"
#include "base/quantity.h"
#include "env/core/coverage.h"
#include "env/map/ros_map.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr double kSpare_m = 0.10;  // so that the first turn on the spot brushes nothing

// The largest set of cells joined by sides or corners, of those at least `least` cells from
// obstacles; as a mask, empty when there is none.
Grid<std::uint8_t> LargestPiece(const Grid<float>& clearance, double least) {
  Grid<std::uint8_t> seen(clearance.width, clearance.height);
  std::vector<std::size_t> best, piece;
  const auto w = static_cast<std::ptrdiff_t>(clearance.width);
  const auto open = [&](int ix, int iy) {
    return clearance.Inside(ix, iy) && !seen(ix, iy) && clearance(ix, iy) >= least;
  };
  for (int iy = 0; iy < clearance.height; ++iy)
    for (int ix = 0; ix < clearance.width; ++ix) {
      if (!open(ix, iy)) continue;
      piece = {clearance.Index(ix, iy)};
      seen(ix, iy) = 1;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const int x = static_cast<int>(static_cast<std::ptrdiff_t>(piece[i]) % w);
        const int y = static_cast<int>(static_cast<std::ptrdiff_t>(piece[i]) / w);
        for (int ny = y - 1; ny <= y + 1; ++ny)
          for (int nx = x - 1; nx <= x + 1; ++nx)
            if (open(nx, ny)) {
              seen(nx, ny) = 1;
              piece.push_back(clearance.Index(nx, ny));
            }
      }
      if (piece.size() > best.size()) std::swap(best, piece);
    }
  Grid<std::uint8_t> mask(clearance.width, clearance.height);
  for (const std::size_t i : best) mask.cells[i] = 1;
  return mask;
}

std::string Quoted(const std::string& text) {
  std::string yaml = WriteYaml(ConfigNode::Scalar(text, true));
  yaml.pop_back();  // its line break
  return yaml;
}

std::string Metres(double v) { return FormatDouble(std::round(v * 1000) / 1000); }

std::string Point(const Vec2& p) { return "[" + Metres(p.x()) + ", " + Metres(p.y()) + "]"; }

// A name for people: the map's own, or its folder's where the file is just called map.
std::string NameOf(const fs::path& map_yaml) {
  const fs::path absolute = fs::absolute(map_yaml).lexically_normal();
  const std::string stem = absolute.stem().string();
  const std::string folder = absolute.parent_path().filename().string();
  return stem == "map" && !folder.empty() ? folder : stem;
}

std::string SiteText(const std::string& name, const std::string& map_path, const RosMap& map,
                     const Pose2& start) {
  const auto at = [&](double x, double y) { return Point(start * Vec2(x, y)); };
  const std::string size = std::to_string(map.frame.width) + " x " +
                           std::to_string(map.frame.height) + " cells of " +
                           FormatDouble(map.frame.cell_m) + " m";
  const std::string box =
      "[" + at(1, -0.5) + ", " + at(1.3, -0.5) + ", " + at(1.3, 0.5) + ", " + at(1, 0.5) + "]";
  const std::string across = "[" + at(1.5, -0.6) + ", " + at(1.5, 0.6) + "]";
  const std::string car =
      "[" + at(1, 0.5) + ", " + at(1, -0.5) + ", " + at(2, -0.5) + ", " + at(2, 0.5) + "]";
  const std::string door = "[" + at(2, -0.5) + ", " + at(2, 0.5) + "]";
  return R"(# The floor: what stands on it, and what of that a planner is told.
# Lengths in metres, in the map's own coordinates: x to the right, y up.
site: 1                    # version of this format
name: )" +
         Quoted(name) + R"(
# A ROS map_server file, relative to this one: )" +
         size + R"(
map: )" + Quoted(map_path) +
         R"(
unknown: wall              # cells the map knows nothing of: wall, or free
floor:
  # scenario.yaml draws it anew in each episode (`randomise`: site.floor.friction), and what is drawn
  # wins over what stands here.
  friction: 0.8            # wheels on floor: 0.6 (smooth, dusty) to 1.0 (clean, dry)

# What the map does not show. Take away a '#' to try one; with 'known: false' it lies on the floor
# and the planner is not told. `floorproof list hazards` names all types.
hazards:
#  - {type: step, polygon_m: )" +
         box + R"(, height_m: 0.04, known: false}
#  - {type: cable_cover, line_m: )" +
         across + R"(, height_m: 0.02}
#  - {type: glass, line_m: )" +
         door + R"(, height_m: 2.0}
# What buildings hold:
#  - {type: threshold, line_m: )" +
         across + R"(, height_m: 0.013}     # bevelled 1:2 above 6.4 mm
#  - {type: carpet, polygon_m: )" +
         box + R"(, height_m: 0.006, rolling_drag: 0.012}
#  - {type: ramp, polygon_m: )" +
         box + R"(, slope_deg: 4.8, toward_deg: )" + Metres(start.yaw_rad * 180 / kPi) +
         R"(}   # 1:12
#  - {type: wet, polygon_m: )" +
         box + R"(, friction: 0.3}
#  - {type: lift_sill, polygon_m: )" +
         car + R"(, gap_m: 0.03, level_m: 0.005}   # its first edge is the door
)";
}

// What is drawn of the robot's own, in words and as lines of `randomise`: what its model states.
struct DrawnOfRobot {
  std::string words, lines;
};
DrawnOfRobot DrawOfRobot(const RobotSpec& robot) {
  DrawnOfRobot drawn;
  const auto add = [&](const std::string& word, const std::string& line) {
    drawn.words += (drawn.words.empty() ? "" : " and ") + word;
    drawn.lines += line;
  };
  if (robot.mass_kg > 0)
    add("mass", "  robot.mass_kg: {uniform: [" + Metres(0.95 * robot.mass_kg) + ", " +
                    Metres(1.05 * robot.mass_kg) + "]}   # a full bin, another battery\n");
  if (const auto& volts = robot.battery.voltage_v)
    add("battery's voltage", "  battery.voltage_v: {uniform: [" + Metres(0.9 * *volts) + ", " +
                                 Metres(*volts) + "]}   # drawn low to full\n");
  return drawn;
}

// What nobody knows exactly, as lines of `randomise`.
std::string RandomiseText(const Pose2& start, const DrawnOfRobot& of_robot) {
  const auto around = [](double value, double deviation) {
    return "{normal: [" + Metres(value) + ", " + Metres(deviation) + "]}";
  };
  return "  site.floor.friction: {uniform: [0.6, 1.0]}   # dusty to clean\n"
         "  start.x_m: " +
         around(start.x_m, 0.02) +
         "   # nobody sets it down more exactly\n  start.y_m: " + around(start.y_m, 0.02) + "\n" +
         "  start.yaw_deg: " + around(start.yaw_rad * 180 / kPi, 2) + "\n" + of_robot.lines +
         "  # How wrong its first guess is; `truth` takes no heed, mcl and odometry do.\n"
         "  estimator.start_error_x_m: {normal: [0, 0.1]}\n"
         "  estimator.start_error_y_m: {normal: [0, 0.1]}\n"
         "  estimator.start_error_yaw_deg: {normal: [0, 5]}\n";
}

std::string ScenarioText(const std::string& name, const std::string& robot_key,
                         const RobotSpec& robot, const Pose2& start, double area_m2) {
  const std::string pose = "{x_m: " + Metres(start.x_m) + ", y_m: " + Metres(start.y_m) +
                           ", yaw_deg: " + Metres(start.yaw_rad * 180 / kPi) + "}";
  const DrawnOfRobot drawn = DrawOfRobot(robot);
  const std::string of_robot = drawn.words.empty()
                                   ? ""
                                   : "# `randomise` below draws its " + drawn.words +
                                         ": with another robot change that there, too.\n";
  return R"(# What is tried on the floor: a robot, a plan, and what counts as success.
#   floorproof run scenario.yaml --video      drives it once and films it
#   floorproof campaign scenario.yaml -n 60   drives it 60 times: how often does it fail?
# Results go to out/NAME/ in the current folder: the verdict of `run` to result.json there, that of
# `campaign` to summary.json there, or in the folder campaign/ beside a run.
scenario: 1                # version of this format
name: )" +
         Quoted(name) + R"(
site: site.yaml            # relative to this file
robot: )" +
         Quoted(robot_key) + "\n" + of_robot + R"(# From here about )" +
         std::to_string(std::lround(area_m2)) +
         R"( m^2 can be swept. `randomise` below draws x_m, y_m and yaw_deg about this
# place, and what is drawn wins: to start elsewhere change them there, too.
start: )" +
         pose + R"(

plan:
  planner: boustrophedon   # back and forth; `floorproof list planners` names all
# plan: {file: plan.csv}   # or your own: a first line x_m,y_m, then a waypoint a line

# Told where it is, or finding it out by lidar, wheels and gyro; and whether it goes back from what it meets.
estimator: truth           # mcl, odometry: `floorproof list estimators`, and docs/sensing.md
# react: {then: replan}    # at bumps and drops; without it the plan is driven blindly

success:
  # Minimum coverage for success, as a share of the area that can be swept. The planner covers at
  # least 94 % on most floors; a drive covers one to three percentage points less than its plan. If
  # your own plan covers less, lower this value; 0 turns the check off.
  min_coverage: 0.9

# What nobody knows exactly, drawn anew in each episode (`run` drives episode 0, and says what it
# drew). What is drawn wins over what is written, above and in site.yaml: change it here, or take its
# line away. What `--set KEY=VALUE` sets is not drawn. Without `randomise` all episodes of a campaign
# are one.
randomise:
)" + RandomiseText(start, drawn) +
         R"(
# What a campaign must show: exit status 0 where it does, 1 where it does not, 4 where the episodes
# allow neither. 59 episodes without a failure show a rate below 5 %, fewer cannot: to drive fewer,
# `--set gate=none`.
gate: {metric: not_success, max_rate: 0.05, confidence: 0.95}

seed: 1                    # the same seed gives the same bytes
)";
}

// Of floor that no drive from this start sweeps.
std::string WarnOfFloorOutOfReach(const HazardMap& map, const SweepArea& area) {
  constexpr double kNoticed = 0.2;
  const auto free = std::ranges::count(map.occupancy.cells, CellState::kFree);
  const double free_m2 = static_cast<double>(free) * map.frame.cell_m * map.frame.cell_m;
  if (area.area_m2() >= (1 - kNoticed) * free_m2) return "";
  return "from the start the robot can sweep " + NumberText(area.area_m2()) + " of " +
         NumberText(free_m2) +
         " m2 of free floor; the rest is too narrow for it, or lies beyond what is: to drive "
         "another part, change `start` in scenario.yaml, and what `randomise` draws of it";
}

}  // namespace

Pose2 ChooseStart(const HazardMap& map, const RobotSpec& robot) {
  const ClearanceField field = ComputeClearance(map, robot.step_m);
  const double radius = robot.clear.kind == Shape2::Kind::kCircle ? robot.clear.radius_m
                                                                  : robot.circumscribed_radius_m;
  // Half a cell: a distance is known to the cell's centre only.
  const double least = radius + field.frame.cell_m / 2;
  const Grid<std::uint8_t> piece = LargestPiece(field.distance_m, least);
  std::optional<Cell> corner, widest;
  for (int iy = 0; iy < piece.height; ++iy)
    for (int ix = 0; ix < piece.width; ++ix) {
      if (!piece(ix, iy)) continue;
      if (!widest || field.distance_m(ix, iy) > field.distance_m(*widest)) widest = {ix, iy};
      if (field.distance_m(ix, iy) < least + kSpare_m) continue;
      if (!corner || ix + iy < corner->ix + corner->iy) corner = {ix, iy};
    }
  if (!widest) {
    const float most = *std::ranges::max_element(field.distance_m.cells);
    throw InputError("the map has no place for a robot of radius " + Metres(radius) +
                     " m: its widest spot is " + Metres(most) + " m from the nearest obstacle");
  }
  const Vec2 p = field.frame.Center(corner ? *corner : *widest);
  return {p.x(), p.y(), map.frame.X_WG.yaw_rad};
}

InitFiles MakeInitFiles(const fs::path& map_yaml, const RobotSpec& robot,
                        const fs::path& folder_out, const std::string& robot_key,
                        const std::string& map_key, const InputFiles& inputs) {
  const RosMap ros = ReadRosMap(map_yaml, inputs);
  HazardMap map;
  map.frame = ros.frame;
  map.occupancy = ros.occupancy;
  const Pose2 start = [&] {
    try {
      return ChooseStart(map, robot);
    } catch (const InputError& e) {
      throw InputError({map_yaml.string(), 0}, "", "", e.what());
    }
  }();
  const SweepArea area = ComputeSweepArea(map, robot.clear, robot.tool, robot.step_m, start.p());
  const fs::path from = fs::weakly_canonical(fs::absolute(folder_out.empty() ? "." : folder_out));
  const fs::path relative =
      map_key.empty() ? fs::weakly_canonical(fs::absolute(map_yaml)).lexically_relative(from)
                      : fs::path(map_key);
  const std::string name = NameOf(map_yaml);
  std::vector<std::string> warnings = ros.warnings;
  if (std::string warning = WarnOfFloorOutOfReach(map, area); !warning.empty())
    warnings.push_back(std::move(warning));
  return {
      SiteText(name, relative.string(), ros, start),
      ScenarioText(name, robot_key.empty() ? robot.name : robot_key, robot, start, area.area_m2()),
      std::move(warnings)};
}

}  // namespace floorproof
