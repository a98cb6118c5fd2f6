// SPDX-License-Identifier: Apache-2.0
#include "env/core/passages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "env/core/path_walk.h"
#include "env/core/wall_gap.h"
#include "env/geometry/convex.h"

namespace floorproof {
namespace {

constexpr double kTouch_m = 0.001;              // what overlaps by less only touches
constexpr double kDeepEnough_m = 2 * kTouch_m;  // how deep it lies over it beyond that is not asked
constexpr double kLeave_m = 0.02;    // it is out of reach once it is farther than that beyond it
constexpr double kClear_m = 0.005;   // it has left what it was over once it is that far from it
constexpr double kOnEdge_m = 0.002;  // the nearest place lies on these edges
constexpr int kCorners = 36;         // of a round footprint

std::vector<std::vector<Polygon>> ShapesOf(const RobotSpec& robot) {
  std::vector<std::vector<Polygon>> shapes;
  const auto add = [&](const Polygon& footprint) {
    shapes.push_back(ConvexParts({{footprint, {}}}));
  };
  if (robot.clear.kind == Shape2::Kind::kCircle)
    add(RegularPolygon(Vec2::Zero(), robot.clear.radius_m, kCorners));
  else if (robot.shapes.empty())
    add(robot.clear.footprint_B);
  for (const ShapeSpec& shape : robot.shapes)
    if (robot.clear.kind == Shape2::Kind::kFootprint) add(shape.footprint_B);
  return shapes;
}

// Of the convex polygon's edges that `place` lies on, the normal of the one that a robot which goes
// there faces most; of all of them where it lies within.
Vec2 OutwardAt(const Polygon& polygon, const Vec2& place, const Vec2& travel_W) {
  Vec2 best = Vec2::Zero();
  for (const double near_m : {kOnEdge_m, std::numeric_limits<double>::infinity()}) {
    double most = -2;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (DistanceToSegment(a, b, place) > near_m) continue;
      const Vec2 outward = Vec2(b.y() - a.y(), a.x() - b.x()).normalized();
      const double faced = -travel_W.dot(outward);
      if (faced > most) most = faced, best = outward;
    }
    if (most > -2) break;
  }
  return best;
}

// What of the convex polygon lies on the left of the line from a to b, into `out`.
void KeepLeft(const Polygon& polygon, const Vec2& a, const Vec2& b, Polygon& out) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double left_p = Cross(b - a, p - a), left_q = Cross(b - a, q - a);
    if (left_p >= 0) out.push_back(p);
    if ((left_p < 0) != (left_q < 0)) out.push_back(p + left_p / (left_p - left_q) * (q - p));
  }
}

}  // namespace

PassageWatch::PassageWatch(HazardParts& parts, std::size_t hazards, const RobotSpec& robot,
                           int hazard)
    : parts_(parts),
      only_(hazard),
      radius_m_(robot.circumscribed_radius_m),
      shapes_B_(ShapesOf(robot)),
      seen_(hazards) {
  std::size_t most = 0;
  for (const auto& shape : shapes_B_) most = std::max(most, shape.size());
  footprint_W_.reserve(most);
  constexpr std::size_t kMeetings = 32, kClip = 128;  // at a time; corners
  near_.reserve(kMeetings), open_.reserve(kMeetings), ended_.reserve(kMeetings);
  near_parts_.reserve(kMeetings), tracks_.reserve(kMeetings), clip_.reserve(kClip),
      clipped_.reserve(kClip);
  shape_ = robot.clear.kind == Shape2::Kind::kCircle || robot.shapes.empty() ? 0 : robot.shape;
}

void PassageWatch::Update(const Pose2& X_WB, const Vec2& travel_W, double along_m, int shape) {
  ended_.clear();
  const double turned_rad = has_pose_ ? std::abs(WrapAngle(X_WB.yaw_rad - X_WB_.yaw_rad)) : 0;
  const bool moves = !travel_W.isZero(0);
  if (moves) travel_W_ = travel_W;
  Stand(X_WB, shape);
  Look();
  Follow(along_m, turned_rad, moves);
}

void PassageWatch::Lift() {
  ended_ = open_;
  open_.clear();
  tracks_.clear();
  has_pose_ = false;
}

