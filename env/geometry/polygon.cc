// SPDX-License-Identifier: Apache-2.0
// Boolean operations are Boost.Geometry's; the cut into trapezoids is a plane sweep of ours.
#include "env/geometry/polygon.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <limits>
#include <map>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "base/error.h"

namespace floorproof {
namespace {

namespace bg = boost::geometry;
using BPoint = bg::model::d2::point_xy<double>;
using BPolygon = bg::model::polygon<BPoint, /*ClockWise=*/false, /*Closed=*/false>;

constexpr double kTouch_m = 1e-9;
constexpr double kSliver_m2 = 1e-10;
// Of convex parts, on average: nothing rolls into so narrow a gap, and MuJoCo finds no hull of a
// slab that is as thin as its rounding.
constexpr double kNarrowest_m = 1e-6;

// Boolean operations are done on whole numbers, about a nanometre apart: in floating point, edges
// that lie on one another but for rounding make whole regions vanish, or appear.
constexpr double kPerMetre = 1 << 30;
constexpr double kFarthest_m = 4e9;  // what the numbers hold

class WholeNumbers {
 public:
  ClipperLib::Path From(const Polygon& polygon, bool positive) {
    ClipperLib::Path path;
    path.reserve(polygon.size());
    for (const Vec2& p : polygon) {
      if (!(p.cwiseAbs().maxCoeff() < kFarthest_m))
        throw InternalError("a polygon's corner is more than 4e9 m away");
      const ClipperLib::IntPoint q(std::llround(p.x() * kPerMetre),
                                   std::llround(p.y() * kPerMetre));
      corners_.try_emplace({q.X, q.Y}, p);
      path.push_back(q);
    }
    if (ClipperLib::Orientation(path) != positive) ClipperLib::ReversePath(path);
    return path;
  }
  // Corners that were there before come out with all their digits.
  Polygon Back(const ClipperLib::Path& path) const {
    Polygon polygon;
    for (const ClipperLib::IntPoint& q : path) {
      const auto before = corners_.find({q.X, q.Y});
      const Vec2 p = before != corners_.end() ? before->second
                                              : Vec2(static_cast<double>(q.X) / kPerMetre,
                                                     static_cast<double>(q.Y) / kPerMetre);
      if (polygon.empty() || (p - polygon.back()).norm() > kTouch_m) polygon.push_back(p);
    }
    while (polygon.size() > 1 && (polygon.front() - polygon.back()).norm() <= kTouch_m)
      polygon.pop_back();
    return polygon;
  }

