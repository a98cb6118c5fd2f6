// SPDX-License-Identifier: Apache-2.0
#include "env/map/crossing_site.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "env/core/passages.h"
#include "env/geometry/box.h"
#include "env/map/written_hazard.h"

namespace floorproof {
namespace {

constexpr double kCell_m = 0.5;
// So much farther than the robot the hazard reaches: one that leaves its way is off it by as much
// (veer_off, 0.5 m) before it is past the end.
constexpr double kBeyond_m = 0.6;
// From the robot's way to walls: farther than they are looked for (kFarWall_m), and half a metre
// more.
constexpr double kRoom_m = 1.5;
constexpr int kCorners = 64;  // of a circle's polygon

ConfigNode Number(double value) { return ConfigNode::Scalar(FormatDouble(value)); }

const ConfigNode* SizesOf(const ConfigNode& node, const std::string& type) {
  const ConfigNode* sizes = node.Find("sizes");
  return sizes == nullptr ? nullptr : sizes->Find(type);
}

// A type with the keys that are written for it.
struct SizedType {
  std::unique_ptr<HazardType> type;
  CommonHazardKeys common;
  ConfigNode node;  // where they are written
  std::string path;
};
SizedType ReadSizes(const std::string& name, const ConfigNode* written, const SourceMark& mark) {
  SizedType sized{MakePlugin(HazardTypes(), name, "generate.hazard", mark), {}, {}, {}};
  sized.path = "generate.sizes." + name + ".";
  sized.node = written == nullptr ? ConfigNode::Map() : *written;
  if (written == nullptr) sized.node.mark = mark;
  ReadParams(sized.node, sized.path, *sized.type, CommonHazardKeys::Names());
  sized.common.Read(sized.node, sized.path);
  return sized;
}

// Where a hazard of this type lies, of so much depth and from left to right, in the frame of its
// entry edge: x along the inward normal, y to its left.
std::vector<Vec2> Strip(const HazardType& type, double from_m, double depth_m, double right_m,
                        double left_m) {
  if (type.placement() == HazardType::Placement::kLine)
    return {{from_m + depth_m / 2, right_m}, {from_m + depth_m / 2, left_m}};
  // Its first edge is the one that is met: a lift's door.
  return {
      {from_m, left_m}, {from_m, right_m}, {from_m + depth_m, right_m}, {from_m + depth_m, left_m}};
}

Polygon Moved(Polygon polygon, const Pose2& X_WL) {
  for (Vec2& p : polygon) p = X_WL * p;
  return polygon;
}

// Seen in a mirror along the way; the first edge stays the first, and counter-clockwise.
std::vector<Vec2> Mirrored(std::vector<Vec2> place) {
  for (Vec2& p : place) p.y() = -p.y();
  std::ranges::reverse(place);
  if (place.size() > 2) std::rotate(place.begin(), place.end() - 2, place.end());
  return place;
}

// Where the origin of `moving`, driven along +x, is when it first and last touches `standing`; both
// convex.
std::pair<double, double> Touching(const Polygon& moving, const Polygon& standing) {
  std::vector<Vec2> differences;
  for (const Vec2& a : standing)
    for (const Vec2& b : moving) differences.push_back(a - b);
  const Polygon hull = ConvexHull(std::move(differences));
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if ((a.y() < 0) == (b.y() < 0)) continue;
    const double x = a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y());
    first = std::min(first, x);
    last = std::max(last, x);
  }
  return {first, last};
}

// A convex polygon and all that is so near to it.
Polygon Grown(const Polygon& polygon, double by_m) {
  std::vector<Vec2> points;
  for (const Vec2& corner : polygon)
    for (const Vec2& p : RegularPolygon(corner, by_m, kCorners)) points.push_back(p);
  return ConvexHull(std::move(points));
}

// The robot as it passes, its centre at the origin: convex, counter-clockwise.
Polygon RobotOf(const CrossingParams& p) {
  if (p.outline_m.empty()) return RegularPolygon(Vec2::Zero(), p.radius_m, kCorners);
  return ConvexHull(Moved(p.outline_m, {0, 0, -p.lead_deg * kPi / 180}));
}

// All as if the hazard lay to the left of the way, which runs along +x through the origin.
class Layout {
 public:
  Layout(const CrossingParams& p, const ConfigNode& node) : p_(p), robot_(RobotOf(p)) {
    right_ = p.side == "right";
    if (right_) robot_ = ConvexHull(Mirrored(robot_));
    angle_rad_ = (right_ ? -p.angle_deg : p.angle_deg) * kPi / 180;
    const Box2 box = BoxAround(robot_);
    low_m_ = box.low.y();
    high_m_ = box.high.y();
    Lay(ReadSizes(p.hazard, SizesOf(node, p.hazard), node.mark));
    FindEnds();
  }

