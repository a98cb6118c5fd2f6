// SPDX-License-Identifier: Apache-2.0
#include "env/sim/live_geoms.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "env/scene/robot_reach.h"

namespace floorproof {
namespace {

constexpr int kFewPairs = 16, kFewFixed = 2;  // cost less than the choice among them
constexpr double kHair_m = 1e-6;              // by which bounds are wider than what they hold
constexpr double kEndless_m = 1e9;            // of a plane

// Upper bound of the angle between two rotations: 4 asin(chord / 2).
double AngleBetween(const mjtNum* q1, const mjtNum* q2) {
  double minus = 0, plus = 0;
  for (int i = 0; i < 4; ++i) {
    minus += (q1[i] - q2[i]) * (q1[i] - q2[i]);
    plus += (q1[i] + q2[i]) * (q1[i] + q2[i]);
  }
  return kPi * std::sqrt(std::min(minus, plus));  // as asin x <= x pi / 2
}

Vec3 Centre(const mjData* d, int geom) { return Vec3(d->geom_xpos + 3 * geom); }

}  // namespace

bool LiveGeoms::Bounds::Meets(const Bounds& other) const {
  return (low_W.array() <= other.high_W.array()).all() &&
         (high_W.array() >= other.low_W.array()).all();
}

double LiveGeoms::Bounds::Distance(const Vec3& p_W) const {
  return (low_W - p_W).cwiseMax(p_W - high_W).cwiseMax(0.0).norm();
}

LiveGeoms::LiveGeoms(const Scene& scene, const mjModel& model) : scene_(scene), model_(model) {
  const bool pool = scene.pool.num > 0, pairs = model_.npair > kFewPairs,
             fixed = model_.body_geomnum[0] > kFewFixed;
  if (!(pool || pairs || fixed) || !NearnessIsKnown(&model_, scene.base_body)) return;
  const auto ngeom = static_cast<std::size_t>(model_.ngeom);
  const std::vector<bool> touches = CanTouch(&model_);
  const int past_pool = scene.pool.first_geom + scene.pool.num;
  ball_of_.assign(ngeom, -1);
  bounds_.resize(ngeom);
  near_.assign(ngeom, 1);
  for (int g = 0; g < model_.ngeom; ++g) {
    const int body = model_.geom_bodyid[g];
    if (!touches[static_cast<std::size_t>(g)]) continue;
    if (model_.body_rootid[body] == scene.base_body) {
      ball_of_[static_cast<std::size_t>(g)] = static_cast<int>(balls_.size());
      balls_.push_back({g, TouchRadius(&model_, g)});
    } else if (body == 0 && !(pool && g >= scene.pool.first_geom && g < past_pool)) {
      fixed_.push_back(g);
      bounds_[static_cast<std::size_t>(g)] = StaticBounds(g);
    }
  }
  const RobotReach reach = ComputeReach(&model_, scene.base_body);
  for (int j = 0; j < model_.njnt; ++j) {
    const double arm_m = reach.arm_m[static_cast<std::size_t>(j)];
    const int type = model_.jnt_type[j];
    if (type == mjJNT_SLIDE || (type != mjJNT_FREE && arm_m > kHair_m))
      swings_.push_back({j, arm_m});
  }
  body_moved_m_.resize(static_cast<std::size_t>(model_.nbody));
  qpos_.resize(static_cast<std::size_t>(model_.nq));
  if (pool) OwnPool();
  if (pool || fixed) OwnTree();
  if (pairs) OwnPairs();
}

template <class T>
void LiveGeoms::Own(T*& values, std::size_t count, std::vector<T>& store) {
  store.assign(values, values + count);
  values = store.data();
}

void LiveGeoms::OwnPool() {
  const auto ngeom = static_cast<std::size_t>(model_.ngeom);
  Own(model_.geom_pos, 3 * ngeom, pos_);
  Own(model_.geom_size, 3 * ngeom, size_);
  Own(model_.geom_aabb, 6 * ngeom, aabb_);
  Own(model_.geom_rbound, ngeom, rbound_);
  found_.reserve(static_cast<std::size_t>(scene_.pool.num));
}

void LiveGeoms::OwnTree() {
  const auto nbvh = static_cast<std::size_t>(model_.nbvh);
  Own(model_.bvh_child, 2 * nbvh, child_);
  Own(model_.bvh_nodeid, nbvh, nodeid_);
  Own(model_.bvh_aabb, 6 * static_cast<std::size_t>(model_.nbvhstatic), node_aabb_);
  leaves_.reserve(fixed_.size() + static_cast<std::size_t>(scene_.pool.num));
}

template <class T>
void LiveGeoms::OwnColumn(T*& values, int width, std::vector<Column<T>>& columns) {
  const auto count = static_cast<std::size_t>(model_.npair * width);
  columns.push_back({values, std::vector<T>(values, values + count), width});
  values = columns.back().live.data();
}

void LiveGeoms::OwnPairs() {
  mjModel& m = model_;
  for (int** values : {&m.pair_dim, &m.pair_geom1, &m.pair_geom2, &m.pair_signature})
    OwnColumn(*values, 1, int_columns_);
  for (mjtNum** values : {&m.pair_margin, &m.pair_gap, &m.pair_adhesion})
    OwnColumn(*values, 1, columns_);
  OwnColumn(m.pair_solref, mjNREF, columns_);
  OwnColumn(m.pair_solreffriction, mjNREF, columns_);
  OwnColumn(m.pair_solimp, mjNIMP, columns_);
  OwnColumn(m.pair_friction, 5, columns_);
}

// What holds a geom of the world, which never moves.
LiveGeoms::Bounds LiveGeoms::StaticBounds(int geom) const {
  if (model_.geom_type[geom] == mjGEOM_PLANE)
    return {Vec3::Constant(-kEndless_m), Vec3::Constant(kEndless_m)};
  const mjtNum* box = model_.geom_aabb + 6 * geom;
  mjtNum mat[9], centre[3];
  mju_quat2Mat(mat, model_.geom_quat + 4 * geom);
  mju_mulMatVec3(centre, mat, box);
  mju_addTo3(centre, model_.geom_pos + 3 * geom);
  Vec3 half = Vec3::Constant(kHair_m);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) half[i] += std::abs(mat[3 * i + k]) * box[3 + k];
  return {Vec3(centre) - half, Vec3(centre) + half};
}

