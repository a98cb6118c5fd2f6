// SPDX-License-Identifier: Apache-2.0
// The ground that a robot's tool can sweep, and how much of it was swept. Planners and the episode
// measure with the same ruler (design: metrics.coverage, metrics.overlap).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// The map's cells subdivided until they are at most max_cell_m.
GridFrame FineFrame(const GridFrame& frame, double max_cell_m = 0.05);
// 1 where a cell of `fine` lies in a wall of the map. `fine`: the map's frame, subdivided.
Grid<std::uint8_t> WallMask(const HazardMap& map, const GridFrame& fine);

// 1 where a fine cell is wall, or touches a hazard that IsObstacle(step_m). `fine` divides the
// map's own frame (FineFrame). A level change does not count where a later floor that can be driven
// covers it.
Grid<std::uint8_t> ObstacleMask(const HazardMap& map, double step_m, const GridFrame& fine);

// Distances to obstacles, for planners and controllers.
struct ClearanceField {
  GridFrame frame;
  Grid<float> distance_m;            // from a cell's centre to the nearest obstacle's area
  double At(const Vec2& p_W) const;  // 0 beyond the grid
};
ClearanceField ComputeClearance(const HazardMap& map, double step_m);

// Where the robot's centre may be, connected to the start, and what its tool sweeps from there.
struct SweepArea {
  GridFrame frame;               // cells of at most 0.05 m
  Grid<float> clearance_m;       // centre to the nearest obstacle's area
  Grid<std::uint8_t> reachable;  // poses: clear shape free of solids, connected to the start
  Grid<std::uint8_t> sweepable;  // cells whose centre the tool reaches from a reachable pose
  // Cells that an obstacle separates from the centre of a reachable pose within the tool's reach.
  // Such a pose does not sweep them. Empty unless a disc reaches past an obstacle.
  Grid<std::uint8_t> hidden;
  std::int64_t sweepable_cells = 0;
  double area_m2() const {
    return static_cast<double>(sweepable_cells) * frame.cell_m * frame.cell_m;
  }
};
enum class Yaws {
  kQuarters,  // all four
  kFirst,     // the map's own yaw alone: for a footprint that is never turned
};

// What the sweepable areas of one floor have in common, whatever drives there.
class FloorRoom {
 public:
  // Walls are taken as built, that is, drawn back by map.inset_m.
  FloorRoom(const HazardMap& map, double step_m);
  // `clear` and `tool` are those of RobotSpec, or discs from a plan's radius_m and tool_width_m. A
  // clear footprint is tried at yaws that are multiples of 90 deg in the map's frame, and so is a
  // tool's. A circle moves between 8 neighbours, a footprint between 4. The area is empty
  // (sweepable_cells 0) when the start itself is not clear, to within its cell.
  SweepArea Sweepable(const Shape2& clear, const Shape2& tool, const Vec2& start_W,
                      Yaws yaws = Yaws::kQuarters) const;
  // Poses whose clear shape is free of solids, connected to the start or not: one layer for a
  // circle, else one for each yaw.
  std::vector<Grid<std::uint8_t>> Free(const Shape2& clear, Yaws yaws) const;
  // The area that these poses make, as layers of Free or one layer for all yaws.
  SweepArea SweptFrom(const std::vector<Grid<std::uint8_t>>& poses, const Shape2& tool,
                      Yaws yaws) const;
  // For a robot that starts in a place too narrow for its clear circle: the first place straight
  // ahead where the circle fits. None if it is no circle, or if the outline meets an obstacle on
  // the way there. Obstacles at the start itself are not looked for.
  std::optional<Vec2> WidePlaceAhead(const RobotSpec& robot, const Shape2& clear,
                                     const Pose2& start) const;

 private:
  void SweepInSight(double radius_cells, SweepArea& area) const;

  GridFrame frame_;
  double inset_m_;
  Grid<std::uint8_t> walls_, hazards_;
  bool any_hazard_ = false;
  Grid<float> clearance_m_;
};
// Of this robot. If its clear circle does not fit at the start, the area begins at
// WidePlaceAhead().
SweepArea ComputeSweepArea(const HazardMap& map, const RobotSpec& robot, const Shape2& clear,
                           const Shape2& tool, const Pose2& start);
// Of one robot from one start.
SweepArea ComputeSweepArea(const HazardMap& map, const Shape2& clear, const Shape2& tool,
                           double step_m, const Vec2& start_W, Yaws yaws = Yaws::kQuarters);

// Marks what the tool sweeps as it moves: the cells whose centre it passes over, for a footprint to
// within 2 mm. A disc that reaches past obstacles sweeps only what is in sight of its centre. Add()
// costs O(tool area) and allocates nothing.
class CoverageMeter {
 public:
  CoverageMeter(const SweepArea& area, const Shape2& tool);
  // Sweeps with this tool from now on; the next Add() starts afresh.
  void SetTool(const Shape2& tool);
  // The tool moved in a straight line from the last pose to this one (the first only stands).
  void Add(const Pose2& X_WB);
  // The tool was carried: the next Add() starts afresh.
  void Lift() { has_last_ = false; }
  // Of the sweepable cells: the share swept (J_hc), and that swept in two or more passes (J_cc);
  // the passes beyond each cell's first. 0 if there are none.
  double coverage() const { return OfSweepable(swept_); }
  double revisited() const { return OfSweepable(twice_); }
  double extra() const { return OfSweepable(passed_ - swept_); }
  double overlap() const;  // of the swept cells, the share swept in two or more passes
  // Passes per fine cell (saturating at 255): a new pass begins when the tool comes back to a cell
  // after travelling more than twice its own width since it last touched it.
  const Grid<std::uint8_t>& passes() const { return passes_; }

 private:
  double OfSweepable(std::int64_t cells) const;
  void SweepDisc(const Vec2& from_G, const Vec2& to_G, double length_m);
  bool SeesOnTheWay(const Vec2& from_G, const Vec2& dir, double first, double last,
                    const Vec2& cell_G) const;
  void StampFootprint(const Pose2& X_GB, double s_m);
  void Touch(int ix, int iy, double enter_s_m, double leave_s_m);
  const SweepArea* area_;
  Shape2 tool_;
  Grid<std::uint8_t> passes_;
  Grid<float> last_s_m_;
  Pose2 last_;
  bool has_last_ = false;
  double s_m_ = 0, gap_m_ = 0, reach_m_ = 0;
  Polygon footprint_G_;            // of the tool where it is, in cells
  std::vector<double> crossings_;  // of a row with its edges
  std::int64_t swept_ = 0, twice_ = 0, passed_ = 0;
};

// Coverage and overlap of a path driven exactly.
struct PathCoverage {
  double coverage = 0, overlap = 0;
};
PathCoverage MeasureCoverage(const SweepArea& area, const Shape2& tool, const Path& path);

}  // namespace floorproof
