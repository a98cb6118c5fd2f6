// SPDX-License-Identifier: Apache-2.0
#include "env/sim/contact_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace floorproof {
namespace {

constexpr std::size_t kMaxSupports = 64;
constexpr double kBeside_m = 0.005;  // into the gap beside a slab's side
constexpr double kBelow_m = 0.005;   // below the floor a wheel hangs in something
constexpr double kHangs = 0.05;      // least share of the belly's load on a hazard
constexpr double kHung = 0.5;        // share of the weight that what is aside carries, at most

Wrench& operator+=(Wrench& sum, const Wrench& w) {
  sum.force_W_n += w.force_W_n;
  sum.moment_W_nm += w.moment_W_nm;
  return sum;
}

}  // namespace

ContactReader::ContactReader(const Scene& scene, const HazardMap& map, const RobotSpec& robot)
    : scene_(scene),
      map_(map),
      drops_(scene, robot.wheels.size()),
      far_m_(robot.circumscribed_radius_m) {
  const mjModel* m = scene.model.get();
  if (robot.hinges.empty())
    block_bodies_ = {scene.base_body};
  else
    for (const BlockSpec& block : robot.blocks)
      block_bodies_.push_back(mj_name2id(m, mjOBJ_BODY, block.name.c_str()));
  block_of_.assign(static_cast<std::size_t>(m->nbody), 0);
  for (int b = 1; b < m->nbody; ++b) {  // parents stand before children
    const auto block = std::ranges::find(block_bodies_, b);
    block_of_[static_cast<std::size_t>(b)] =
        block != block_bodies_.end() ? static_cast<int>(block - block_bodies_.begin())
                                     : block_of_[static_cast<std::size_t>(m->body_parentid[b])];
  }
  wheel_of_.assign(static_cast<std::size_t>(m->nbody), -1);
  for (std::size_t w = 0; w < robot.wheels.size(); ++w)
    wheel_of_[static_cast<std::size_t>(m->jnt_bodyid[m->actuator_trnid[2 * w]])] =
        static_cast<int>(w);
  for (int b = 1; b < m->nbody; ++b)  // the rollers of a wheel are its children
    if (int& wheel = wheel_of_[static_cast<std::size_t>(b)]; wheel < 0)
      wheel = wheel_of_[static_cast<std::size_t>(m->body_parentid[b])];
  support_.reserve(kMaxSupports);
  hull_.reserve(2 * kMaxSupports);
  belly_n_.resize(map.hazards.size() + 1);
}

void ContactReader::BeginStep(int parts, Truth& truth) {
  parts_ = parts;
  origin_W_ = truth.p_WB;
  truth.num_contacts = truth.num_touches = 0;
  truth.belly_load_n = truth.driven_load_n = 0;
  load_n_ = 0;
  load_nm_.setZero();
  side_n_.setZero();
  std::ranges::fill(belly_n_, 0.0);
}

template <class Use>
void ContactReader::ForEachContact(const mjModel* m, const mjData* d, const Use& use) const {
  const auto is_wheel = [this](int geom) {
    return scene_.roles[static_cast<std::size_t>(geom)].kind == GeomRole::Kind::kWheel;
  };
  for (const bool wheels : {false, true})
    for (int i = 0; i < d->ncon; ++i) {
      const mjContact& c = d->contact[i];
      if ((is_wheel(c.geom[0]) || is_wheel(c.geom[1])) != wheels) continue;
      Contact contact;
      if (Understand(m, d, i, wheels, contact)) use(contact);
    }
}

void ContactReader::ReadPart(const mjModel* m, const mjData* d, Truth& truth) {
  for (Record& record : records_) record.seen_in_part = false;
  ForEachContact(m, d,
                 [&](const Contact& contact) { AddForces(m, d, contact, m->opt.timestep, truth); });
}