void LiveGeoms::Update(mjData* d) {
  if (balls_.empty()) return;
  if (!chosen_ || !(Moved(d->qpos) <= kTrigger_m)) Choose(d);
}

// At most how far the centre of a colliding geom of the robot is from where it was.
double LiveGeoms::Moved(const mjtNum* qpos) {
  const mjModel& m = model_;
  const int root = m.jnt_qposadr[m.body_jntadr[scene_.base_body]];
  const mjtNum *q = qpos + root, *q0 = qpos_.data() + root;
  const double by_base = (Vec3(q) - Vec3(q0)).norm() + AngleBetween(q + 3, q0 + 3) * reach_m_;
  if (swings_.empty()) return by_base;
  double by_joints = 0;
  std::size_t s = 0;  // joints stand in the order of their bodies, and parents before children
  for (int b = 1; b < m.nbody; ++b) {
    double moved = body_moved_m_[static_cast<std::size_t>(m.body_parentid[b])];
    for (; s < swings_.size() && m.jnt_bodyid[swings_[s].joint] == b; ++s) {
      const int adr = m.jnt_qposadr[swings_[s].joint], type = m.jnt_type[swings_[s].joint];
      const double by = std::abs(qpos[adr] - qpos_[static_cast<std::size_t>(adr)]);
      if (type == mjJNT_SLIDE)
        moved += by;
      else
        moved += swings_[s].arm_m * (type == mjJNT_HINGE ? std::min(by, 2.0) : 2.0);
    }
    body_moved_m_[static_cast<std::size_t>(b)] = moved;
    by_joints = std::max(by_joints, moved);
  }
  // The base's turn swings what the joints have moved, too.
  return by_base + by_joints;
}

void LiveGeoms::Choose(mjData* d) {
  mj_kinematics(&model_, d);
  std::copy_n(d->qpos, model_.nq, qpos_.begin());
  const Vec3 base = Vec3(d->xpos + 3 * scene_.base_body);
  Bounds robot{Vec3::Constant(kEndless_m), Vec3::Constant(-kEndless_m)};
  reach_m_ = 0;
  for (const Ball& ball : balls_) {
    const Vec3 centre = Centre(d, ball.geom), half = Vec3::Constant(ball.radius_m + kSlack_m);
    robot = {robot.low_W.cwiseMin(centre - half), robot.high_W.cwiseMax(centre + half)};
    reach_m_ = std::max(reach_m_, (centre - base).norm());
  }
  for (const int g : fixed_)
    near_[static_cast<std::size_t>(g)] = robot.Meets(bounds_[static_cast<std::size_t>(g)]);
  if (!pos_.empty()) ChooseWalls(d);
  if (!child_.empty()) BuildTree();
  if (!columns_.empty()) ChoosePairs(d);
  chosen_ = true;
}