  ConfigNode Site() {
    const auto cells = [](double length_m) {
      return static_cast<int>(std::ceil(length_m / kCell_m));
    };
    const double wall_m = p_.wall_m.value_or(kRoom_m);
    // The near wall is the floor's lower border, or the upper one of what is mirrored.
    const int height = cells(wall_m - low_m_ + high_m_ + kRoom_m);
    const Box2 box = BoxAround(robot_);
    const int width = cells(goal_m_ - start_m_ + box.high.x() - box.low.x() + 2 * kRoom_m);
    const double way_m = kCell_m + wall_m - low_m_;
    X_WM_ = {kCell_m + kRoom_m - box.low.x() - start_m_,
             right_ ? (height + 2) * kCell_m - way_m : way_m, 0};

    ConfigNode site = ConfigNode::Map();
    ConfigNode& grid = site.Add("grid", ConfigNode::Map());
    grid.Add("cell_m", Number(kCell_m));
    grid.Add("inset_m", Number(0));
    grid.Add("rows", ConfigNode::Scalar(Rows(width + 2, height + 2), true));
    ConfigNode& hazards = site.Add("hazards", ConfigNode::List());
    for (auto& hazard : hazards_) {
      for (Vec2& point : hazard.place) point = X_WM_ * point;
      hazards.items.push_back(WriteHazard(hazard));
    }
    AddPlace(site, "start", start_m_).Add("yaw_deg", Number(CanonicalDegrees(-p_.lead_deg)));
    AddPlace(site, "goal", goal_m_);
    return site;
  }

 private:
  bool over() const { return p_.passage == "over"; }

  void Lay(SizedType sized) {
    const double across = std::max(std::cos(angle_rad_), kCrossingLeastCos);
    double depth_m = p_.length_m * across;
    if (sized.type->placement() == HazardType::Placement::kLine)
      depth_m = BoxAround(Make(sized, {{0, -1}, {0, 1}}).footprint.front()).Size().x();
    const bool whole = over() && p_.share >= 1;
    const double lowest_m = over() ? high_m_ - p_.share * (high_m_ - low_m_) : high_m_ + p_.gap_m;
    // How far it lies along its edge to the left and to the right, from the way or from its end.
    double across_m = kBeyond_m + std::max(0.0, high_m_ - lowest_m);
    if (whole)
      across_m = kBeyond_m + std::max(high_m_, -low_m_) + depth_m * std::abs(std::sin(angle_rad_));
    const double left_m = across_m / across, right_m = whole ? -left_m : 0;

    SizedType second = ReadSizes(p_.hazard, &sized.node, sized.node.mark);
    // Turned as the edge is on the floor, whether mirrored or not.
    const double edge_rad = -p_.angle_deg * kPi / 180;
    const bool directed = sized.type->Turn(edge_rad) && second.type->Turn(edge_rad + kPi);
    const double each_m = directed ? depth_m / 2 : depth_m;
    std::vector<std::pair<SizedType*, std::vector<Vec2>>> parts;  // and their places
    parts.emplace_back(&sized, Strip(*sized.type, 0, each_m, right_m, left_m));
    if (directed) parts.emplace_back(&second, Strip(*second.type, each_m, each_m, right_m, left_m));

    Pose2 X_ML{0, 0, -angle_rad_};
    if (!whole) {
      double end_m = std::numeric_limits<double>::infinity();
      for (const auto& [type, place] : parts)
        for (const Polygon& part : Footprint(Make(*type, OnFloor(place, X_ML))))
          end_m = std::min(end_m, BoxAround(part).low.y());
      X_ML.y_m = lowest_m - end_m;
    }
    for (auto& [type, place] : parts) Add(std::move(*type), OnFloor(place, X_ML));
  }

  // A place of the edge's frame in the way's, as it is before or in the mirror.
  std::vector<Vec2> OnFloor(const std::vector<Vec2>& place, const Pose2& X_ML) const {
    const std::vector<Vec2> moved = Moved(place, X_ML);
    return right_ ? Mirrored(moved) : moved;
  }
  // What a hazard that lies there covers, seen as if it lay to the left.
  std::vector<Polygon> Footprint(const Hazard& hazard) const {
    std::vector<Polygon> parts = hazard.footprint;
    if (right_)
      for (Polygon& part : parts) part = Mirrored(part);
    return parts;
  }

  void Add(SizedType sized, std::vector<Vec2> place) {
    WrittenHazard written;
    written.hazard = Make(sized, place);
    for (const Polygon& part : Footprint(written.hazard)) footprint_.push_back(part);
    written.hazard.type = p_.hazard;
    sized.common.Apply(written.hazard);
    written.place = std::move(place);
    written.type = std::move(sized.type);
    hazards_.push_back(std::move(written));
  }

  static Hazard Make(const SizedType& sized, const std::vector<Vec2>& place) {
    return MakeHazard(*sized.type, place, sized.node, sized.path);
  }

