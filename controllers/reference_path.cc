// SPDX-License-Identifier: Apache-2.0
#include "controllers/reference_path.h"

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kSamePointM = 1e-6;
constexpr double kNoBendRad = 1e-3;
// Bends that follow each other within this are taken as one: the curvature of a polyline is its
// turning over a length, not at a point.
constexpr double kBendWindowM = 0.15;

double TurnAngle(const Vec2& a, const Vec2& b) { return std::atan2(Cross(a, b), a.dot(b)); }

// The straights from an anchor that pass all points so far within a tolerance, as a cone of
// directions (sector test; Williams 1978, "Smoothed polylines").
class Cone {
 public:
  Cone(const Vec2& apex, double tolerance_m) : apex_(apex), tolerance_m_(tolerance_m) {}

  // Whether the straight from the apex to p passes all points added, none of them lying beyond p.
  bool Reaches(const Vec2& p) const {
    const Vec2 d = p - apex_;
    const double way_m = d.norm();
    if (way_m < farthest_m_ - tolerance_m_) return false;
    if (!bounded_) return true;
    if (way_m <= tolerance_m_) return false;
    const double angle = TurnAngle(axis_, d);
    return angle >= low_rad_ && angle <= high_rad_;
  }
  void Add(const Vec2& p) {
    const Vec2 d = p - apex_;
    const double way_m = d.norm();
    farthest_m_ = std::max(farthest_m_, way_m);
    if (way_m <= tolerance_m_) return;
    const double half_rad = std::asin(tolerance_m_ / way_m);
    if (!bounded_) {
      axis_ = d / way_m;
      low_rad_ = -half_rad;
      high_rad_ = half_rad;
      bounded_ = true;
      return;
    }
    const double angle = TurnAngle(axis_, d);
    low_rad_ = std::max(low_rad_, angle - half_rad);
    high_rad_ = std::min(high_rad_, angle + half_rad);
  }

 private:
  Vec2 apex_, axis_ = Vec2::Zero();
  double tolerance_m_ = 0, farthest_m_ = 0;
  double low_rad_ = 0, high_rad_ = 0;
  bool bounded_ = false;
};

double Speed(const Waypoint& waypoint, const ReferenceLimits& limits) {
  const double speed = waypoint.speed_mps > 0 ? waypoint.speed_mps : limits.cruise_mps;
  return std::min(speed, limits.max_speed_mps);
}

std::optional<double> HeldYaw(const Waypoint& waypoint, const ReferenceLimits& limits) {
  return limits.holds_yaw ? waypoint.yaw_rad : std::nullopt;
}

bool SameYaw(const std::optional<double>& a, const std::optional<double>& b) {
  constexpr double kSameRad = 1e-6;
  if (!a || !b) return !a && !b;
  return std::abs(WrapAngle(*a - *b)) < kSameRad;
}

// Indices of the waypoints that become vertices. A waypoint at the same place as the last vertex
// becomes none; it dwells there.
struct Kept {
  std::size_t index = 0;
  std::vector<ReferenceDwell> dwells;
  std::vector<std::string> shapes;  // of the waypoints at this place
};
std::vector<Kept> KeepCorners(const Path& path, const ReferenceLimits& limits) {
  std::vector<Kept> kept = {{0, {}, {path[0].shape}}};
  const auto stand = [&](const Waypoint& w) {
    if (w.dwell_s == 0 && !w.task) return;
    const std::optional<double> face_rad = limits.faces ? w.yaw_rad : std::nullopt;
    std::vector<ReferenceDwell>& dwells = kept.back().dwells;
    const bool turns = w.dwell_s > 0 && face_rad && !dwells.empty() && dwells.back().time_s > 0 &&
                       !SameYaw(dwells.back().face_rad, face_rad);
    if (dwells.empty() || turns) dwells.emplace_back();
    ReferenceDwell& dwell = dwells.back();
    dwell.time_s += w.dwell_s;
    if (w.dwell_s > 0 && !dwell.face_rad) dwell.face_rad = face_rad;
    if (w.task) dwell.tasks.push_back(*w.task);
  };
  stand(path[0]);
  Cone cone(path[0].p_W, limits.straight_m);
  std::size_t last = 0;  // that was kept, at a vertex of its own or not
  const auto keep = [&](std::size_t i) {
    last = i;
    if ((path[i].p_W - path[kept.back().index].p_W).norm() < kSamePointM) {
      kept.back().shapes.push_back(path[i].shape);
    } else {
      kept.push_back({i, {}, {}});
    }
    stand(path[i]);
    cone = Cone(path[i].p_W, limits.straight_m);
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool same_shape =
        !limits.folds || path[i].shape.empty() || path[i].shape == path[i - 1].shape;
    const bool same_leg = same_shape && Speed(path[i], limits) == Speed(path[i - 1], limits) &&
                          SameYaw(HeldYaw(path[i], limits), HeldYaw(path[i - 1], limits));
    if (i - 1 > last && (!same_leg || !cone.Reaches(path[i].p_W))) keep(i - 1);
    cone.Add(path[i].p_W);
    if (path[i].dwell_s > 0 || path[i].task || path[i].stops || i + 1 == path.size()) keep(i);
  }
  return kept;
}

// Each waypoint's place along the vertices: its projection on the straight that passes it.
std::vector<double> PlaceWaypoints(const Path& path, const std::vector<Kept>& kept,
                                   const std::vector<ReferenceVertex>& vertices) {
  std::vector<double> s_m(path.size(), vertices.back().s_m);
  std::size_t k = 0;
  double last_m = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (k + 1 < kept.size() && kept[k + 1].index <= i) ++k;
    const double way_m = (path[i].p_W - vertices[k].p_W).dot(vertices[k].direction_W);
    const double end_m = k + 1 < vertices.size() ? vertices[k + 1].s_m : vertices[k].s_m;
    last_m = std::clamp(vertices[k].s_m + way_m, last_m, std::max(last_m, end_m));
    s_m[i] = last_m;
  }
  return s_m;
}

