// SPDX-License-Identifier: Apache-2.0
#include "env/scene/compiled_robot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "base/printable.h"
#include "env/scene/lock_blocks.h"
#include "env/scene/mesh_hull.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {

CompiledRobot::CompiledRobot(const mjModel* model, std::string file)
    : m_(model), file_(std::move(file)) {
  const int base = mj_name2id(m_, mjOBJ_BODY, "base");
  if (base < 0) Refuse("base", "a robot needs a body named base");
  if (m_->body_jntnum[base] != 1 || m_->jnt_type[m_->body_jntadr[base]] != mjJNT_FREE)
    Refuse("base", "the body base needs a free joint");
  data_ = MakeData(m_);
  ForwardEngine(m_, data_.get());
  blocks_ = {base};
  for (const auto& name : Words(kLockedBlocks))
    blocks_.push_back(mj_name2id(m_, mjOBJ_BODY, name.c_str()));
}

void CompiledRobot::Refuse(std::string_view key, std::string_view rule) const {
  throw InputError({file_, 0}, key, "", rule);
}

double CompiledRobot::Number(const char* name, const Bounds& rule) const {
  const int id = mj_name2id(m_, mjOBJ_NUMERIC, name);
  if (id < 0) Refuse(name, "missing under <custom>");
  const double value = m_->numeric_data[m_->numeric_adr[id]];
  if (!rule.Allows(value)) throw InputError({file_, 0}, name, FormatDouble(value), rule.Text());
  return value;
}

std::string CompiledRobot::Text(const char* name) const {
  const int id = mj_name2id(m_, mjOBJ_TEXT, name);
  if (id < 0) Refuse(name, "missing under <custom>");
  const std::string text = m_->text_data + m_->text_adr[id];
  if (const std::string why = WhyUnprintable(text); !why.empty()) Refuse(name, why);
  return text;
}

std::optional<double> CompiledRobot::OptionalNumber(const char* name, const Bounds& rule) const {
  if (mj_name2id(m_, mjOBJ_NUMERIC, name) < 0) return {};
  return Number(name, rule);
}

std::optional<std::string> CompiledRobot::OptionalText(const char* name) const {
  if (mj_name2id(m_, mjOBJ_TEXT, name) < 0) return {};
  return Text(name);
}

std::vector<std::string> CompiledRobot::Words(const char* name) const {
  std::istringstream in(OptionalText(name).value_or(""));
  return {std::istream_iterator<std::string>(in), {}};
}

Vec3 CompiledRobot::InBase(const mjtNum* p_W) const {
  mjtNum offset[3], p_B[3];
  mju_sub3(offset, p_W, data_->xpos + 3 * base());
  mju_mulMatTVec3(p_B, data_->xmat + 9 * base(), offset);
  return {p_B[0], p_B[1], p_B[2]};
}

bool CompiledRobot::IsBlock(int body) const {
  return std::ranges::find(blocks_, body) != blocks_.end();
}

int CompiledRobot::BlockOf(int body) const {
  for (; body > 0; body = m_->body_parentid[body])
    if (const auto at = std::ranges::find(blocks_, body); at != blocks_.end())
      return static_cast<int>(at - blocks_.begin());
  return 0;
}

namespace {

Eigen::Matrix3d AttitudeOf(const mjtNum* mat) {
  Eigen::Matrix3d R;
  for (int i = 0; i < 9; ++i) R(i / 3, i % 3) = mat[i];
  return R;
}

// The farthest points of a round geom, in its own frame, in directions all around in the world's
// frame: its extents up, down and to the sides are exact. `R_WG`: its attitude.
std::vector<Vec3> RoundPoints(int type, const Vec3& size, const Eigen::Matrix3d& R_WG) {
  constexpr int kAround = 72, kUp = 6;
  std::vector<Vec3> points;
  for (int up = -kUp; up <= kUp; ++up) {
    const double elevation_rad = kPi / 2 * up / kUp;
    for (int k = 0; k < (std::abs(up) == kUp ? 1 : kAround); ++k) {
      const double bearing_rad = 2 * kPi * k / kAround;
      const Vec3 toward_W(std::cos(elevation_rad) * std::cos(bearing_rad),
                          std::cos(elevation_rad) * std::sin(bearing_rad), std::sin(elevation_rad));
      const Vec3 toward = R_WG.transpose() * toward_W;
      if (type == mjGEOM_ELLIPSOID) {
        points.push_back(size.cwiseProduct(size.cwiseProduct(toward).normalized()));
        continue;
      }
      points.push_back(size.x() * toward);
      if (type == mjGEOM_CAPSULE) points.back().z() += std::copysign(size.y(), toward.z());
    }
  }
  return points;
}

}  // namespace