void PassageWatch::Stand(const Pose2& X_WB, int shape) {
  if (shape >= 0 && static_cast<std::size_t>(shape) < shapes_B_.size()) shape_ = shape;
  const std::vector<Polygon>& parts_B = shapes_B_[static_cast<std::size_t>(shape_)];
  footprint_W_.resize(parts_B.size());
  const Eigen::Matrix2d R_WB = Eigen::Rotation2Dd(X_WB.yaw_rad).toRotationMatrix();
  for (std::size_t i = 0; i < parts_B.size(); ++i) {
    footprint_W_[i].resize(parts_B[i].size());
    for (std::size_t k = 0; k < parts_B[i].size(); ++k)
      footprint_W_[i][k] = R_WB * parts_B[i][k] + X_WB.p();
  }
  X_WB_ = X_WB;
  has_pose_ = true;
}

void PassageWatch::Look() {
  near_.clear();
  near_parts_.clear();
  Box2 box = BoxAround(footprint_W_.front());
  for (const Polygon& part : footprint_W_) {
    const Box2 own = BoxAround(part);
    box.low = box.low.cwiseMin(own.low);
    box.high = box.high.cwiseMax(own.high);
  }
  const Vec2 reach(kReach_m + kLeave_m, kReach_m + kLeave_m);
  parts_.Near(box.low - reach, box.high + reach, [&](const HazardParts::Part& part) {
    if (only_ < 0 || part.hazard == only_) LookAt(part);
  });
}

void PassageWatch::LookAt(const HazardParts::Part& part) {
  Seen& seen = seen_[static_cast<std::size_t>(part.hazard)];
  bool is_near = false;
  for (const Polygon& own : footprint_W_) {
    const Separation apart = Separate(own, part.polygon_W, kDeepEnough_m);
    if (apart.distance_m > kReach_m + kLeave_m) continue;
    is_near = true;
    if (near_.empty() || near_.back() != part.hazard) {
      near_.push_back(part.hazard);
      constexpr double kNone = std::numeric_limits<double>::infinity();
      seen = {.gap_m = kNone, .low_m = kNone, .high_m = -kNone};
    }
    if (apart.distance_m < seen.gap_m) {
      seen.gap_m = apart.distance_m;
      seen.outward_W = OutwardAt(part.polygon_W, apart.place, travel_W_);
    }
    if (apart.distance_m >= -kTouch_m) continue;
    clip_ = own;
    const Polygon& by = part.polygon_W;
    for (std::size_t i = 0; i < by.size() && !clip_.empty(); ++i) {
      KeepLeft(clip_, by[i], by[(i + 1) % by.size()], clipped_);
      std::swap(clip_, clipped_);
    }
    if (clip_.empty()) continue;
    const auto [low_m, high_m] = Extent(clip_);
    seen.low_m = std::min(seen.low_m, low_m);
    seen.high_m = std::max(seen.high_m, high_m);
  }
  if (is_near) near_parts_.push_back(&part);
}

double PassageWatch::CentreGap(int hazard) const {
  constexpr double kInner_m = 1e-6;
  double edge_m = radius_m_;
  bool is_over = false;
  for (const HazardParts::Part* part : near_parts_) {
    if (part->hazard != hazard) continue;
    const Polygon& polygon = part->polygon_W;
    is_over = is_over || SignedDistance(polygon, X_WB_.p()) < 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Vec2 at = a + NearestFraction(a, b, X_WB_.p()) * (b - a);
      const double here_m = (at - X_WB_.p()).norm();
      // Where two parts of it meet it does not end.
      if (here_m < edge_m && std::ranges::none_of(near_parts_, [&](const HazardParts::Part* other) {
            return other != part && other->hazard == hazard &&
                   SignedDistance(other->polygon_W, at) < kInner_m;
          }))
        edge_m = here_m;
    }
  }
  return is_over ? -edge_m : edge_m;
}

// Across the way, from the robot's centre to the left.
std::pair<double, double> PassageWatch::Extent(const Polygon& polygon_W) const {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
  for (const Vec2& p : polygon_W) {
    const double left_m = Cross(travel_W_, p - X_WB_.p());
    low_m = std::min(low_m, left_m);
    high_m = std::max(high_m, left_m);
  }
  return {low_m, high_m};
}

void PassageWatch::TakeHeading(Meeting& meeting, Track& track) const {
  const Vec2& outward = track.outward_W;
  // From the inward normal to the travel.
  meeting.heading_rad = std::atan2(Cross(-outward, travel_W_), -outward.dot(travel_W_));
  meeting.lead_rad = WrapAngle(std::atan2(travel_W_.y(), travel_W_.x()) - meeting.X_WB.yaw_rad);
  track.has_heading = true;
}

