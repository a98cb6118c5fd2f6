// SPDX-License-Identifier: Apache-2.0
// A robot that stands still goes over an edge of its support when gravity, seen from the floor,
// leans past it: at atan(d / h), d from the edge to the centre of mass along the floor, h its
// height. Gravity is tilted slowly, square to the edge; wheels are held and nothing may slide.
//
// hTetro's edges are the outer ends of its wheels. BELUGA stands on two wheels and two sprung
// casters, a rhombus: about an edge from caster to wheel it first leans until that caster has come
// to the end of its travel, and goes over from there; d and h are those of the leaning body, on
// tyres that give under what they carry then.
//
// Tolerances: 0.3 deg, what gravity turns on at 0.2 deg/s while the fall sets in; BELUGA 0.5 deg,
// as the end of a caster's travel gives by a millimetre (0.4 deg of lean). Friction is far above
// what holds, in the wrong model too, and its creep, by which the robot would turn about the wheel
// that carries most before it falls, is a hundredth of the usual (MuJoCo's impratio); larger wheels
// are felt through the higher body.
#include <algorithm>
#include <array>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kRigid_deg = 0.3, kSprung_deg = 0.5;
constexpr double kHoldsAll = 20;  // friction: tan of the steepest tilt is 4.6
constexpr double kNoCreep = 1e5;  // impratio

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

// The edge from a wheel to a sprung caster, of a body on these two alone.
class RhombusEdge {
 public:
  RhombusEdge(const Rig& rig, const char* caster_name, double way)
      : robot_(rig.robot()),
        caster_foot_(FootOf(rig, caster_name)),
        wheel_foot_(FootOf(rig, robot_.wheels.front().name)) {
    const mjModel* m = rig.scene().model.get();
    const WheelSpec& wheel = robot_.wheels.front();
    const int body = mj_name2id(m, mjOBJ_BODY, caster_name);
    ball_m_ = m->geom_size[3 * mj_name2id(m, mjOBJ_GEOM, caster_name)];
    radius_m_ = wheel.radius_m;
    side_m_ = std::abs(wheel.p_BW.y()) + HalfWidth(m, wheel.name);
    // In the plane across the axle, from the axle, `way` first: caster at its end, and the centre.
    caster_ = {way * (m->body_pos[3 * body] - wheel.p_BW.x()),
               m->body_pos[3 * body + 2] + m->jnt_range[2 * m->body_jntadr[body] + 1] - radius_m_};
    com_ = {way * (robot_.p_BCom.x() - wheel.p_BW.x()), robot_.p_BCom.z() - radius_m_};
    Lean(0, 0);
    // Its tyres carry other loads than at rest, and stand by so much lower or higher.
    const double weight_n = robot_.mass_kg * kGravity_mps2 * std::cos(std::atan2(d_m(), h_m_));
    const double share = CasterShare();
    Lean(share * weight_n / caster_foot_.tyre.stiffness_npm - caster_foot_.sink_m(),
         (1 - share) * weight_n / wheel_foot_.tyre.stiffness_npm - wheel_foot_.sink_m());
  }

  // `way` first, then to the side.
  Vec2 outward() const { return Vec2(caster_F_.x(), side_m_).normalized().reverse(); }
  double d_m() const { return outward().x() * (caster_F_.x() - com_F_.x()); }
  double h_m() const { return h_m_; }

 private:
  static const Foot& FootOf(const Rig& rig, const std::string& name) {
    return *std::ranges::find(rig.feet(), name, &Foot::geom);
  }
  // The lean that brings the ball onto the floor: -x sin + z cos = ball - R.
  void Lean(double caster_sink_m, double wheel_sink_m) {
    const double ball_m = ball_m_ - caster_sink_m, radius_m = radius_m_ - wheel_sink_m;
    const double lean_rad =
        std::atan2(caster_.y(), caster_.x()) - std::asin((ball_m - radius_m) / caster_.norm());
    const Eigen::Rotation2Dd lean(-lean_rad);
    caster_F_ = lean * caster_;
    com_F_ = lean * com_;
    h_m_ = com_F_.y() + radius_m;
  }
  // The caster's share of the weight, with the centre of mass over the edge.
  double CasterShare() const {
    const Vec2 edge(caster_F_.x(), -side_m_), com(com_F_.x(), -side_m_);
    return edge.dot(com) / edge.squaredNorm();
  }

  const RobotSpec& robot_;
  const Foot &caster_foot_, &wheel_foot_;
  double ball_m_ = 0, radius_m_ = 0, side_m_ = 0, h_m_ = 0;
  Vec2 caster_, com_, caster_F_, com_F_;
};

// The four edges of two wheels and two sprung casters before and behind them.
std::vector<Edge> RhombusEdges(const Rig& rig) {
  std::vector<Edge> edges;
  for (const double way : {1.0, -1.0}) {
    const RhombusEdge edge(rig, way > 0 ? "caster_front" : "caster_rear", way);
    for (const double left : {1.0, -1.0})
      edges.push_back({std::string(way > 0 ? "front" : "back") + (left > 0 ? "_left" : "_right"),
                       {way * edge.outward().x(), left * edge.outward().y()},
                       edge.d_m(),
                       edge.h_m(),
                       kSprung_deg});
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
  for (int p = 0; p < m->npair; ++p)
    for (const int geom : {m->pair_geom1[p], m->pair_geom2[p]})
      if (m->geom_type[geom] == mjGEOM_SPHERE) std::fill_n(m->pair_friction + 5 * p, 2, kHoldsAll);
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
      for (const Edge& edge : sprung ? RhombusEdges(truth) : BoxEdges(truth.robot(), m))
        rows.push_back({std::string("tip/") + robot + "/" + edge.name, edge.angle_rad() / kDegree,
                        GoesOver(robot, edge, wrong) / kDegree, edge.tolerance_deg, "deg"});
    }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, StaticTip)

}  // namespace floorproof