std::vector<Vec3> CompiledRobot::SurfacePoints(int geom) const {
  const mjtNum* size = m_->geom_size + 3 * geom;
  const mjtNum* pos = data_->geom_xpos + 3 * geom;
  const mjtNum* mat = data_->geom_xmat + 9 * geom;
  std::vector<Vec3> points;
  const auto add = [&](double x, double y, double z) {
    const mjtNum local[3] = {x, y, z};
    mjtNum world[3];
    mju_mulMatVec3(world, mat, local);
    mju_addTo3(world, pos);
    points.push_back(InBase(world));
  };
  constexpr int kAround = 72;
  const auto add_rings = [&](double radius, double half_height) {
    for (int k = 0; k < kAround; ++k) {
      const double c = radius * std::cos(2 * kPi * k / kAround);
      const double s = radius * std::sin(2 * kPi * k / kAround);
      add(c, s, -half_height);
      add(c, s, half_height);
    }
  };
  switch (m_->geom_type[geom]) {
    case mjGEOM_BOX:
      for (int k = 0; k < 8; ++k)
        add(k & 1 ? size[0] : -size[0], k & 2 ? size[1] : -size[1], k & 4 ? size[2] : -size[2]);
      break;
    case mjGEOM_CYLINDER: {
      const double rollers = RollersOf(m_, geom).radius_m;
      add_rings(size[0] + rollers, size[1]);
      if (rollers > 0) add_rings(size[0], size[1] + rollers);
      break;
    }
    case mjGEOM_SPHERE:
    case mjGEOM_CAPSULE:
    case mjGEOM_ELLIPSOID:
      for (const Vec3& p : RoundPoints(m_->geom_type[geom], Vec3(size), AttitudeOf(mat)))
        add(p.x(), p.y(), p.z());
      break;
    case mjGEOM_MESH:  // its convex hull is what collides
      ForEachHullVertex(m_, m_->geom_dataid[geom],
                        [&](const Vec3& p) { add(p.x(), p.y(), p.z()); });
      break;
    default: {  // the axis-aligned box in the geom's frame bounds every other type
      const mjtNum* box = m_->geom_aabb + 6 * geom;
      for (int k = 0; k < 8; ++k)
        add(box[0] + (k & 1 ? box[3] : -box[3]), box[1] + (k & 2 ? box[4] : -box[4]),
            box[2] + (k & 4 ? box[5] : -box[5]));
    }
  }
  return points;
}

int CompiledRobot::UprightHinge(int geom, bool driven) const {
  constexpr double kUpright = 0.99;
  for (int body = m_->geom_bodyid[geom]; body > 0 && !IsBlock(body); body = m_->body_parentid[body])
    for (int k = 0; k < m_->body_jntnum[body]; ++k) {
      const int joint = m_->body_jntadr[body] + k;
      bool turned = false;
      for (int a = 0; a < m_->nu; ++a)
        turned |= m_->actuator_trntype[a] == mjTRN_JOINT && m_->actuator_trnid[2 * a] == joint;
      if (turned == driven && m_->jnt_type[joint] == mjJNT_HINGE &&
          std::abs(data_->xaxis[3 * joint + 2]) >= kUpright)
        return joint;
    }
  return -1;
}

std::optional<Swivel> CompiledRobot::SwivelOf(int geom) const {
  const int joint = UprightHinge(geom, false);
  if (joint < 0) return {};
  const Vec3 pivot_B = InBase(data_->xanchor + 3 * joint);
  const Vec3 centre_B = InBase(data_->geom_xpos + 3 * geom);
  return Swivel{pivot_B, (centre_B - pivot_B).head<2>().norm()};
}

std::vector<Vec3> CompiledRobot::SweptPoints(int geom) const {
  constexpr int kAround = 24;
  const std::vector<Vec3> points = SurfacePoints(geom);
  double from_rad = 0, turn_rad = 2 * kPi;
  int joint = UprightHinge(geom, false);
  if (joint < 0) {
    joint = UprightHinge(geom, true);
    if (joint < 0) return points;
    from_rad = m_->jnt_range[2 * joint];
    turn_rad = m_->jnt_range[2 * joint + 1] - from_rad;
  }
  const Vec3 pivot_B = InBase(data_->xanchor + 3 * joint);
  std::vector<Vec3> swept;
  for (int k = 0; k <= kAround; ++k) {
    const Eigen::AngleAxisd turn(from_rad + turn_rad * k / kAround, Vec3::UnitZ());
    for (const Vec3& p : points) swept.push_back(pivot_B + turn * (p - pivot_B));
  }
  return swept;
}

}  // namespace floorproof