Meeting PassageWatch::Begun(int hazard, double gap_m, double along_m) {
  return {.id = next_id_++,
          .hazard = hazard,
          .gap_m = gap_m,
          .X_WB = X_WB_,
          .from_m = along_m,
          .to_m = along_m};
}

void PassageWatch::Follow(double along_m, double turned_rad, bool moves) {
  // What is open and no longer within reach has ended; so has what it was over, left, and comes
  // over again.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const int hazard = open_[i].hazard;
    if (!std::ranges::binary_search(near_, hazard)) {
      ended_.push_back(open_[i]);
      continue;
    }
    open_[kept] = open_[i], tracks_[kept] = tracks_[i];
    const Seen& seen = seen_[static_cast<std::size_t>(hazard)];
    if (tracks_[kept].has_left && seen.gap_m < -kTouch_m) {
      ended_.push_back(open_[kept]);
      open_[kept] = Begun(hazard, seen.gap_m, along_m);
      tracks_[kept] = {.outward_W = tracks_[kept].outward_W};
    }
    ++kept;
  }
  open_.resize(kept), tracks_.resize(kept);

  for (const int hazard : near_) {
    const Seen& seen = seen_[static_cast<std::size_t>(hazard)];
    auto at = std::ranges::find(open_, hazard, &Meeting::hazard);
    const bool begins = at == open_.end();
    if (begins) {
      if (seen.gap_m > kReach_m) continue;
      open_.push_back(Begun(hazard, seen.gap_m, along_m));
      tracks_.push_back({.outward_W = seen.outward_W});
      at = std::prev(open_.end());
    }
    Meeting& meeting = *at;
    Track& track = tracks_[static_cast<std::size_t>(at - open_.begin())];
    const bool under = seen.gap_m < -kTouch_m;
    if (!begins && turned_rad > 0 && (!meeting.over || under || meeting.inside)) {
      meeting.turn_rad += turned_rad;
      meeting.turn_gap_m +=
          turned_rad / meeting.turn_rad * (CentreGap(hazard) - meeting.turn_gap_m);
    }
    if (meeting.over && !under) {
      track.has_left = track.has_left || seen.gap_m > kClear_m;
      track.outward_W = seen.outward_W;
    }
    if (under && !meeting.over) {  // it enters, by the edge that it saw last from outside
      meeting.over = true;
      meeting.X_WB = X_WB_;
      meeting.from_m = along_m;
      meeting.turn_rad = meeting.turn_gap_m = 0;
      track = {.outward_W = track.outward_W,
               .low_m = std::numeric_limits<double>::infinity(),
               .high_m = -std::numeric_limits<double>::infinity()};
    }
    if (!under && !meeting.over && seen.gap_m <= meeting.gap_m) {  // by the edge that is nearest
      track.outward_W = seen.outward_W;
      track.has_heading &= seen.gap_m > meeting.gap_m - 1e-9;
    }
    meeting.inside = under || (!meeting.over && seen.gap_m <= kReach_m);
    meeting.gap_m = std::max(0.0, std::min(meeting.gap_m, seen.gap_m));
    if (moves && !track.has_heading) TakeHeading(meeting, track);
    if (meeting.inside) meeting.to_m = along_m;
    if (!under) continue;
    double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
    for (const Polygon& own : footprint_W_) {
      const auto [low, high] = Extent(own);
      low_m = std::min(low_m, low), high_m = std::max(high_m, high);
    }
    track.width_m = std::max(track.width_m, high_m - low_m);
    track.low_m = std::min(track.low_m, seen.low_m);
    track.high_m = std::max(track.high_m, seen.high_m);
    meeting.width_share = std::clamp((track.high_m - track.low_m) / track.width_m, 0.0, 1.0);
  }
}