void LiveGeoms::ChooseWalls(const mjData* d) {
  const WallPool& pool = scene_.pool;
  const Pose2 X_GW = pool.X_WG.Inverse();
  Vec2 low = Vec2::Constant(kEndless_m), high = -low;
  for (const Ball& ball : balls_) {
    const Vec2 p_G = X_GW * Vec2(Centre(d, ball.geom).head<2>());
    const Vec2 half = Vec2::Constant(ball.radius_m + kSlack_m);
    low = low.cwiseMin(p_G - half);
    high = high.cwiseMax(p_G + half);
  }
  pool.grid.Near(low, high, found_);
  if (found_.size() > static_cast<std::size_t>(pool.num))
    throw InternalError("more walls are near the robot than its scene has room for");

  for (std::size_t i = 0; i < static_cast<std::size_t>(pool.num); ++i) {
    const std::size_t g = static_cast<std::size_t>(pool.first_geom) + i;
    mjtNum *pos = &pos_[3 * g], *size = &size_[3 * g];
    if (i < found_.size())
      PlaceWall(pool.grid.boxes()[static_cast<std::size_t>(found_[i])], pool.X_WG, pos, size);
    else
      ParkWall(pos, size);
    mju_copy3(&aabb_[6 * g + 3], size);
    rbound_[g] = mju_norm3(size);
    bounds_[g] = StaticBounds(static_cast<int>(g));
  }
}

void LiveGeoms::BuildTree() {
  leaves_.clear();
  for (const int g : fixed_)
    if (near_[static_cast<std::size_t>(g)]) leaves_.push_back(g);
  if (const int first = scene_.pool.first_geom; first >= 0)
    for (int g = first; g < first + static_cast<int>(found_.size()); ++g) leaves_.push_back(g);
  nodes_ = 0;
  // With nothing near, whatever tree there was finds nothing.
  if (!leaves_.empty()) AddNode(leaves_.begin(), leaves_.end());
}

// A node of the world's tree over these geoms, split in the middle of its longest side, as MuJoCo's
// compiler does; returns its number in the tree.
int LiveGeoms::AddNode(std::vector<int>::iterator begin, std::vector<int>::iterator end) {
  const auto bounds = [this](int g) -> const Bounds& {
    return bounds_[static_cast<std::size_t>(g)];
  };
  Bounds all = bounds(*begin);
  for (auto leaf = begin + 1; leaf != end; ++leaf)
    all = {all.low_W.cwiseMin(bounds(*leaf).low_W), all.high_W.cwiseMax(bounds(*leaf).high_W)};
  const int node = nodes_++;
  const auto at = static_cast<std::size_t>(model_.body_bvhadr[0] + node);
  const Vec3 middle = (all.low_W + all.high_W) / 2, half = (all.high_W - all.low_W) / 2;
  // Endless, as MuJoCo knows it, where it holds a plane.
  const double side = half.maxCoeff() >= kEndless_m / 2 ? mjMAXVAL : 0;
  for (int k = 0; k < 3; ++k) {
    node_aabb_[6 * at + static_cast<std::size_t>(k)] = middle[k];
    node_aabb_[6 * at + 3 + static_cast<std::size_t>(k)] = std::max(half[k], side);
  }
  child_[2 * at] = child_[2 * at + 1] = -1;
  nodeid_[at] = end - begin == 1 ? *begin : -1;
  if (end - begin == 1) return node;
  int axis = 0;
  half.maxCoeff(&axis);
  const auto split = begin + (end - begin) / 2;
  std::nth_element(begin, split, end, [&](int g, int h) {
    const double a = bounds(g).low_W[axis] + bounds(g).high_W[axis],
                 b = bounds(h).low_W[axis] + bounds(h).high_W[axis];
    return a < b || (a == b && g < h);
  });
  child_[2 * at] = AddNode(begin, split);
  child_[2 * at + 1] = AddNode(split, end);
  return node;
}

void LiveGeoms::ChoosePairs(const mjData* d) {
  const mjModel& all = *scene_.model;
  int live = 0;
  for (int i = 0; i < all.npair; ++i) {
    int robot = all.pair_geom1[i], other = all.pair_geom2[i];
    if (ball_of_[static_cast<std::size_t>(robot)] < 0) std::swap(robot, other);
    const int ball = ball_of_[static_cast<std::size_t>(robot)];
    if (ball >= 0 && all.geom_bodyid[other] == 0) {
      if (!near_[static_cast<std::size_t>(other)]) continue;
      const double radius_m = balls_[static_cast<std::size_t>(ball)].radius_m;
      if (bounds_[static_cast<std::size_t>(other)].Distance(Centre(d, robot)) > radius_m + kSlack_m)
        continue;
    }
    const auto copy = [i, live](auto& column) {
      std::copy_n(column.all + i * column.width, column.width,
                  column.live.begin() + live * column.width);
    };
    for (auto& column : int_columns_) copy(column);
    for (auto& column : columns_) copy(column);
    ++live;
  }
  model_.npair = live;
}

}  // namespace floorproof