void ContactReader::ReadLastPart(const mjModel* m, const mjData* d, std::span<const Vec3> lowest_W,
                                 Truth& truth) {
  truth.wheel_contacts = 0;
  truth.near_hazard = -1;
  support_.clear();
  support_z_m_ = 0;
  for (Record& record : records_) record.seen_in_part = false;
  ForEachContact(m, d, [&](const Contact& contact) {
    AddForces(m, d, contact, m->opt.timestep / parts_, truth);
    if (contact.world.hazard >= 0) truth.near_hazard = contact.world.hazard;
    truth.wheel_contacts += contact.wheel ? 1 : 0;
    if (const int wheel = DrivenWheel(m, contact); wheel >= 0)
      drops_.OnContact(static_cast<std::size_t>(wheel), contact.p_W, contact.normal_W.z(),
                       contact.world.hazard);
    if (contact.carries() && (contact.wheel || contact.normal_n > 0)) AddSupport(contact.p_W);
  });
  // A nose on the base floor is not what holds a body that hangs on an edge as well.
  const auto most = std::ranges::max_element(belly_n_.begin() + 1, belly_n_.end());
  truth.belly_hazard = most != belly_n_.end() && *most > kHangs * truth.belly_load_n
                           ? static_cast<int>(most - belly_n_.begin()) - 1
                           : -1;
  if (truth.near_hazard < 0 && truth.wheel_floor_z_m < -kBelow_m) {  // a wheel that hangs in it
    const auto z = [](const Vec3& p_W) { return p_W.z(); };
    truth.near_hazard = CutAt(std::ranges::min_element(lowest_W, {}, z)->head<2>());
  }
  drops_.Update(m, d, lowest_W, truth);
  MeasureSupport(m, d, truth);
}

bool ContactReader::Understand(const mjModel* m, const mjData* d, int index, bool wheel,
                               Contact& out) const {
  const mjContact& c = d->contact[index];
  if (c.exclude || c.efc_address < 0) return false;
  const auto role = [this](int geom) { return scene_.roles[static_cast<std::size_t>(geom)]; };
  const bool world_first = m->geom_bodyid[c.geom[0]] == 0;
  const double toward = world_first ? 1 : -1;  // the frame's normal points from geom 0 to geom 1
  out.raw = &c;
  out.geom = c.geom[world_first ? 1 : 0];
  out.world = role(c.geom[world_first ? 0 : 1]);
  out.wheel = wheel;
  out.p_W = Vec3(c.pos);
  out.normal_W = toward * Vec3(c.frame);
  // For contacts a micrometre deep, MuJoCo sometimes returns the opposite normal: it points away
  // from the middle of the convex geom that it should push.
  if ((Vec3(d->geom_xpos + 3 * out.geom) - out.p_W).dot(out.normal_W) < 0) out.normal_W *= -1;
  mjtNum force[6];
  mj_contactForce(m, d, index, force);
  out.normal_n = force[0];
  out.friction_W_n = toward * (force[1] * Vec3(c.frame + 3) + force[2] * Vec3(c.frame + 6));
  // The side of a slab of floor is the edge of what is missing beside it; of a hazard's slab, where
  // the hazard would go on there.
  const Vec2 beside_W = out.p_W.head<2>() + kBeside_m * out.normal_W.head<2>();
  if (out.normal_W.z() < kSteep && GoesOn(out.world, beside_W))
    out.world.hazard = std::max(out.world.hazard, CutAt(beside_W));
  return true;
}

bool ContactReader::GoesOn(const GeomRole& slab, const Vec2& p_W) const {
  if (slab.hazard < 0) return slab.kind == GeomRole::Kind::kFloor;
  const Hazard& hazard = map_.hazards[static_cast<std::size_t>(slab.hazard)];
  const auto is_surface = [](const Solid& s) { return s.kind == Solid::Kind::kSurface; };
  if (std::ranges::any_of(hazard.solids, is_surface)) return true;  // the base floor, wet
  return std::ranges::any_of(hazard.footprint,
                             [&](const Polygon& part) { return Contains(part, p_W); });
}

// The hazard whose cut in the floor holds this point; -1: none.
int ContactReader::CutAt(const Vec2& p_W) const {
  for (std::size_t h = map_.hazards.size(); h-- > 0;)
    for (const Solid& solid : map_.hazards[h].solids)
      if (solid.kind == Solid::Kind::kCut && Contains(solid.base, p_W)) return static_cast<int>(h);
  return -1;
}