// Changes of shape, each a stop: those of waypoints at one place in turn, then that of the way on.
void SetShapes(const Path& path, const std::vector<Kept>& kept,
               std::vector<ReferenceVertex>& vertices) {
  std::string current;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    std::vector<std::string> wanted = kept[k].shapes;
    if (k + 1 < kept.size()) wanted.push_back(path[kept[k + 1].index].shape);
    for (std::string& shape : wanted) {
      if (shape.empty() || shape == current) continue;
      current = shape;
      vertices[k].shapes.push_back(std::move(shape));
      vertices[k].stop = true;
    }
  }
}

// The speed at which a bend of this angle is driven through.
double BendSpeed(double angle_rad, bool held_yaw, const ReferenceLimits& limits) {
  const double half = 0.5 * std::abs(angle_rad);
  if (half < kNoBendRad) return limits.max_speed_mps;
  // An arc of radius R that touches both sides passes the corner at R (1 / cos(half) - 1).
  const double radius_m =
      std::max(limits.cut_m * std::cos(half) / (1 - std::cos(half)), limits.turn_radius_m);
  if (held_yaw) return std::sqrt(limits.decel_mps2 * radius_m);
  // Its yaw rate has to be reached within the turn: w^2 / accel <= angle.
  const double yaw_rate =
      std::min(limits.yaw_rate_radps, std::sqrt(limits.yaw_accel_radps2 * 2 * half));
  return radius_m * yaw_rate;
}

void SetPassingSpeeds(std::vector<ReferenceVertex>& v, const ReferenceLimits& limits) {
  const std::size_t n = v.size();
  std::vector<double> turned(n, 0);  // summed signed angles of the bends up to and with vertex i
  for (std::size_t i = 1; i + 1 < n; ++i)
    turned[i] = turned[i - 1] + TurnAngle(v[i - 1].direction_W, v[i].direction_W);
  std::size_t low = 1, high = 1;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (v[i].stop) {
      low = i + 1;
      continue;
    }
    while (v[i].s_m - v[low].s_m > 0.5 * kBendWindowM) ++low;
    high = std::max(high, i);
    while (high + 2 < n && !v[high + 1].stop && v[high + 1].s_m - v[i].s_m <= 0.5 * kBendWindowM)
      ++high;
    double curvature = std::abs(turned[high] - turned[low - 1]) / kBendWindowM;
    if (limits.turn_radius_m > 0) curvature = std::min(curvature, 1 / limits.turn_radius_m);
    const bool held = v[i].yaw_rad.has_value();
    const double curve_mps = held ? std::sqrt(limits.decel_mps2 / std::max(curvature, 1e-12))
                                  : limits.yaw_rate_radps / std::max(curvature, 1e-12);
    v[i].passing_mps = std::min({v[i - 1].speed_mps, v[i].speed_mps, curve_mps,
                                 BendSpeed(turned[i] - turned[i - 1], held, limits)});
  }
  for (std::size_t i = n - 1; i-- > 0;) {
    if (v[i].stop) continue;
    v[i].passing_mps = std::min(
        v[i].passing_mps, ApproachSpeed(v[i + 1].passing_mps, v[i + 1].s_m - v[i].s_m, limits));
  }
}

}  // namespace

double StoppingSpeed(double way, double decel, double lag_s) {
  const double b = decel * lag_s;
  return std::sqrt(b * b + 2 * decel * std::max(0.0, way)) - b;
}

double ApproachSpeed(double then_mps, double way_m, const ReferenceLimits& limits) {
  const double a = limits.decel_mps2, b = a * limits.lag_s;
  return std::sqrt((then_mps + b) * (then_mps + b) + 2 * a * std::max(0.0, way_m)) - b;
}

ReferencePath MakeReference(const Path& path, const ReferenceLimits& limits) {
  ReferencePath reference;
  if (path.empty()) return reference;
  const std::vector<Kept> kept = KeepCorners(path, limits);
  auto& vertices = reference.vertices;
  vertices.resize(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    ReferenceVertex& vertex = vertices[k];
    vertex.p_W = path[kept[k].index].p_W;
    vertex.dwells = kept[k].dwells;
    vertex.stop =
        k == 0 || k + 1 == kept.size() ||
        std::ranges::any_of(vertex.dwells, [](const auto& dwell) { return dwell.time_s > 0; });
    if (k == 0) continue;
    ReferenceVertex& from = vertices[k - 1];
    const Vec2 way = vertex.p_W - from.p_W;
    vertex.s_m = from.s_m + way.norm();
    vertex.direction_W = from.direction_W = way.normalized();
    from.speed_mps = Speed(path[kept[k].index], limits);
    vertex.speed_mps = from.speed_mps;
    vertex.yaw_rad = from.yaw_rad = HeldYaw(path[kept[k].index], limits);
    if (k == 1) continue;
    const ReferenceVertex& before = vertices[k - 2];
    const double turn_rad = std::abs(TurnAngle(before.direction_W, from.direction_W));
    const double corner_rad = path[kept[k - 1].index].stops ? kNoBendRad : limits.corner_rad;
    if ((limits.turn_radius_m == 0 && turn_rad > corner_rad) ||
        !SameYaw(before.yaw_rad, from.yaw_rad))
      from.stop = true;
  }
  if (limits.folds) SetShapes(path, kept, vertices);
  SetPassingSpeeds(vertices, limits);
  reference.waypoint_s_m = PlaceWaypoints(path, kept, vertices);
  return reference;
}

}  // namespace floorproof
