// SPDX-License-Identifier: Apache-2.0
#include "env/sim/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "env/core/standing.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxSupports = 64;
// A contact whose normal stands steeper than this carries; one flatter than that obstructs.
constexpr double kSteep = 0.7;
constexpr double kWedged = 0.3;      // a wheel in a groove stands on rims as steep as this
constexpr double kBeside_m = 0.005;  // into the gap beside a slab's side
constexpr double kBelow_m = 0.005;   // below the floor a wheel hangs in something

// Sets `quat` to the attitude `as`, turned about the vertical to this yaw.
void Tilt(const std::array<mjtNum, 4>& as, double yaw_rad, mjtNum* quat) {
  mjtNum R[9], turn[4];
  mju_quat2Mat(R, as.data());
  const mjtNum vertical[3] = {0, 0, 1};
  mju_axisAngle2Quat(turn, vertical, yaw_rad - std::atan2(R[3], R[0]));
  mju_mulQuat(quat, turn, as.data());
}

// The warnings after which the state is not to be believed.
bool Diverged(const mjData* d) {
  return d->warning[mjWARN_BADQPOS].number > 0 || d->warning[mjWARN_BADQVEL].number > 0 ||
         d->warning[mjWARN_BADQACC].number > 0 || d->warning[mjWARN_INERTIA].number > 0 ||
         d->warning[mjWARN_CONTACTFULL].number > 0 || d->warning[mjWARN_CNSTRFULL].number > 0;
}

}  // namespace

double MotorTorque(const mjModel* m, const mjData* d, int actuator) {
  const mjtNum* gain = m->actuator_gainprm + mjNGAIN * actuator;
  constexpr int kPosition = 4, kVelocity = 6;  // gains of the driver
  if (gain[kPosition] != 0 || gain[kVelocity] == 0) return d->actuator_force[actuator];
  const double most_nm =
      m->actuator_forcelimited[actuator] ? m->actuator_forcerange[2 * actuator + 1] : 0;
  return DriveTorque({gain[0], gain[1], gain[kVelocity], DriverVoltage(m, actuator), most_nm},
                     d->ctrl[actuator], d->qvel[m->jnt_dofadr[m->actuator_trnid[2 * actuator]]]);
}

Simulation::Simulation(const Scene& scene, const HazardMap& map, const RobotSpec& robot)
    : scene_(scene),
      map_(map),
      robot_(robot),
      own_(CopyModel(scene.model.get())),
      live_(scene, *own_),
      data_(MakeData(scene.model.get())),
      battery_(robot.battery),
      voltage_changes_(robot.battery.resistance_ohm > 0 || robot.battery.capacity_wh) {
  const mjModel* m = model();
  for (const HingeSpec& hinge : robot.hinges) {
    const int joint = m->actuator_trnid[2 * mj_name2id(m, mjOBJ_ACTUATOR, hinge.name.c_str())];
    hinge_qpos_.push_back(m->jnt_qposadr[joint]);
    hinge_dof_.push_back(m->jnt_dofadr[joint]);
  }
  if (!robot.hinges.empty())
    for (const BlockSpec& block : robot.blocks)
      block_bodies_.push_back(mj_name2id(m, mjOBJ_BODY, block.name.c_str()));
  for (int a = 0; a < static_cast<int>(robot.wheels.size()); ++a) {
    const int joint = m->actuator_trnid[2 * a];
    wheel_bodies_.push_back(m->jnt_bodyid[joint]);
    wheel_qpos_.push_back(m->jnt_qposadr[joint]);
  }
  support_.reserve(kMaxSupports);
  hull_.reserve(2 * kMaxSupports);
}

void Simulation::Place(const Pose2& X_WB) {
  mjtNum* q = data_->qpos + model()->jnt_qposadr[model()->body_jntadr[scene_.base_body]];
  const HingeState start = StartState(robot_);
  for (std::size_t h = 0; h < hinge_qpos_.size(); ++h) data_->qpos[hinge_qpos_[h]] = start.rad[h];
  ReadHinges();
  const Vec2 p_WR = X_WB * Vec2(-blocks_.p_RB);
  q[0] = p_WR.x();
  q[1] = p_WR.y();
  q[3] = std::cos(X_WB.yaw_rad / 2);
  q[4] = q[5] = 0;
  q[6] = std::sin(X_WB.yaw_rad / 2);
}

void Simulation::Reset(const Pose2& X_WB) {
  mj_resetData(model(), data_.get());
  battery_ = BatteryInUse(robot_.battery);
  battery_.Weaken(altered_.battery_voltage);
  truth_ = Truth{};
  Settle(X_WB, 0);
}