  void FindEnds() {
    const double reach_m = over() ? kReach_m : std::max(kReach_m, p_.gap_m + kLeastSize_m);
    const Polygon moving = Grown(robot_, reach_m);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const Polygon& part : footprint_) {
      const auto [from, to] = Touching(moving, part);
      first = std::min(first, from);
      last = std::max(last, to);
    }
    start_m_ = first - p_.run_up_m;
    goal_m_ = last + p_.run_out_m;
  }

  static std::string Rows(int width, int height) {
    const auto z = [](int n) { return static_cast<std::size_t>(n); };
    std::string rows = std::string(z(width), '#') + "\n";
    for (int i = 0; i < height - 2; ++i) rows += "#" + std::string(z(width - 2), '.') + "#\n";
    return rows + std::string(z(width), '#') + "\n";
  }

  ConfigNode& AddPlace(ConfigNode& site, const char* key, double x_m) const {
    ConfigNode& place = site.Add(key, ConfigNode::Map());
    const Vec2 p_W = X_WM_ * Vec2(x_m, 0);
    place.Add("x_m", Number(p_W.x()));
    place.Add("y_m", Number(p_W.y()));
    return place;
  }

  const CrossingParams& p_;
  Polygon robot_;
  bool right_ = false;
  double angle_rad_ = 0, low_m_ = 0, high_m_ = 0, start_m_ = 0, goal_m_ = 0;
  std::vector<WrittenHazard> hazards_;
  std::vector<Polygon> footprint_;
  Pose2 X_WM_;  // the way's frame on the floor
};

}  // namespace

void CrossingParams::Visit(ParamVisitor& v) {
  v("kind", kind, {"crossing"}, "one hazard on the robot's way");
  v("hazard", hazard, PluginNames(HazardTypes()), "its type");
  v("passage", passage, {"over", "beside"}, "whether the way leads over it or past it");
  v("side", side, {"left", "right"}, "of the way, where it lies that is passed, or met in part");
  v("angle_deg", angle_deg, Between(-90, 90),
    "of the way from the inward normal of its edge, counter-clockwise: 0 square on, 90 along it");
  v("lead_deg", lead_deg, Between(-180, 180),
    "of the way in the robot's own frame: 0 forward, 90 to its left");
  v("share", share, Between(0.01, 2), "of the robot's width that passes over it; 1 or more: all");
  v("gap_m", gap_m, Between(0, 5), "from the robot to it, where it is passed");
  v("length_m", length_m, Between(0.01, 10), "along the way, of what is placed by a polygon");
  v("run_up_m", run_up_m, Between(0.01, 20), "before the robot comes within 0.1 m of it");
  v("run_out_m", run_out_m, Between(0.01, 20),
    "of the way, behind the last place within 0.1 m of it");
  v("wall_m", wall_m, Between(0, 20), "from the robot to a wall beside its way; none: far away");
  v("radius_m", radius_m, Between(0.01, 5), "of the robot, that it keeps clear");
}

CrossingParams ReadCrossing(const ConfigNode& node) {
  CrossingParams p;
  ReadParams(node, "generate.", [&](ParamVisitor& v) { p.Visit(v); }, {"outline_m", "sizes"});
  if (const ConfigNode* outline = node.Find("outline_m"); outline && !outline->IsNull())
    p.outline_m = ReadPolygon(*outline, "generate.outline_m");
  const ConfigNode* sizes = node.Find("sizes");
  if (sizes != nullptr) {
    if (!sizes->IsMap())
      throw InputError(sizes->mark, "generate.sizes", "", "must be a map of types to their keys");
    RefuseUnknownKeys(*sizes, "generate.sizes.", PluginNames(HazardTypes()));
  }
  p.sizes = ConfigNode::Map();
  for (const std::string& type : PluginNames(HazardTypes())) {
    const SizedType sized = ReadSizes(type, SizesOf(node, type), node.mark);
    // What it has of the shared keys by default, anywhere.
    const auto usual = MakePlugin(HazardTypes(), type, "");
    Hazard sample = usual->Make(Strip(*usual, 0, 1, -1, 1));
    sized.common.Apply(sample);
    sample.known = sized.common.known;
    ConfigNode& written = p.sizes.Add(type, ConfigNode::Map());
    WriteParams(*sized.type, written);
    WriteCommonHazardKeys(sample, written);
  }
  return p;
}

NamedSchema CrossingSchema() {
  CrossingParams p;
  std::vector<NamedSchema> types = PluginSchemas(HazardTypes());
  for (NamedSchema& type : types) CommonHazardKeys::AddTo(type.keys);
  MapSchema keys;
  keys.Params([&](ParamVisitor& v) { p.Visit(v); })
      .Key("outline_m", OrNull(PolygonSchema()),
           "of the robot, in place of radius_m: its corners [x, y] in its own frame (m)")
      .Key("sizes", PluginMapSchema(types), "what each type measures, for as many as you like");
  return {p.kind, "one hazard on the robot's way", std::move(keys)};
}

ConfigNode WriteCrossing(const CrossingParams& params) {
  ConfigNode node = WithParams(ConfigNode::Map(), params);
  if (!params.outline_m.empty()) node.Add("outline_m", WritePoints(params.outline_m));
  node.Add("sizes", params.sizes);
  return node;
}

ConfigNode LayCrossing(const CrossingParams& params, const ConfigNode& node) {
  return Layout(params, node).Site();
}

}  // namespace floorproof
