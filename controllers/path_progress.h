// SPDX-License-Identifier: Apache-2.0
// How far along its plan a robot is, and where it should head next: what path trackers share.
//
// Progress is monotone. A leg is left once, at its end, and never for a nearer one, so neighbouring
// rows cannot be mixed up. A robot that is past the end of a leg but beside it goes to the corner
// itself. A robot that cannot turn on the spot passes corners wide. Where something is to be done,
// at a dwell and at the end, it must come as near as any other; what it passes beside is missed,
// and it goes on. Whether the next such stop is already reached, or passed, is asked where a leg
// begins at a stop, too. Nothing but Start() and Extend() allocates.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/params.h"
#include "controllers/creep.h"
#include "controllers/missed_stops.h"
#include "controllers/reference_path.h"

namespace floorproof {

// How far ahead on the path the pursued point lies: the distance covered in time_s at the present
// speed, within bounds.
struct Lookahead {
  double time_s = 0.65, min_m = 0.12, max_m = 0.4;
  void Visit(ParamVisitor& v) {
    v("lookahead_s", time_s, Between(0.3, 5), "time ahead of the point that is pursued");
    v("lookahead_min_m", min_m, Between(0.02, 2), "least way to the point pursued");
    v("lookahead_max_m", max_m, Between(0.02, 5), "largest way to the point pursued");
  }
};

class PathProgress {
 public:
  enum class Phase {
    kTurn,   // at a stop, or pushed off: turn towards the way first
    kDrive,  // along the leg
    kFace,   // at a stop: to turn to the yaw at which it dwells, until Faced()
    kDwell,  // standing still on purpose
    kFold,   // at a stop: to take another shape, until Folded()
    kDone,   // last waypoint reached
  };

  void Start(const Path& path, const ReferenceLimits& limits, double corner_tolerance_m);

  // Another way on, mostly the same and longer: this path begins on the segment that is tracked
  // now. Not once it is done. Allocates.
  void Extend(const Path& path);

  // Takes the robot's pose at this time: leaves legs whose end is passed, stops at a corner that is
  // reached, ends dwells.
  void Update(const Pose2& X_WB, double t_s);

  // Its supervision lets it drive at this share of its speed; at 0 it stands where it is.
  void Slow(double share) { is_held_ = share == 0; }

  // Whether Update() would find the last waypoint reached. Where it is near this allocates.
  bool WouldBeDone(const Pose2& X_WB, double t_s) const;

  Phase phase() const { return phase_; }
  bool standing() const { return phase_ == Phase::kFace || phase_ == Phase::kDwell; }
  bool moving() const { return phase_ == Phase::kTurn || phase_ == Phase::kDrive; }
  // To turn where it is now, p_W.
  void Turn(const Vec2& p_W) {
    phase_ = Phase::kTurn;
    turn_W_ = p_W;
  }
  void Drive() { phase_ = Phase::kDrive; }
  // The robot faces as face_rad() says, or cannot: the dwell begins.
  void Faced(double t_s);
  // The robot has taken the shapes of vertex(), or there are none.
  void Folded();
  const ReferencePath& reference() const { return reference_; }
  // Since Start().
  const MissedStops& missed() const { return missed_; }
  // The vertex at which the leg now tracked begins, and the leg itself.
  std::size_t vertex() const { return vertex_; }
  const ReferenceVertex& leg() const { return reference_.vertices[vertex_]; }
  // Only while standing(): what it turned, or turns, to.
  std::optional<double> face_rad() const { return leg().dwells[dwell_].face_rad; }
  // What is done in the dwell that goes on; none while there is no dwell.
  std::span<const WaypointTask> tasks() const {
    return phase_ == Phase::kDwell ? std::span(leg().dwells[dwell_].tasks)
                                   : std::span<const WaypointTask>();
  }
  // Where the present turn, or the last, began: the vertex, or where the robot was on its leg.
  const Vec2& turn_W() const { return turn_W_; }

  // The point to head for and the speed that the way ahead allows. Only while moving().
  struct Aim {
    Vec2 target_W;
    double speed_mps;
  };
  Aim AimFrom(const Vec2& p_W, double speed_mps, const Lookahead& lookahead);

  // For holonomic robots: the path's direction `ahead_m` farther on, the vector back to the leg,
  // across it, and the speed allowed. It looks past one bend at most, so that the direction leads
  // to the end of the leg, and never back again: a robot that slows down for what it saw would see
  // it no more. Only while moving().
  struct Course {
    Vec2 direction_W;  // unit
    Vec2 offset_W;
    double speed_mps;
  };
  Course CourseFrom(const Vec2& p_W, double ahead_m);

  // The plan's segment now tracked; never one of no length. While the robot stands at a stop, until
  // its dwell is over, it is the one that led there: whoever breaks off then has the stop ahead.
  std::size_t Segment(const Vec2& p_W);

 private:
  const ReferenceVertex& Vertex(std::size_t i) const { return reference_.vertices[i]; }
  void Advance(const Pose2& X_WB, double t_s);
  bool Settle(std::size_t vertex, const Pose2& X_WB, double t_s);
  bool IsJudged(std::size_t vertex) const;
  bool HasPassed(std::size_t vertex, const Pose2& X_WB) const;
  void Miss(std::size_t vertex);
  void Arrive(std::size_t vertex, double t_s);
  void BeginDwell(double t_s);
  void EndDwells(double t_s);
  void Depart();
  double Along(const Vec2& p_W) const;
  double SeekAhead(const Vec2& p_W, double way_m);
  double LeftFrom(const Vec2& p_W) const;
  double SpeedFrom(const Vec2& p_W) const;

  // How far off a robot is that drives around a corner on its tightest arc.
  double Wide() const { return 2 * limits_.turn_radius_m; }
  // So near a stop that was not come to along its leg counts as reached.
  double Reach() const;

  ReferenceLimits limits_;
  double corner_tolerance_m_ = 0;
  ReferencePath reference_;
  Phase phase_ = Phase::kDone;
  MissedStops missed_;
  bool homing_ = false;  // going to vertex goal_ itself instead of along the leg
  std::size_t goal_ = 0;
  bool leg_begins_ = false;  // at a stop: how its end lies is not asked yet
  std::size_t vertex_ = 0;   // the leg now tracked goes from here to the next
  std::size_t ahead_ = 0;    // the leg that holds the point pursued, or whose direction is taken
  double seen_m_ = 0;        // how far before its bend that direction was taken
  Vec2 turn_W_ = Vec2::Zero();
  std::size_t waypoint_ = 0;  // the plan's segment now tracked
  std::size_t dwell_ = 0;     // of vertex_'s
  double dwell_until_s_ = 0;
  Creep creep_{Creep::kAlong};  // the leg now tracked
  bool is_held_ = false;        // commanded to stand by its supervision
};

}  // namespace floorproof