namespace {

// What the plan's robot will meet it with.
PlannedPassage Planned(const Meeting& meeting, const HazardMap& map, const RobotSpec& robot,
                       double speed_mps) {
  PlannedPassage planned;
  planned.hazard = meeting.hazard;
  planned.passage = meeting.over ? Passage::kOver : Passage::kBeside;
  planned.X_WB = meeting.X_WB;
  planned.from_m = meeting.from_m;
  planned.to_m = meeting.to_m;
  planned.at = {.heading_rad = meeting.heading_rad,
                .lead_rad = meeting.lead_rad,
                .speed_mps = speed_mps,
                .gap_m = meeting.gap_m,
                .width_share = meeting.width_share,
                .turn_rad = meeting.turn_rad,
                .turn_gap_m = meeting.turn_gap_m,
                .over_m = meeting.to_m - meeting.from_m,
                .wall_m = WallGap(map, robot.clear, meeting.X_WB, kFarWall_m),
                .friction = map.floor_friction,
                .mass_kg = robot.mass_kg,
                .clearance_m = robot.clearance_m};
  return planned;
}

// Of each open meeting, by its id, the plan's speed where it entered.
class EntrySpeeds {
 public:
  void Note(std::span<const Meeting> open, double speed_mps) {
    for (const Meeting& meeting : open) {
      const auto id = static_cast<std::size_t>(meeting.id);
      if (id >= entries_.size()) entries_.resize(id + 1);
      Entry& entry = entries_[id];
      if (entry.from_m == meeting.from_m) continue;
      entry = {meeting.from_m, speed_mps};
    }
  }
  double Of(const Meeting& meeting) const {
    return entries_[static_cast<std::size_t>(meeting.id)].speed_mps;
  }

 private:
  struct Entry {
    double from_m = -1, speed_mps = 0;
  };
  std::vector<Entry> entries_;
};

}  // namespace

namespace {

// By what it is astray now no plan turns.
Pose2 OnCourse(Pose2 X_WB, const Path& path, const RobotSpec& robot, bool holds_yaw,
               std::size_t segment) {
  constexpr double kAstray_rad = 0.3;
  PathWalk walk(path, robot, holds_yaw, X_WB, segment);
  while (walk.pose().travel_W.isZero(0) && walk.Next()) {
  }
  const double yaw_rad = walk.pose().X_WB.yaw_rad;
  if (std::abs(WrapAngle(yaw_rad - X_WB.yaw_rad)) < kAstray_rad) X_WB.yaw_rad = yaw_rad;
  return X_WB;
}

}  // namespace

std::vector<PlannedPassage> FindPassages(const HazardMap& map, const RobotSpec& robot,
                                         const Pose2& start, const Path& path, bool holds_yaw) {
  std::vector<PlannedPassage> found;
  HazardParts parts(map);
  if (path.empty() || parts.empty()) return found;
  PassageWatch watch(parts, map.hazards.size(), robot);
  EntrySpeeds speeds;
  PathWalk walk(path, robot, holds_yaw, start);
  do {
    const PathPose& pose = walk.pose();
    watch.Update(pose.X_WB, pose.travel_W, pose.along_m, pose.shape);
    speeds.Note(watch.open(), pose.speed_mps);
    for (const Meeting& meeting : watch.ended())
      found.push_back(Planned(meeting, map, robot, speeds.Of(meeting)));
  } while (walk.Next());
  for (const Meeting& meeting : watch.open())
    found.push_back(Planned(meeting, map, robot, speeds.Of(meeting)));
  std::ranges::stable_sort(found, {}, &PlannedPassage::from_m);
  return found;
}

std::optional<PlannedPassage> NextPassage(HazardParts& parts, const HazardMap& map,
                                          const RobotSpec& robot, const Pose2& X_WB,
                                          const Path& path, std::size_t segment, bool holds_yaw,
                                          int hazard) {
  constexpr double kAhead_m = 2;
  PassageWatch watch(parts, map.hazards.size(), robot, hazard);
  EntrySpeeds speeds;
  PathWalk walk(path, robot, holds_yaw, OnCourse(X_WB, path, robot, holds_yaw, segment), segment);
  do {
    const PathPose& pose = walk.pose();
    watch.Update(pose.X_WB, pose.travel_W, pose.along_m, pose.shape);
    speeds.Note(watch.open(), pose.speed_mps);
    if (!watch.ended().empty())
      return Planned(watch.ended().front(), map, robot, speeds.Of(watch.ended().front()));
    if (watch.open().empty() && pose.along_m > kAhead_m) return std::nullopt;
  } while (walk.Next());
  if (watch.open().empty()) return std::nullopt;
  return Planned(watch.open().front(), map, robot, speeds.Of(watch.open().front()));
}

std::vector<std::pair<std::string, double>> SizeAsMet(const Hazard& hazard, const Vec2& travel_W) {
  std::vector<std::pair<std::string, double>> size;
  for (const auto& [key, value] : hazard.keys)
    if (key != "toward_deg") size.emplace_back(key, value);
  for (const Solid& solid : hazard.solids) {
    if (!IsSlope(solid)) continue;
    size.emplace_back("rise_along", solid.gradient.dot(travel_W));
    size.emplace_back("rise_across", Cross(travel_W, solid.gradient));
    break;
  }
  return size;
}

}  // namespace floorproof