void ContactReader::AddForces(const mjModel* m, const mjData* d, const Contact& contact,
                              double part_s, Truth& truth) {
  if (contact.world.hazard >= 0 || contact.world.kind == GeomRole::Kind::kWall)
    AddTouch(contact, truth);
  const double nz = contact.normal_W.z();
  if (nz <= kSteep) AddObstacle(m, d, contact, part_s, truth);
  if (!contact.wheel && nz > kWedged) AddBellyLoad(contact, truth);
  if (DrivenWheel(m, contact) >= 0) truth.driven_load_n += contact.force_W_n().z() / parts_;
  if (!contact.carries()) AddSideLoad(contact);
}

void ContactReader::AddTouch(const Contact& contact, Truth& truth) const {
  const auto end = truth.touches.begin() + truth.num_touches;
  auto touch = std::find_if(truth.touches.begin(), end,
                            [&](const Touch& t) { return t.hazard == contact.world.hazard; });
  if (touch == end) {
    if (truth.num_touches == Truth::kMaxTouches) return;
    ++truth.num_touches;
    *touch = {contact.world.hazard, {}, {}};
  }
  const double share = 1.0 / parts_;
  const Vec3 arm_W = contact.p_W - origin_W_;
  const Vec3 push_W_n = share * contact.normal_n * contact.normal_W;
  const Vec3 rub_W_n = share * contact.friction_W_n;
  touch->normal += {push_W_n, arm_W.cross(push_W_n)};
  touch->friction += {rub_W_n, arm_W.cross(rub_W_n)};
}

void ContactReader::AddObstacle(const mjModel* m, const mjData* d, const Contact& contact,
                                double part_s, Truth& truth) {
  Vec2 normal_W = contact.normal_W.head<2>();
  if (normal_W.norm() < 1e-9) return;
  normal_W.normalize();
  ObstacleContact* out = RecordOf(m, d, contact, normal_W, truth);
  if (out == nullptr) return;
  Record& record = records_[static_cast<std::size_t>(out - truth.contacts.data())];
  record.seen_in_part = true;
  const double impulse_ns = contact.normal_n * part_s;
  out->impulse_ns += impulse_ns;
  if (impulse_ns < record.hardest_ns) return;
  record.hardest_ns = impulse_ns;  // where it pressed hardest
  out->p_W = contact.p_W.head<2>();
  out->normal_W = normal_W;
  out->height_m = contact.p_W.z();
}

ObstacleContact* ContactReader::RecordOf(const mjModel* m, const mjData* d, const Contact& contact,
                                         const Vec2& normal_W, Truth& truth) {
  int hazard = contact.world.hazard;
  if (hazard < 0 && contact.world.kind != GeomRole::Kind::kWall) hazard = ObstacleContact::kFloor;
  // Of earlier parts, the nearest between these geoms at the same face.
  constexpr double kSameFace = 0.9;
  const int* geom = contact.raw->geom;
  const auto same = [&](const Record& record, const ObstacleContact& c) {
    return !record.seen_in_part && record.geom[0] == geom[0] && record.geom[1] == geom[1] &&
           c.hazard == hazard && c.normal_W.dot(normal_W) > kSameFace;
  };
  ObstacleContact* nearest = nullptr;
  double nearest_m2 = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(truth.num_contacts); ++i) {
    ObstacleContact& c = truth.contacts[i];
    const double away_m2 = (c.p_W - contact.p_W.head<2>()).squaredNorm();
    if (!same(records_[i], c) || (nearest != nullptr && away_m2 >= nearest_m2)) continue;
    nearest = &c;
    nearest_m2 = away_m2;
  }
  if (nearest != nullptr) return nearest;
  std::size_t n = static_cast<std::size_t>(truth.num_contacts);
  if (n == Truth::kMaxContacts) {  // the body's take the place of a wheel's
    const auto wheel = std::ranges::find_if(truth.contacts, &ObstacleContact::wheel);
    if (contact.wheel || wheel == truth.contacts.end()) return nullptr;
    n = static_cast<std::size_t>(wheel - truth.contacts.begin());
  } else {
    ++truth.num_contacts;
  }
  records_[n] = {{geom[0], geom[1]}, true, 0};
  ObstacleContact& out = truth.contacts[n];
  out = {};
  out.hazard = hazard;
  out.p_W = contact.p_W.head<2>();
  out.normal_W = normal_W;
  out.block = block_of_[static_cast<std::size_t>(m->geom_bodyid[contact.geom])];
  out.closing_mps = ClosingSpeed(m, d, contact, normal_W);
  out.wheel = contact.wheel;
  return &out;
}

