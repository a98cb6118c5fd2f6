// SPDX-License-Identifier: Apache-2.0
// Simple polygons: tests, Boolean operations and cutting into convex parts.
#pragma once

#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

// A simple polygon's corners, counter-clockwise, the first not repeated at the end.
using Polygon = std::vector<Vec2>;
// A region with holes.
struct Region {
  Polygon outer;               // counter-clockwise
  std::vector<Polygon> holes;  // clockwise
};

double SignedArea(const Polygon& polygon);  // m^2, positive when counter-clockwise
double Area(const std::vector<Region>& regions);
bool IsConvex(const Polygon& polygon);
bool IsSimple(const Polygon& polygon);  // no two edges cross or touch beyond shared corners
// True inside and on the border.
bool Contains(const Polygon& polygon, const Vec2& p);
// Distance to the border, negative inside.
double SignedDistance(const Polygon& polygon, const Vec2& p);
// The polygon with its edges moved outwards by less than its own narrowest part; corners stay
// sharp.
Polygon Offset(const Polygon& polygon, double by_m);
Polygon Rectangle(const Vec2& low, const Vec2& high);
// Regular, its corners so far from the middle, the first in direction +x.
Polygon RegularPolygon(const Vec2& middle, double corner_m, int corners);
// The convex hull, counter-clockwise.
Polygon ConvexHull(std::vector<Vec2> points);

std::vector<Region> Union(const std::vector<Polygon>& polygons);
std::vector<Region> Difference(const std::vector<Region>& a, const std::vector<Polygon>& b);
std::vector<Region> Intersection(const std::vector<Region>& a, const std::vector<Polygon>& b);

// The regions with what is narrower than 2 `by_m` between them filled, so that those that lie so
// near one another become one.
std::vector<Region> Closed(const std::vector<Region>& regions, double by_m);

// The regions with fewer corners (Douglas & Peucker 1973): none that is left out was farther than
// by_m from the new border. What is no wider may vanish.
std::vector<Region> Simplified(const std::vector<Region>& regions, double by_m);

// Convex polygons that tile the regions without overlap. A convex region stays whole. Others are
// cut along lines in direction `yaw_rad` through their corners, into trapezoids; neighbours are
// merged where together they form a rectangle or a trapezoid again. What is no wider than a
// micrometre on average is left out.
std::vector<Polygon> ConvexParts(const std::vector<Region>& regions, double yaw_rad = 0);

}  // namespace floorproof
