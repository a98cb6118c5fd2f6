// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_stance.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "env/scene/compiled_robot.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

constexpr double kLevel_m = 1e-4;         // points no higher than this over the lowest carry, too
constexpr double kShortestEdge_m = 1e-3;  // facets of a round foot are no edges

// Bodies whose joints the wheels' motors turn.
std::set<int> DrivenBodies(const mjModel* m, const RobotSpec& robot) {
  std::set<int> bodies;
  for (const WheelSpec& wheel : robot.wheels) {
    const int a = mj_name2id(m, mjOBJ_ACTUATOR, wheel.name.c_str());
    if (a >= 0) bodies.insert(m->jnt_bodyid[m->actuator_trnid[2 * a]]);
  }
  return bodies;
}

Carrier CarrierOf(const CompiledRobot& compiled, int geom, bool driven) {
  const mjModel* m = compiled.model();
  Carrier carrier;
  const int body = m->geom_bodyid[geom];
  const char* name = mj_id2name(m, mjOBJ_BODY, body);
  carrier.name = name != nullptr ? name : "body " + std::to_string(body);
  carrier.driven = driven;
  const auto points = compiled.SurfacePoints(geom);
  const double low = std::ranges::min_element(points, {}, [](const Vec3& p) { return p.z(); })->z();
  for (const Vec3& p : points) {
    if (p.z() > low + kLevel_m) continue;
    carrier.footprint_B.emplace_back(p.head<2>());
    carrier.p_B += p;
  }
  carrier.p_B /= static_cast<double>(carrier.footprint_B.size());
  return carrier;
}

std::vector<SupportEdge> EdgesOf(const std::vector<Carrier>& carriers, const Vec3& p_BCom) {
  std::vector<Vec2> points;
  for (const Carrier& carrier : carriers)
    points.insert(points.end(), carrier.footprint_B.begin(), carrier.footprint_B.end());
  const Polygon hull = ConvexHull(points);
  std::vector<SupportEdge> edges;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    SupportEdge edge{hull[i], hull[(i + 1) % hull.size()], 0, 0};
    const Vec2 along = edge.b_B - edge.a_B;
    if (along.norm() < kShortestEdge_m) continue;
    const Vec2 outward = Vec2(along.y(), -along.x()).normalized();
    edge.tip_rad = std::atan2(outward.dot(edge.a_B - p_BCom.head<2>()), p_BCom.z());
    edge.bearing_rad = std::atan2(outward.y(), outward.x());
    edges.push_back(edge);
  }
  return edges;
}

}  // namespace

RobotStance StanceOf(const RobotModel& robot) {
  const ModelPtr model = CompileAlone(robot);
  const mjModel* m = model.get();
  const CompiledRobot compiled(m, robot.spec.model_file);
  const std::set<int> driven = DrivenBodies(m, robot.spec);
  RobotStance out;
  for (int g = 0; g < m->ngeom; ++g)
    if (compiled.Collides(g) && !compiled.IsCarried(g))
      out.carriers.push_back(CarrierOf(compiled, g, driven.contains(m->geom_bodyid[g])));
  out.edges = EdgesOf(out.carriers, robot.spec.p_BCom);
  if (const int site = mj_name2id(m, mjOBJ_SITE, "lidar"); site >= 0)
    out.lidar_z_m = compiled.InBase(compiled.data()->site_xpos + 3 * site).z();
  return out;
}

}  // namespace floorproof