// All that the engine remembers of the last place goes: velocities, the motors' state and orders,
// the solver's warm start, springs under load.
void Simulation::SetDown(const Pose2& X_WB) {
  mjData* d = data_.get();
  const double t_s = d->time;
  std::vector<mjtNum> turned_rad;
  for (const int adr : wheel_qpos_) turned_rad.push_back(d->qpos[adr]);
  mj_resetData(model(), d);
  for (std::size_t w = 0; w < turned_rad.size(); ++w) d->qpos[wheel_qpos_[w]] = turned_rad[w];
  Settle(X_WB, t_s);
}

// Springs and contacts take a moment to carry the weight: it stands still for that long while the
// clock does not count, then is put exactly where it was asked for, at t_s. A load that was put on
// it is held until then: it might tip it.
void Simulation::Settle(const Pose2& X_WB, double t_s) {
  constexpr double kSettle_s = 0.5;
  mjData* d = data_.get();
  const double load_kg = std::exchange(altered_.payload_kg, 0);
  if (load_kg > 0) AlterPayload();
  const Standing stands = StandAt(map_, robot_, X_WB);
  mjtNum* q = d->qpos + model()->jnt_qposadr[model()->body_jntadr[scene_.base_body]];
  q[2] += stands.rests_m;
  Place(X_WB);
  SetDriverVoltages();
  while (d->time < kSettle_s) {
    live_.Update(d);
    StepEngine(model(), d);
  }
  if (load_kg > 0) {
    altered_.payload_kg = load_kg;
    AlterPayload();
  }
  const std::array<mjtNum, 4> settled = {q[3], q[4], q[5], q[6]};
  Place(X_WB);
  // On terrain it stands as it came to rest: level, its wheels would be in what tilts it.
  if (stands.rests_m > stands.floor_m) Tilt(settled, X_WB.yaw_rad, q + 3);
  std::fill_n(d->qvel, model()->nv, 0.0);
  d->time = t_s;
  live_.Update(d);
  ForwardEngine(model(), d);
  ReadPose();
  ReadContacts();
  ReadPower(0);
}

void Simulation::SetWheelSpeeds(std::span<const double> wheel_radps) {
  std::copy(wheel_radps.begin(), wheel_radps.end(), data_->ctrl);
}

bool Simulation::Step() {
  live_.Update(data_.get());
  StepEngine(model(), data_.get());
  ReadPose();
  ReadContacts();
  ReadPower(model()->opt.timestep);
  return !Diverged(data_.get()) && std::isfinite(truth_.p_WB.sum()) &&
         std::isfinite(truth_.v_WB_W.sum());
}

void Simulation::SetHingeSpeeds(const HingeState& hinges) {
  std::copy_n(hinges.radps.begin(), hinge_dof_.size(), data_->ctrl + robot_.wheels.size());
}

void Simulation::ReadHinges() {
  constexpr double kInShape_rad = 0.05;  // play within which the hinges count as in a shape
  truth_.shape = robot_.shape;
  if (hinge_dof_.empty()) return;
  truth_.hinges.n = static_cast<int>(hinge_dof_.size());
  for (std::size_t h = 0; h < hinge_dof_.size(); ++h) {
    truth_.hinges.rad[h] = data_->qpos[hinge_qpos_[h]];
    truth_.hinges.radps[h] = data_->qvel[hinge_dof_[h]];
  }
  truth_.shape = ShapeOf(robot_, truth_.hinges, kInShape_rad);
  blocks_ = MoveBlocks(robot_.blocks, robot_.hinges, truth_.hinges);
}

