// SPDX-License-Identifier: Apache-2.0
#include "report/robot_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "render/view_sheet.h"
#include "report/robot_report.h"

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180;
// Okabe & Ito's palette: apart for those who see red and green alike, too.
constexpr Rgb kDriven = {213, 94, 0}, kCaster = {0, 114, 178}, kMass = {20, 24, 30},
              kSupport = {0, 114, 178}, kClear = {150, 60, 130}, kLidar = {0, 140, 100};

// A direction of looking: what of the body frame is right and up on the sheet, and what is nearer
// to whoever looks.
struct Looking {
  Vec3 right, up, near;
  Vec2 On(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }
};
const Looking kFromAbove = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
const Looking kFromTheRight = {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
const Looking kFromAhead = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};

Rgb FillOf(const RobotPart& part) {
  constexpr double kPaler = 0.25;  // so that marks stand out
  Rgb fill;
  for (std::size_t k = 0; k < 3; ++k) {
    const double shade = std::clamp(static_cast<double>(part.rgba[k]), 0.0, 1.0);
    fill[k] = static_cast<std::uint8_t>(std::lround(255 * (shade + kPaler * (1 - shade))));
  }
  return fill;
}

std::vector<ViewShape> ShapesOf(const std::vector<RobotPart>& parts, const Looking& looking) {
  std::vector<std::pair<double, ViewShape>> shapes;
  for (const RobotPart& part : parts) {
    double nearest = -1e9;
    std::vector<Vec2> points;
    for (const Vec3& p : part.points_B) {
      nearest = std::max(nearest, looking.near.dot(p));
      points.push_back(looking.On(p));
    }
    ViewShape shape{ConvexHull(std::move(points)), FillOf(part),
                    std::min(1.0, static_cast<double>(part.rgba[3]))};
    if (shape.outline.size() >= 3) shapes.emplace_back(nearest, std::move(shape));
  }
  std::ranges::stable_sort(shapes, {}, [](const auto& shape) { return shape.first; });
  std::vector<ViewShape> sorted;
  for (auto& [nearest, shape] : shapes) sorted.push_back(std::move(shape));
  return sorted;
}

std::vector<ViewMark> MarksOf(const RobotCheck& check, const Looking& looking) {
  std::vector<ViewMark> marks;
  for (const Carrier& carrier : check.stance.carriers)
    marks.push_back({carrier.driven ? ViewMark::Kind::kDisc : ViewMark::Kind::kRing,
                     looking.On(carrier.p_B), carrier.driven ? kDriven : kCaster});
  marks.push_back({ViewMark::Kind::kMassCentre, looking.On(check.spec.p_BCom), kMass});
  return marks;
}

std::vector<Vec2> ClosedLine(Polygon polygon) {
  if (!polygon.empty()) polygon.push_back(polygon.front());
  return polygon;
}

Polygon ClearOutline(const RobotSpec& spec) {
  constexpr int kCorners = 96;
  return spec.clear.kind == Shape2::Kind::kCircle
             ? RegularPolygon(Vec2::Zero(), spec.clear.radius_m, kCorners)
             : spec.clear.footprint_B;
}

struct Span {
  double low = 1e9, high = -1e9;
};
Span SpanOf(const std::vector<RobotPart>& parts, const Vec3& along) {
  Span span;
  for (const RobotPart& part : parts)
    for (const Vec3& p : part.points_B) {
      span.low = std::min(span.low, along.dot(p));
      span.high = std::max(span.high, along.dot(p));
    }
  return span;
}

