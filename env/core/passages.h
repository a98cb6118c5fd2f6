// SPDX-License-Identifier: Apache-2.0
// Passages of hazards: over them, or past them within reach, as a footprint moves. The same eyes
// look at a plan before the drive (FindPassages) and at a robot on its way (run/episode).
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "env/core/encounter.h"
#include "env/core/hazard_parts.h"
#include "env/core/path.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// What comes nearer to the robot's footprint is within reach.
inline constexpr double kReach_m = 0.1;

// Once a robot has left what it was over, nothing more is counted, though the meeting is open until
// the hazard is out of reach or the robot comes over it again, which is another meeting.
struct Meeting {
  int id = 0;           // counts the watch's meetings
  int hazard = 0;       // index into HazardMap::hazards
  bool over = false;    // the footprint has come to lie over the hazard
  bool inside = false;  // it does now; of what it only passes: it is within reach now
  double gap_m = 0;     // the least
  // Where it entered: came to lie over it, or, as long as it does not, within reach.
  Pose2 X_WB;
  double heading_rad = 0, lead_rad = 0;  // see Approach
  double from_m = 0, to_m = 0;           // the way that was gone there, and where it last was in it
  double width_share = 0;                // see Approach
  double turn_rad = 0;                   // the body turned, both ways added up, in it
  double turn_gap_m = 0;                 // see Approach
};

class PassageWatch {
 public:
  // All outlive it. `hazards`: how many the map has; `hazard`: it watches this one alone, -1: all.
  PassageWatch(HazardParts& parts, std::size_t hazards, const RobotSpec& robot, int hazard = -1);

  // The robot has moved a step, centimetres or less: here it is, going there (unit; zero: not at
  // all), after so much way. `shape`: an index into RobotSpec::shapes; -1: as it was. Allocates
  // nothing once it has met as much at a time.
  void Update(const Pose2& X_WB, const Vec2& travel_W, double along_m, int shape);
  // The robot was carried: what was open has ended where it last was.
  void Lift();

  // Those that go on, and those that ended with the last Update() or Lift().
  std::span<const Meeting> open() const { return open_; }
  std::span<const Meeting> ended() const { return ended_; }

 private:
  // What is seen of a hazard now.
  struct Seen {
    double gap_m = 0;
    Vec2 outward_W = Vec2::Zero();  // normal of the edge that is nearest, of several the one faced
    double low_m = 0, high_m = 0;   // of what lies under the robot, across the way
  };
  // What of an open meeting is nobody else's business.
  struct Track {
    Vec2 outward_W = Vec2::Zero();  // the last edge seen from outside
    double low_m = 0, high_m = 0, width_m = 0;
    bool has_heading = false;
    bool has_left = false;  // what it had been over
  };

  void Stand(const Pose2& X_WB, int shape);
  void Look();
  void LookAt(const HazardParts::Part& part);
  // From the robot's centre to where the hazard, which is near, ends; below 0: it is over it. At
  // most the robot's radius.
  double CentreGap(int hazard) const;
  Meeting Begun(int hazard, double gap_m, double along_m);
  void Follow(double along_m, double turned_rad, bool moves);
  void TakeHeading(Meeting& meeting, Track& track) const;
  std::pair<double, double> Extent(const Polygon& polygon_W) const;

  HazardParts& parts_;
  int only_;
  double radius_m_;
  std::vector<std::vector<Polygon>> shapes_B_;  // each as convex parts
  std::vector<Polygon> footprint_W_;
  int shape_ = 0;
  Pose2 X_WB_;
  bool has_pose_ = false;
  Vec2 travel_W_ = Vec2(1, 0);                        // the last that was not zero
  std::vector<Seen> seen_;                            // by hazard
  std::vector<int> near_;                             // hazards that are seen now, ascending
  std::vector<const HazardParts::Part*> near_parts_;  // theirs, within reach
  std::vector<Meeting> open_, ended_;
  std::vector<Track> tracks_;  // of open_
  Polygon clip_, clipped_;
  int next_id_ = 0;
};

// A passage that a plan wants, and what it will be met with. Speed: the plan's own; no estimate
// error.
struct PlannedPassage {
  int hazard = 0;  // index into HazardMap::hazards
  Passage passage = Passage::kOver;
  Pose2 X_WB;                   // where the robot enters
  double from_m = 0, to_m = 0;  // way of the plan there and where it has left
  Approach at;
};

// Not of a robot's view alone, as the edges of ramps are, and the base floor seen from another:
// these have no keys.
inline bool IsOfTheSite(const Hazard& hazard) { return !hazard.keys.empty(); }

// A hazard's keys as a model can use them, met in this direction (unit): of a slope not which way
// in the world it rises, but how much along the robot's way (rise_along) and across it, to its left
// (rise_across).
std::vector<std::pair<std::string, double>> SizeAsMet(const Hazard& hazard, const Vec2& travel_W);
// The direction in which a passage enters.
inline Vec2 TravelOf(const PlannedPassage& passage) {
  const double yaw_rad = passage.X_WB.yaw_rad + passage.at.lead_rad;
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

// In the order in which they are entered. `map`: with the hazards that are to be found;
// `holds_yaw`: see PathWalk. Takes time as the path's length and what lies near it.
std::vector<PlannedPassage> FindPassages(const HazardMap& map, const RobotSpec& robot,
                                         const Pose2& start, const Path& path, bool holds_yaw);

// The passage of this hazard that a robot is about to begin that stands at X_WB on the way from
// waypoint `segment` to the next, as its path wants it; none: its path does not come within reach
// of it in the next two metres. `parts`: of that map.
std::optional<PlannedPassage> NextPassage(HazardParts& parts, const HazardMap& map,
                                          const RobotSpec& robot, const Pose2& X_WB,
                                          const Path& path, std::size_t segment, bool holds_yaw,
                                          int hazard);

}  // namespace floorproof
