// SPDX-License-Identifier: Apache-2.0
// The ladder: the largest size of each kind of hazard that each robot crosses. Its picture is the
// robot's capability chart.
//
// A cell is a robot that meets a kind of hazard in one direction, at one speed, on one friction, so
// many degrees off square.
// Its limit is found by rungs and bisection (limit_search.h) over single crossings (crossing.h).
// The hazards are what a site file would hold, made by the same plug-ins.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/scene/robot_model.h"
#include "validate/crossing.h"
#include "validate/limit_search.h"

namespace floorproof {

// A kind of hazard with one size that grows.
struct LadderHazard {
  std::string_view name;
  std::string_view size;  // what grows, in words
  std::string_view unit;  // mm or deg
  Rungs rungs;
  double most = 0;  // that there can be of it; 0: of an angle or a share, whose rungs end before
  // How far it reaches along the way from where it begins, m; 0: a level change.
  double (*length_m)(double size);
  // The hazard of this size that begins at the line through the origin across the edge's normal.
  Hazard (*make)(double size, double travel_rad);
};

// step: height of a raised floor. drop: depth of a lowered one. groove: width of a slot 50 mm deep.
// cable_cover: angle of the flanks of one 20 mm high with a top of 50 mm. cable_cover_height: of
// one with flanks of 30 deg. rough: highest bump over 0.6 m at a wavelength of 0.1 m. threshold:
// height of one as at a new door. ramp, ramp_down: slope. carpet: height. lift_sill: how much
// higher the floor lies behind a gap of 32 mm. wet: how much less than 1 a patch of 1 m has of
// friction.
std::span<const LadderHazard> LadderHazards();
const LadderHazard& FindLadderHazard(std::string_view name);

// The direction of travel in the body's frame: x, y, or between the two, with the hazard's edge
// square to it. A robot that is not holonomic meets the edge at 45 degrees instead, and has no
// sideways. Oblique: along x, the edge met at 45 degrees, by a holonomic robot too.
enum class Direction { kForward, kSideways, kDiagonal, kOblique };
std::string_view Name(Direction direction);

// Degrees off square at which hazards are met: what a robot can hold that knows where it is, and
// that a person's drawing of a floor is right to. Charts, and who plans by them, take this value.
inline constexpr double kChartOblique_deg = 3;

struct LadderCell {
  std::string robot;
  std::string wheels = "ideal";
  std::string_view hazard;  // of LadderHazards
  Direction direction = Direction::kForward;
  double speed_mps = 0.2;
  double friction = 0.8;
  RobotChanges changes = {};  // both or none of clearance and mass
  double oblique_deg = kChartOblique_deg;
  double run_up_m = 0.03;  // at speed, before the hazard
  // Whether the robot drives by a plan that knows the hazard and leads over it: whoever goes down
  // there has not fallen, and what is crossed must be crossed in all Tries.
  bool planned = false;
  double scale = 1;       // of the rungs that are lengths
  bool mirrored = false;  // the way and the body turned to the other side
};

struct LadderRow {
  LadderCell cell;
  double limit = 0;        // in the hazard's unit; 0: not even the smallest tried
  bool above_all = false;  // every rung was crossed: the limit is that or more
  std::string held_by;     // what ended the crossing just above the limit (CrossingResult)
};

struct LadderOptions {
  int jobs = 1;
  bool rollers = true;  // rows of roller wheels too, which take most of the time
};

// Every bundled robot, hazard and direction at 0.1, 0.2, 0.3 m/s on friction 0.4, 0.6, 0.8; after
// a robot's ideal wheels its roller wheels (where it has such), on 0.4 and 0.8.
std::vector<LadderCell> LadderCells(const LadderOptions& options);
// How limits move with belly clearance (15 to 30 mm) and mass (0.7, 1 and 1.5 times the model's):
// ideal wheels, 0.2 m/s, friction 0.8.
std::vector<LadderCell> SweepCells();

// How limits move when a hazard is met square, and 0.5 to 10 degrees off; and from farther away:
// ideal wheels, 0.2 m/s, friction 0.8.
std::vector<LadderCell> ObliqueCells();

// For plans of one robot, a bundled one's name or a file: every hazard and direction, edges met at
// 45 degrees among them, at its cruise speed and half of that, on friction 0.4, 0.6, 0.8; ideal
// wheels. Rungs are scaled by its largest driven wheel (RungScale).
std::vector<LadderCell> RobotCells(const std::string& robot);
// The power of two by which rungs are farther apart than those of wheels of 35 to 70 mm radius.
double RungScale(double wheel_radius_m);
// The hazard's rungs, scaled: farther apart, up to a higher one, as fine as before; or nearer and
// finer, up to the same one. Angles and shares as they are.
Rungs ScaledRungs(const LadderHazard& hazard, double scale);

// The ways in which a size is tried: the cell's own; of a plan's also as far off square to the
// other side, from farther away, edges at 45 degrees on the robot's other hand.
std::vector<LadderCell> Tries(const LadderCell& cell);

// The cell's limit; nothing when interrupted. Throws InternalError when the physics diverges.
std::optional<LadderRow> FindRow(const LadderCell& cell);
// How a robot of the cell meets its hazard.
CrossingPlan PlanOf(const LadderCell& cell, const RobotSpec& robot, double size);

// How far a climb is.
struct LadderProgress {
  std::size_t done = 0;  // rows
  double to_go = 0;      // the time that the others will take, in times of what these took
};

// Finds the cells' limits on so many threads; rows in the cells' order whatever finished
// first, without those that an interrupt kept from being found. `on_row` is called once a row, one
// call at a time. Throws as FindRow.
std::vector<LadderRow> ClimbLadder(std::span<const LadderCell> cells, int jobs,
                                   const std::function<void(const LadderProgress&)>& on_row);

// "24.5", or "30 or more".
std::string LimitText(const LadderRow& row);

// Of a row: the bundled name, or that of its file.
std::string RobotName(const LadderCell& cell);

// robot,wheels,hazard,direction,speed_mps,friction,limit,unit
std::string LadderCsv(std::span<const LadderRow> rows);
// The same with clearance_m,mass_kg.
std::string SweepCsv(std::span<const LadderRow> rows);
// The same as ladder.csv with oblique_deg,run_up_m.
std::string ObliqueCsv(std::span<const LadderRow> rows);

}  // namespace floorproof