void Simulation::ReadPose() {
  // qpos and qvel are the state after the step; xpos and the like are from before it. The free
  // joint's linear velocity is in the world frame, its angular velocity in the body's.
  const mjModel* m = model();
  const mjData* d = data_.get();
  const int joint = m->body_jntadr[scene_.base_body];
  const mjtNum* q = d->qpos + m->jnt_qposadr[joint];
  const mjtNum* v = d->qvel + m->jnt_dofadr[joint];
  mjtNum R[9];
  mju_quat2Mat(R, q + 3);
  ReadHinges();
  truth_.t_s = d->time;
  truth_.roll_rad = std::atan2(R[7], R[8]);
  truth_.pitch_rad = std::asin(std::clamp(-R[6], -1.0, 1.0));
  truth_.yaw_rad = std::atan2(R[3], R[0]);
  truth_.tilt_rad = std::acos(std::clamp(R[8], -1.0, 1.0));
  Vec3 w_W;
  mju_mulMatVec3(w_W.data(), R, v + 3);
  // From the base block's frame R to B, which moves against it as the hinges turn.
  const mjtNum p_RB[3] = {blocks_.p_RB.x(), blocks_.p_RB.y(), 0};
  const mjtNum v_RB[3] = {blocks_.v_RB.x(), blocks_.v_RB.y(), 0};
  mjtNum arm_W[3], slide_W[3], v_B[3];
  mju_mulMatVec3(arm_W, R, p_RB);
  mju_mulMatVec3(slide_W, R, v_RB);
  truth_.p_WB = Vec3(q[0], q[1], q[2]) + Vec3(arm_W[0], arm_W[1], arm_W[2]);
  truth_.v_WB_W = Vec3(v[0], v[1], v[2]) + w_W.cross(Vec3(arm_W[0], arm_W[1], arm_W[2])) +
                  Vec3(slide_W[0], slide_W[1], slide_W[2]);
  mju_mulMatTVec3(v_B, R, truth_.v_WB_W.data());
  truth_.V_WB_B = {v_B[0], v_B[1], v[5]};

  double lowest = 1e9;
  for (std::size_t w = 0; w < wheel_bodies_.size(); ++w) {
    // Lowest point of a cylinder whose axle is tilted: radius and half width share the drop; its
    // rollers round it.
    const WheelSpec& wheel = robot_.wheels[w];
    const mjtNum* mat = d->xmat + 9 * wheel_bodies_[w];
    const double axle_z = mat[7];  // the wheel's axle is its body's y
    const double drop =
        (wheel.radius_m - wheel.roller_radius_m) * std::sqrt(std::max(0.0, 1 - axle_z * axle_z)) +
        wheel.half_width_m * std::abs(axle_z) + wheel.roller_radius_m;
    const mjtNum* p_W = d->xpos + 3 * wheel_bodies_[w];
    if (p_W[2] - drop >= lowest) continue;
    lowest = p_W[2] - drop;
    lowest_wheel_W_ = {p_W[0], p_W[1]};
  }
  truth_.wheel_floor_z_m = lowest;
}

void Simulation::ReadContacts() {
  const mjModel* m = model();
  const mjData* d = data_.get();
  truth_.belly_load_n = 0;
  truth_.belly_hazard = -1;
  truth_.wheel_contacts = 0;
  truth_.near_hazard = -1;
  truth_.num_contacts = 0;
  support_.clear();
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.exclude || c.efc_address < 0) continue;
    GeomRole world = scene_.roles[static_cast<std::size_t>(c.geom[0])];
    GeomRole robot = scene_.roles[static_cast<std::size_t>(c.geom[1])];
    double toward = 1;  // the contact's normal points from geom 0 to geom 1
    if (m->geom_bodyid[c.geom[0]] != 0) {
      std::swap(world, robot);
      toward = -1;
    }
    const double nz = toward * c.frame[2];
    // The side of a slab of floor is the edge of what is missing beside it.
    if (world.kind == GeomRole::Kind::kFloor && world.hazard < 0 && nz < kSteep)
      world.hazard =
          CutAt(Vec2(c.pos[0], c.pos[1]) + kBeside_m * toward * Vec2(c.frame[0], c.frame[1]));
    if (world.hazard >= 0) truth_.near_hazard = world.hazard;
    if (robot.kind == GeomRole::Kind::kWheel) {
      ++truth_.wheel_contacts;
      if (nz > kWedged) AddSupport(c.pos);
      continue;
    }
    if (nz <= kSteep) {
      AddObstacle(c, world.hazard, c.geom[toward > 0 ? 1 : 0], toward);
      continue;
    }
    mjtNum force[6];
    mj_contactForce(m, d, i, force);
    truth_.belly_load_n += force[0] * nz;
    if (force[0] > 0) AddSupport(c.pos);
    truth_.belly_hazard = world.hazard;
  }
  if (truth_.near_hazard < 0 && truth_.wheel_floor_z_m < -kBelow_m)
    truth_.near_hazard = CutAt(lowest_wheel_W_);  // a wheel that hangs in it
  truth_.support_margin_m = SupportMargin();
}

// The hazard whose cut in the floor holds this point; -1: none.
int Simulation::CutAt(const Vec2& p_W) const {
  for (std::size_t h = map_.hazards.size(); h-- > 0;)
    for (const Solid& solid : map_.hazards[h].solids)
      if (solid.kind == Solid::Kind::kCut && Contains(solid.base, p_W)) return static_cast<int>(h);
  return -1;
}