View Top(const RobotCheck& check, const std::vector<RobotPart>& parts) {
  View view;
  view.title = "from above; forward is to the right";
  view.shapes = ShapesOf(parts, kFromAbove);
  view.lines.push_back({ClosedLine(ClearOutline(check.spec)), kClear, true, ""});
  std::vector<Vec2> support;
  for (const SupportEdge& edge : check.stance.edges) {
    support.push_back(edge.a_B);
    support.push_back(edge.b_B);
  }
  view.lines.push_back({ClosedLine(ConvexHull(support)), kSupport, false, ""});
  view.marks = MarksOf(check, kFromAbove);
  constexpr double kLong_m = 0.03;  // a shorter edge has no room for its angle
  for (const SupportEdge& edge : check.stance.edges)
    if ((edge.b_B - edge.a_B).norm() > kLong_m)
      view.notes.push_back({(edge.a_B + edge.b_B) / 2,
                            fmt::format("{:.0f}\u00b0", edge.tip_rad / kDegree), kSupport});
  const auto [right, left] = std::ranges::minmax(
      check.spec.wheels, {}, [](const WheelSpec& wheel) { return wheel.p_BW.y(); });
  const Span x = SpanOf(parts, Vec3::UnitX()), y = SpanOf(parts, Vec3::UnitY());
  view.dimensions = {{{x.high, y.low}, {x.high, y.high}, false, 3, LengthText(y.high - y.low)},
                     {{x.low, y.low}, {x.high, y.low}, true, 1, LengthText(x.high - x.low)}};
  if (check.track_m > 0)
    view.dimensions.insert(view.dimensions.begin(),
                           {right.p_BW.head<2>(), left.p_BW.head<2>(), false, 1,
                            "track " + LengthText(check.track_m)});
  return view;
}

View Side(const RobotCheck& check, const std::vector<RobotPart>& parts) {
  View view;
  view.title = "from the right";
  view.floor = true;
  view.shapes = ShapesOf(parts, kFromTheRight);
  view.marks = MarksOf(check, kFromTheRight);
  const RobotSpec& spec = check.spec;
  const Span x = SpanOf(parts, Vec3::UnitX());
  const Vec2 com = kFromTheRight.On(spec.p_BCom);
  view.lines.push_back({{com, {com.x(), 0}}, kMass, true, ""});
  if (check.stance.lidar_z_m) {
    const double z = *check.stance.lidar_z_m;
    view.lines.push_back({{{x.low, z}, {x.high, z}}, kLidar, true, "lidar " + LengthText(z)});
  }
  const WheelSpec& wheel = spec.wheels.front();
  const double wheel_x = wheel.p_BW.x();
  view.dimensions = {{{wheel_x - wheel.radius_m, 0},
                      {wheel_x + wheel.radius_m, 0},
                      true,
                      1,
                      "\u2300 " + LengthText(2 * wheel.radius_m)},
                     {{x.high, 0}, {x.high, spec.height_m}, false, 1, LengthText(spec.height_m)}};
  return view;
}

View Front(const RobotCheck& check, const std::vector<RobotPart>& parts) {
  View view;
  view.title = "from ahead";
  view.floor = true;
  view.shapes = ShapesOf(parts, kFromAhead);
  view.marks = MarksOf(check, kFromAhead);
  const RobotSpec& spec = check.spec;
  const Span y = SpanOf(parts, Vec3::UnitY());
  const Vec2 com = kFromAhead.On(spec.p_BCom);
  view.lines.push_back({{com, {com.x(), 0}}, kMass, true, ""});
  view.lines.push_back({{{y.low, spec.clearance_m}, {y.high, spec.clearance_m}}, kClear, true, ""});
  view.dimensions = {
      {{y.high, 0}, {y.high, spec.clearance_m}, false, 1, "belly " + LengthText(spec.clearance_m)}};
  return view;
}

}  // namespace

Image DrawRobot(const RobotCheck& check, const std::vector<RobotPart>& parts) {
  ViewSheet sheet;
  sheet.title = check.spec.name;
  sheet.subtitle = check.ok()
                       ? "understood; ten seconds driven on a flat floor as its kinematics says"
                       : "not as it should be: see below";
  sheet.top = Top(check, parts);
  sheet.side = Side(check, parts);
  sheet.front = Front(check, parts);
  sheet.figures = RobotFigures(check);
  for (const Finding& finding : check.findings) sheet.remarks.push_back(finding.Line());
  sheet.keys = {{"driven wheel on the floor", ViewMark::Kind::kDisc, kDriven},
                {"caster on the floor", ViewMark::Kind::kRing, kCaster},
                {"centre of mass", ViewMark::Kind::kMassCentre, kMass},
                {"support, with the tilt at which it goes over each edge", ViewMark::Kind::kDisc,
                 kSupport, true},
                {"kept clear; belly", ViewMark::Kind::kDisc, kClear, true, true}};
  return DrawViewSheet(sheet);
}

}  // namespace floorproof