 private:
  std::map<std::pair<ClipperLib::cInt, ClipperLib::cInt>, Vec2> corners_;
};

std::vector<Region> RegionsOf(const ClipperLib::PolyTree& tree, const WholeNumbers& numbers) {
  const auto is_sliver = [](const ClipperLib::PolyNode& node) {
    return std::abs(ClipperLib::Area(node.Contour)) < kSliver_m2 * kPerMetre * kPerMetre;
  };
  std::vector<Region> out;
  for (const ClipperLib::PolyNode* node = tree.GetFirst(); node != nullptr;
       node = node->GetNext()) {
    if (node->IsHole() || is_sliver(*node)) continue;
    Region region{numbers.Back(node->Contour), {}};
    if (region.outer.size() < 3) continue;
    for (const ClipperLib::PolyNode* hole : node->Childs)
      if (!is_sliver(*hole)) region.holes.push_back(numbers.Back(hole->Contour));
    out.push_back(std::move(region));
  }
  return out;
}

std::vector<Region> Combine(ClipperLib::ClipType operation, const std::vector<Region>& a,
                            const std::vector<Polygon>& b) {
  WholeNumbers numbers;
  ClipperLib::Clipper clipper;
  for (const Region& region : a) {
    clipper.AddPath(numbers.From(region.outer, true), ClipperLib::ptSubject, true);
    for (const Polygon& hole : region.holes)
      clipper.AddPath(numbers.From(hole, false), ClipperLib::ptSubject, true);
  }
  for (const Polygon& polygon : b)
    clipper.AddPath(numbers.From(polygon, true), ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(operation, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return RegionsOf(tree, numbers);
}

struct Edge {
  Vec2 low, high;  // low.y < high.y
  double XAt(double y) const {
    return low.x() + (high.x() - low.x()) * (y - low.y()) / (high.y() - low.y());
  }
};

struct Trapezoid {
  double y0, y1, left0, right0, left1, right1;
  double LeftAt(double y) const { return left0 + (left1 - left0) * (y - y0) / (y1 - y0); }
  double RightAt(double y) const { return right0 + (right1 - right0) * (y - y0) / (y1 - y0); }
  // Whether `next`, the trapezoid above, continues both flanks.
  bool Continues(const Trapezoid& next) const {
    const auto same = [](double a, double b) { return std::abs(a - b) < 1e-7; };
    return same(y1, next.y0) && same(left1, next.left0) && same(right1, next.right0) &&
           same(LeftAt(next.y1), next.left1) && same(RightAt(next.y1), next.right1);
  }
};

std::vector<Edge> SlantedEdges(const std::vector<Region>& regions, const Pose2& X_SW) {
  std::vector<Edge> edges;
  const auto add_ring = [&](const Polygon& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec2 a = X_SW * ring[i], b = X_SW * ring[(i + 1) % ring.size()];
      if (a.y() > b.y()) std::swap(a, b);
      if (b.y() - a.y() > kTouch_m) edges.push_back({a, b});
    }
  };
  for (const auto& region : regions) {
    add_ring(region.outer);
    for (const auto& hole : region.holes) add_ring(hole);
  }
  return edges;
}

std::vector<Trapezoid> Sweep(const std::vector<Edge>& edges) {
  std::vector<double> ys;
  for (const auto& e : edges) ys.insert(ys.end(), {e.low.y(), e.high.y()});
  std::sort(ys.begin(), ys.end());
  ys.erase(std::unique(ys.begin(), ys.end(), [](double a, double b) { return b - a < 1e-8; }),
           ys.end());
  std::vector<Trapezoid> done, open;
  for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
    const double y0 = ys[k], y1 = ys[k + 1], middle = (y0 + y1) / 2;
    std::vector<const Edge*> crossing;
    for (const auto& e : edges)
      if (e.low.y() < middle && e.high.y() > middle) crossing.push_back(&e);
    std::ranges::sort(crossing, {}, [middle](const Edge* e) { return e->XAt(middle); });
    std::vector<Trapezoid> next;
    for (std::size_t i = 0; i + 1 < crossing.size(); i += 2) {
      const Edge &l = *crossing[i], &r = *crossing[i + 1];
      Trapezoid piece{y0, y1, l.XAt(y0), r.XAt(y0), l.XAt(y1), r.XAt(y1)};
      const auto below =
          std::ranges::find_if(open, [&](const Trapezoid& o) { return o.Continues(piece); });
      if (below != open.end()) {
        piece.y0 = below->y0;
        piece.left0 = below->left0;
        piece.right0 = below->right0;
        open.erase(below);
      }
      next.push_back(piece);
    }
    done.insert(done.end(), open.begin(), open.end());
    open = std::move(next);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

// The longest side, m.
double Longest(const Polygon& polygon) {
  double longest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    longest = std::max(longest, (polygon[(i + 1) % polygon.size()] - polygon[i]).norm());
  return longest;
}

}  // namespace

double SignedArea(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

double Area(const std::vector<Region>& regions) {
  double area = 0;
  for (const auto& region : regions) {
    area += std::abs(SignedArea(region.outer));
    for (const auto& hole : region.holes) area -= std::abs(SignedArea(hole));
  }
  return area;
}

bool IsConvex(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon[(i + 1) % n] - polygon[i];
    const Vec2 b = polygon[(i + 2) % n] - polygon[(i + 1) % n];
    if (Cross(a, b) < -1e-12 * (1 + a.norm() * b.norm())) return false;
  }
  return n >= 3;
}

bool IsSimple(const Polygon& polygon) {
  BPolygon ring;
  for (const auto& p : polygon) ring.outer().emplace_back(p.x(), p.y());
  bg::correct(ring);
  return polygon.size() >= 3 && bg::is_valid(ring);
}

bool Contains(const Polygon& polygon, const Vec2& p) { return SignedDistance(polygon, p) <= 0; }

double SignedDistance(const Polygon& polygon, const Vec2& p) {
  bool inside = false;
  double distance = std::numeric_limits<double>::infinity();
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    distance = std::min(distance, DistanceToSegment(a, b, p));
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside ? -distance : distance;
}

Polygon Offset(const Polygon& polygon, double by_m) {
  Polygon out;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto outward = [&](std::size_t from, std::size_t to) {
      const Vec2 edge = (polygon[to] - polygon[from]).normalized();
      return Vec2(edge.y(), -edge.x());
    };
    const Vec2 before = outward((i + n - 1) % n, i), after = outward(i, (i + 1) % n);
    out.push_back(polygon[i] + by_m * (before + after) / (1 + before.dot(after)));
  }
  return out;
}

Polygon Rectangle(const Vec2& low, const Vec2& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

Polygon RegularPolygon(const Vec2& middle, double corner_m, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double bearing_rad = 2 * kPi * i / corners;
    polygon.push_back(middle + corner_m * Vec2(std::cos(bearing_rad), std::sin(bearing_rad)));
  }
  return polygon;
}

Polygon ConvexHull(std::vector<Vec2> points) {
  std::ranges::sort(points, [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  const auto add_chain = [&hull](auto first, auto last) {
    const std::size_t base = hull.size();
    for (auto it = first; it != last; ++it) {
      while (hull.size() >= base + 2 &&
             Cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();  // the other chain begins with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

std::vector<Region> Union(const std::vector<Polygon>& polygons) {
  return Combine(ClipperLib::ctUnion, {}, polygons);
}

std::vector<Region> Difference(const std::vector<Region>& a, const std::vector<Polygon>& b) {
  return Combine(ClipperLib::ctDifference, a, b);
}

std::vector<Region> Intersection(const std::vector<Region>& a, const std::vector<Polygon>& b) {
  return Combine(ClipperLib::ctIntersection, a, b);
}

std::vector<Region> Closed(const std::vector<Region>& regions, double by_m) {
  constexpr double kSharpest = 10;  // corners stay where they are, but for needles
  WholeNumbers numbers;
  ClipperLib::ClipperOffset out(kSharpest), back(kSharpest);
  for (const Region& region : regions) {
    out.AddPath(numbers.From(region.outer, true), ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
    for (const Polygon& hole : region.holes)
      out.AddPath(numbers.From(hole, false), ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  }
  ClipperLib::Paths grown;
  out.Execute(grown, by_m * kPerMetre);
  back.AddPaths(grown, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  ClipperLib::PolyTree tree;
  back.Execute(tree, -by_m * kPerMetre);
  return RegionsOf(tree, numbers);
}

std::vector<Region> Simplified(const std::vector<Region>& regions, double by_m) {
  std::vector<Region> out;
  for (const Region& region : regions) {
    BPolygon whole, fewer;
    whole.inners().resize(region.holes.size());
    for (const Vec2& p : region.outer) whole.outer().emplace_back(p.x(), p.y());
    for (std::size_t i = 0; i < region.holes.size(); ++i)
      for (const Vec2& p : region.holes[i]) whole.inners()[i].emplace_back(p.x(), p.y());
    bg::simplify(whole, fewer, by_m);
    const auto ring = [](const auto& points) {
      Polygon polygon;
      for (const BPoint& p : points) polygon.emplace_back(p.x(), p.y());
      if (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
      return polygon;
    };
    Region simple{ring(fewer.outer()), {}};
    if (simple.outer.size() < 3) continue;
    for (const auto& inner : fewer.inners())
      if (Polygon hole = ring(inner); hole.size() >= 3) simple.holes.push_back(std::move(hole));
    out.push_back(std::move(simple));
  }
  return out;
}

std::vector<Polygon> ConvexParts(const std::vector<Region>& regions, double yaw_rad) {
  std::vector<Polygon> parts;
  const auto keep = [&parts](const Polygon& part) {
    if (part.size() >= 3 && SignedArea(part) > std::max(kSliver_m2, kNarrowest_m * Longest(part)))
      parts.push_back(part);
  };
  std::vector<Region> rest;
  for (const auto& region : regions) {
    if (region.holes.empty() && IsConvex(region.outer))
      keep(region.outer);
    else
      rest.push_back(region);
  }
  const Pose2 X_WS{0, 0, yaw_rad};  // sweep frame S: cuts run along its x
  for (const auto& t : Sweep(SlantedEdges(rest, X_WS.Inverse()))) {
    Polygon part;
    for (const Vec2& p_S :
         {Vec2(t.left0, t.y0), Vec2(t.right0, t.y0), Vec2(t.right1, t.y1), Vec2(t.left1, t.y1)}) {
      const Vec2 p_W = X_WS * p_S;
      if (part.empty() || (p_W - part.back()).norm() > 1e-7) part.push_back(p_W);
    }
    while (part.size() > 1 && (part.front() - part.back()).norm() <= 1e-7) part.pop_back();
    keep(part);
  }
  return parts;
}

}  // namespace floorproof