void Simulation::AddObstacle(const mjContact& contact, int hazard, int geom, double toward) {
  Vec2 normal_W(toward * contact.frame[0], toward * contact.frame[1]);
  if (truth_.num_contacts == Truth::kMaxContacts || normal_W.norm() < 1e-9) return;
  normal_W.normalize();
  const mjModel* m = model();
  const mjData* d = data_.get();
  // Of what touches, at the point of touch: a body that pitches at the impact moves otherwise there
  // than at its origin, and a block that swings otherwise than the robot. Velocities by body are
  // those before the step.
  const int body = m->body_weldid[m->geom_bodyid[geom]];
  mjtNum V_W[6];
  mj_objectVelocity(m, d, mjOBJ_XBODY, body, V_W, 0);
  const Vec3 w_W(V_W[0], V_W[1], V_W[2]), v_W(V_W[3], V_W[4], V_W[5]);
  const Vec3 r_W = Vec3(contact.pos) - Vec3(d->xpos + 3 * body);
  mjtNum force[6];
  mj_contactForce(m, d, static_cast<int>(&contact - d->contact), force);

  ObstacleContact& out = truth_.contacts[static_cast<std::size_t>(truth_.num_contacts++)];
  out.hazard = hazard;
  out.p_W = {contact.pos[0], contact.pos[1]};
  out.normal_W = normal_W;
  const auto block = std::ranges::find(block_bodies_, body);
  out.block = block == block_bodies_.end() ? 0 : static_cast<int>(block - block_bodies_.begin());
  out.closing_mps = -Vec3(v_W + w_W.cross(r_W)).head<2>().dot(normal_W);
  out.impulse_ns = force[0] * m->opt.timestep;
}

void Simulation::AddSupport(const double* p_W) {
  if (support_.size() < kMaxSupports) support_.emplace_back(p_W[0], p_W[1]);
}

// Signed distance from the centre of mass, seen from above, to the border of the hull of the
// wheels' contacts: positive inside. Andrew's monotone chain in scratch of fixed size.
double Simulation::SupportMargin() {
  const mjtNum* com = data_->subtree_com + 3 * scene_.base_body;
  const Vec2 p(com[0], com[1]);
  if (support_.empty()) return -robot_.circumscribed_radius_m;
  std::ranges::sort(support_, [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  hull_.clear();
  const auto add = [this](const Vec2& q, std::size_t base) {
    while (hull_.size() >= base + 2 &&
           Cross(hull_.back() - hull_[hull_.size() - 2], q - hull_.back()) <= 0)
      hull_.pop_back();
    hull_.push_back(q);
  };
  for (const auto& q : support_) add(q, 0);
  const std::size_t lower = hull_.size() - 1;
  for (std::size_t i = support_.size() - 1; i-- > 0;) add(support_[i], lower);
  double nearest = 1e9;
  bool inside = hull_.size() > 3;  // the first corner stands twice
  for (std::size_t i = 0; i + 1 < hull_.size(); ++i) {
    nearest = std::min(nearest, DistanceToSegment(hull_[i], hull_[i + 1], p));
    if (Cross(hull_[i + 1] - hull_[i], p - hull_[i]) < 0) inside = false;
  }
  if (hull_.size() == 1) nearest = (hull_[0] - p).norm();
  return inside ? nearest : -nearest;
}

void Simulation::ReadPower(double dt_s) {
  const mjModel* m = model();
  const mjData* d = data_.get();
  double load_w = robot_.hotel_load_w * altered_.hotel_load;
  for (int a = 0; a < m->nu; ++a) {
    const mjtNum* gain = m->actuator_gainprm + mjNGAIN * a;
    const int dof = m->jnt_dofadr[m->actuator_trnid[2 * a]];
    load_w += MotorPower(MotorTorque(m, d, a), d->qvel[dof], gain[0], gain[1]);
  }
  const BatteryOutput out = battery_.Feed(load_w, dt_s);
  truth_.power_w = out.power_w();
  truth_.battery_v = out.voltage_v;
  truth_.battery_a = out.current_a;
  SetDriverVoltages();
}

// What the drivers can give in the next step.
void Simulation::SetDriverVoltages() {
  if (!voltage_changes_) return;
  for (int a = 0; a < model()->nu; ++a) SetDriverVoltage(model(), a, battery_.voltage_v());
}

}  // namespace floorproof