// The speed of the touching part, at the point of touch: a body that pitches at the impact moves
// otherwise there than at its origin, and a block that swings otherwise than the robot. A wheel
// moves as the block that carries it, whatever its tread does. Velocities by body are those before
// the part.
double ContactReader::ClosingSpeed(const mjModel* m, const mjData* d, const Contact& contact,
                                   const Vec2& normal_W) const {
  const int touching = m->geom_bodyid[contact.geom];
  const int block = block_of_[static_cast<std::size_t>(touching)];
  const int body =
      contact.wheel ? block_bodies_[static_cast<std::size_t>(block)] : m->body_weldid[touching];
  mjtNum V_W[6];
  mj_objectVelocity(m, d, mjOBJ_XBODY, body, V_W, 0);
  const Vec3 w_W(V_W[0], V_W[1], V_W[2]), v_W(V_W[3], V_W[4], V_W[5]);
  const Vec3 r_W = contact.p_W - Vec3(d->xpos + 3 * body);
  return -Vec3(v_W + w_W.cross(r_W)).head<2>().dot(normal_W);
}

void ContactReader::AddBellyLoad(const Contact& contact, Truth& truth) {
  const double load_n = contact.normal_n * contact.normal_W.z() / parts_;
  truth.belly_load_n += load_n;
  belly_n_[static_cast<std::size_t>(contact.world.hazard + 1)] += load_n;
}

void ContactReader::AddSupport(const Vec3& p_W) {
  if (support_.size() == kMaxSupports) return;
  support_.emplace_back(p_W.x(), p_W.y());
  support_z_m_ += p_W.z();
}

int ContactReader::DrivenWheel(const mjModel* m, const Contact& contact) const {
  if (!contact.wheel || contact.normal_n <= 0 || contact.normal_W.z() <= 0) return -1;
  return wheel_of_[static_cast<std::size_t>(m->geom_bodyid[contact.geom])];
}

void ContactReader::AddSideLoad(const Contact& contact) {
  const Vec3 force_W_n = contact.force_W_n() / parts_;
  load_n_ += force_W_n.z();
  load_nm_ += force_W_n.head<2>() * contact.p_W.z() - contact.p_W.head<2>() * force_W_n.z();
  side_n_ += force_W_n.head<2>();
}

// The centre of mass, seen from above, against the hull of what carries. The moment of what pushes
// from aside counts as so much weight elsewhere: a robot that leans on a wall does not tip.
// Andrew's monotone chain in scratch of fixed size.
void ContactReader::MeasureSupport(const mjModel* m, const mjData* d, Truth& truth) {
  truth.off_support_W.setZero();
  truth.support_margin_m = -far_m_;
  if (support_.empty()) return;
  const mjtNum* com = d->subtree_com + 3 * scene_.base_body;
  const double weight_n = m->body_subtreemass[scene_.base_body] * -m->opt.gravity[2];
  const double z_m = support_z_m_ / static_cast<double>(support_.size());
  Vec2 p(com[0], com[1]);
  if (load_n_ < kHung * weight_n && weight_n > 0)
    p = (weight_n * p + load_nm_ - z_m * side_n_) / (weight_n - load_n_);

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

  Vec2 nearest_W = hull_.front();  // of the border
  bool inside = hull_.size() > 3;  // the first corner stands twice
  for (std::size_t i = 0; i + 1 < hull_.size(); ++i) {
    const Vec2 &a = hull_[i], &b = hull_[i + 1];
    const Vec2 q = a + NearestFraction(a, b, p) * (b - a);
    if ((q - p).squaredNorm() < (nearest_W - p).squaredNorm()) nearest_W = q;
    if (Cross(b - a, p - a) < 0) inside = false;
  }
  const double distance_m = (p - nearest_W).norm();
  truth.support_margin_m = inside ? distance_m : -distance_m;
  if (!inside && distance_m > 0) truth.off_support_W = (p - nearest_W) / distance_m;
}

}  // namespace floorproof
