// SPDX-License-Identifier: Apache-2.0
// A robot that stands still goes over an edge of its support when gravity, seen from the floor,
// leans past it: at atan(d / h), d from the edge to the centre of mass along the floor, h its
// height. Gravity is tilted slowly, square to the edge; wheels are held and nothing may slide.
//
// hTetro's edges are the outer ends of its wheels. BELUGA stands on two wheels and two sprung
// casters, a rhombus: about an edge from caster to wheel it first leans until that caster has come
// to the end of its travel, and goes over from there; d and h are those of the leaning body.
//
// Tolerances: 0.3 deg, what gravity turns on at 0.2 deg/s while the fall sets in; BELUGA 0.4 deg,
// as the end of a caster's travel gives by a millimetre (0.4 deg of lean). Friction is far above
// what holds, in the wrong model too, and its creep, by which the robot would turn about the wheel
// that carries most before it falls, is a hundredth of the usual (MuJoCo's impratio); larger wheels
// are felt through the higher body.
#include <array>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kRigid_deg = 0.3, kSprung_deg = 0.4;
constexpr double kHoldsAll = 20;  // friction: tan of the steepest tilt is 4.6
constexpr double kNoCreep = 100;  // impratio

// An edge of the support in the frame of the floor, and the centre of mass over it.
struct Edge {
  std::string name;
  Vec2 outward;     // unit
  double d_m, h_m;  // centre of mass to the edge, and above the floor
  double tolerance_deg;
  double angle_rad() const { return std::atan2(d_m, h_m); }
};

// Half the width on which a driven wheel stands.
double HalfWidth(const mjModel* m, const std::string& wheel) {
  return m->geom_size[3 * mj_name2id(m, mjOBJ_GEOM, wheel.c_str()) + 1];
}

std::vector<Edge> BoxEdges(const RobotSpec& robot, const mjModel* m) {
  double front_m = 0, side_m = 0;
  for (const WheelSpec& wheel : robot.wheels) {
    front_m = std::max(front_m, wheel.p_BW.x());
    side_m = std::max(side_m, wheel.p_BW.y() + HalfWidth(m, wheel.name));
  }
  const Vec3& com = robot.p_BCom;
  return {{"front", Vec2::UnitX(), front_m - com.x(), com.z(), kRigid_deg},
          {"back", -Vec2::UnitX(), front_m + com.x(), com.z(), kRigid_deg},
          {"left", Vec2::UnitY(), side_m - com.y(), com.z(), kRigid_deg},
          {"right", -Vec2::UnitY(), side_m + com.y(), com.z(), kRigid_deg}};
}

// The four edges of two wheels and two sprung casters before and behind them.
std::vector<Edge> RhombusEdges(const RobotSpec& robot, const mjModel* m) {
  const WheelSpec& wheel = robot.wheels.front();
  const double side_m = std::abs(wheel.p_BW.y()) + HalfWidth(m, wheel.name);
  std::vector<Edge> edges;
  for (const double way : {1.0, -1.0}) {
    const char* name = way > 0 ? "caster_front" : "caster_rear";
    const int body = mj_name2id(m, mjOBJ_BODY, name);
    const int joint = m->body_jntadr[body];
    const double ball_m = m->geom_size[3 * mj_name2id(m, mjOBJ_GEOM, name)];
    // In the plane across the axle, from the axle, `way` first: caster at its end, and the centre.
    const Vec2 caster(way * (m->body_pos[3 * body] - wheel.p_BW.x()),
                      m->body_pos[3 * body + 2] + m->jnt_range[2 * joint + 1] - wheel.radius_m);
    const Vec2 com(way * (robot.p_BCom.x() - wheel.p_BW.x()), robot.p_BCom.z() - wheel.radius_m);
    // The lean that brings the ball onto the floor: -x sin + z cos = ball - R.
    const double lean_rad =
        std::atan2(caster.y(), caster.x()) - std::asin((ball_m - wheel.radius_m) / caster.norm());
    const Eigen::Rotation2Dd lean(-lean_rad);
    const Vec2 caster_F = lean * caster, com_F = lean * com;
    for (const double left : {1.0, -1.0}) {
      const Vec2 outward = Vec2(way * side_m, left * caster_F.x()).normalized();
      const double edge_m = outward.dot(Vec2(way * caster_F.x(), 0));
      edges.push_back({std::string(way > 0 ? "front" : "back") + (left > 0 ? "_left" : "_right"),
                       outward, edge_m - outward.dot(Vec2(way * com_F.x(), 0)),
                       com_F.y() + wheel.radius_m, kSprung_deg});
    }
  }
  return edges;
}

// The tilt of gravity at which the robot goes over the edge.
double GoesOver(const char* robot, const Edge& edge, const WrongModel& wrong) {
  constexpr double kNear_rad = 3 * kDegree, kFast_radps = 30 * kDegree, kSlow_radps = 0.2 * kDegree;
  constexpr double kOver_rad = 1 * kDegree;  // more than before
  Rig rig(robot, {.friction = kHoldsAll, .wrong = wrong});
  rig.Brake();
  // Casters too must not slide.
  mjModel* m = rig.sim().model();
  for (int g = 0; g < m->ngeom; ++g)
    if (m->geom_type[g] == mjGEOM_SPHERE && m->geom_conaffinity[g])
      m->geom_friction[3 * g] = kHoldsAll;
  m->opt.impratio = kNoCreep;
  const double step_s = m->opt.timestep, near_rad = edge.angle_rad() - kNear_rad;
  double tilt_rad = 0, stood_rad = 0;
  while (tilt_rad < near_rad + 3 * kNear_rad) {
    const bool fast = tilt_rad < near_rad;
    tilt_rad += step_s * (fast ? kFast_radps : kSlow_radps);
    rig.SetGravity({std::sin(tilt_rad) * edge.outward.x(), std::sin(tilt_rad) * edge.outward.y(),
                    -std::cos(tilt_rad)});
    rig.Step();
    if (tilt_rad < near_rad + kNear_rad / 10)
      stood_rad = rig.truth().tilt_rad;
    else if (rig.truth().tilt_rad > stood_rad + kOver_rad)
      break;
  }
  return tilt_rad;
}

class StaticTip final : public Law {
 public:
  std::string_view statement() const override {
    return "standing, it goes over an edge of its support at atan(d / h)";
  }
  std::vector<WrongModel> notices() const override { return {kLargerWheels}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const char* robot : {"beluga", "htetro"}) {
      const Rig truth(robot);
      const mjModel* m = truth.scene().model.get();
      const bool sprung = mj_name2id(m, mjOBJ_GEOM, "caster_front") >= 0;
      for (const Edge& edge : sprung ? RhombusEdges(truth.robot(), m) : BoxEdges(truth.robot(), m))
        rows.push_back({std::string("tip/") + robot + "/" + edge.name, edge.angle_rad() / kDegree,
                        GoesOver(robot, edge, wrong) / kDegree, edge.tolerance_deg, "deg"});
    }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, StaticTip)

}  // namespace floorproof
