// SPDX-License-Identifier: Apache-2.0
#include "run/episode/replay_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

// How a shape is drawn.
enum Look { kPlain, kTiles, kWheel, kWall };
// Only what the renderer shows, too (render/renderer.cc): group 3 is seen by the engine alone.
constexpr int kUnseenGroup = 3;

struct Frame {
  std::array<double, 3> pos{0, 0, 0};
  std::array<double, 4> quat{1, 0, 0, 0};
};

Frame Compose(const Frame& a, const double* pos, const double* quat) {
  Frame out;
  mju_rotVecQuat(out.pos.data(), pos, a.quat.data());
  mju_addTo3(out.pos.data(), a.pos.data());
  mju_mulQuat(out.quat.data(), a.quat.data(), quat);
  mju_normalize4(out.quat.data());
  return out;
}

// A hundredth of a millimetre.
double Short(double value) { return std::round(value * 1e5) / 1e5 + 0.0; }
Json List(const double* values, int n) {
  Json list = Json::array();
  for (int i = 0; i < n; ++i) list.push_back(Short(values[i]));
  return list;
}

bool Turns(const mjModel* m, int body) {
  for (int j = 0; j < m->body_jntnum[body]; ++j)
    if (m->jnt_type[m->body_jntadr[body] + j] == mjJNT_HINGE) return true;
  return false;
}

class Builder {
 public:
  Builder(const Scene& scene, const Box2& around, const std::vector<int>& first_of)
      : scene_(scene), m_(scene.model.get()), around_(around), first_of_(first_of) {}

  ReplayScene Build() {
    out_.links = std::make_unique<Json>(Json::array());
    out_.links->push_back(
        {{"parent", -1}, {"pos", {0, 0, 0}}, {"quat", {1, 0, 0, 0}}, {"joints", Json::array()}});
    AddLinks();
    out_.base_link = link_of_[static_cast<std::size_t>(scene_.base_body)];
    mesh_of_.assign(static_cast<std::size_t>(m_->nmesh), -1);
    const int pool_end = scene_.pool.first_geom + scene_.pool.num;
    for (int g = 0; g < m_->ngeom; ++g) {
      if (scene_.pool.num > 0 && g >= scene_.pool.first_geom && g < pool_end) continue;
      if (m_->geom_group[g] == kUnseenGroup) continue;
      AddGeom(g);
    }
    if (scene_.pool.num > 0) AddPooledWalls();
    return std::move(out_);
  }

 private:
  // A body without joints of its own stands in its parent's link, as a roller does.
  void AddLinks() {
    link_of_.assign(static_cast<std::size_t>(m_->nbody), 0);
    in_link_.assign(static_cast<std::size_t>(m_->nbody), Frame{});
    for (int b = 1; b < m_->nbody; ++b) {
      const auto at = static_cast<std::size_t>(b);
      const auto parent = static_cast<std::size_t>(m_->body_parentid[b]);
      const Frame frame = Compose(in_link_[parent], m_->body_pos + 3 * b, m_->body_quat + 4 * b);
      if (m_->body_jntnum[b] == 0 || first_of_[static_cast<std::size_t>(m_->body_jntadr[b])] < 0) {
        link_of_[at] = link_of_[parent];
        in_link_[at] = frame;
        continue;
      }
      Json joints = Json::array();
      for (int j = m_->body_jntadr[b]; j < m_->body_jntadr[b] + m_->body_jntnum[b]; ++j) {
        static constexpr const char* kTypes[] = {"free", "ball", "slide", "hinge"};
        Json joint = {{"type", kTypes[m_->jnt_type[j]]},
                      {"first", first_of_[static_cast<std::size_t>(j)]}};
        if (m_->jnt_type[j] != mjJNT_FREE) joint["anchor"] = List(m_->jnt_pos + 3 * j, 3);
        if (m_->jnt_type[j] == mjJNT_HINGE || m_->jnt_type[j] == mjJNT_SLIDE) {
          joint["axis"] = List(m_->jnt_axis + 3 * j, 3);
          joint["zero"] = Short(m_->qpos0[m_->jnt_qposadr[j]]);
        }
        joints.push_back(std::move(joint));
      }
      const int link = static_cast<int>(out_.links->size());
      out_.links->push_back({{"parent", link_of_[parent]},
                             {"pos", List(frame.pos.data(), 3)},
                             {"quat", List(frame.quat.data(), 4)},
                             {"joints", std::move(joints)}});
      link_of_[at] = link;
    }
  }

  Look LookOf(int g) const {
    const GeomRole& role = scene_.roles[static_cast<std::size_t>(g)];
    if (role.kind == GeomRole::Kind::kFloor && role.hazard < 0) return kTiles;
    if (role.kind == GeomRole::Kind::kWall) return kWall;
    return m_->geom_bodyid[g] != scene_.base_body && Turns(m_, m_->geom_bodyid[g]) ? kWheel
                                                                                   : kPlain;
  }

  std::array<float, 4> ColourOf(int g) const {
    const int material = m_->geom_matid[g];
    const float* rgba = material < 0 ? m_->geom_rgba + 4 * g : m_->mat_rgba + 4 * material;
    return {rgba[0], rgba[1], rgba[2], rgba[3]};
  }

  void Push(int type, int link, int mesh, Look look, const std::array<float, 4>& rgba,
            const double* size, const Frame& frame) {
    for (const int value : {type, link, mesh, static_cast<int>(look)})
      out_.shapes.push_back(static_cast<float>(value));
    out_.shapes.insert(out_.shapes.end(), rgba.begin(), rgba.end());
    for (int i = 0; i < 3; ++i) out_.shapes.push_back(static_cast<float>(size[i]));
    for (const double v : frame.pos) out_.shapes.push_back(static_cast<float>(v));
    for (const double v : frame.quat) out_.shapes.push_back(static_cast<float>(v));
  }

  bool IsNear(const double* pos, double radius_m) const {
    return pos[0] + radius_m >= around_.low.x() && pos[0] - radius_m <= around_.high.x() &&
           pos[1] + radius_m >= around_.low.y() && pos[1] - radius_m <= around_.high.y();
  }

  void AddGeom(int g) {
    const auto rgba = ColourOf(g);
    if (rgba[3] <= 0) return;
    const int body = m_->geom_bodyid[g];
    const int link = link_of_[static_cast<std::size_t>(body)];
    Frame frame = Compose(in_link_[static_cast<std::size_t>(body)], m_->geom_pos + 3 * g,
                          m_->geom_quat + 4 * g);
    std::array<double, 3> size = {m_->geom_size[3 * g], m_->geom_size[3 * g + 1],
                                  m_->geom_size[3 * g + 2]};
    int type = m_->geom_type[g], mesh = -1;
    if (type == mjGEOM_PLANE) {  // endless, or larger than what is shown
      const Vec2 middle = (around_.low + around_.high) / 2, half = around_.Size() / 2;
      if (frame.quat[0] == 1) {
        frame.pos = {middle.x(), middle.y(), frame.pos[2]};
        size = {half.x(), half.y(), 0};
      }
    } else if (link == 0 && !IsNear(frame.pos.data(), m_->geom_rbound[g])) {
      return;
    } else if (type == mjGEOM_MESH) {
      mesh = MeshOf(m_->geom_dataid[g]);
    } else if (type == mjGEOM_HFIELD) {
      mesh = AddHeightField(m_->geom_dataid[g]);
      type = mjGEOM_MESH;
    }
    Push(type, link, mesh, LookOf(g), rgba, size.data(), frame);
  }

  int MeshOf(int id) {
    int& mesh = mesh_of_[static_cast<std::size_t>(id)];
    if (mesh >= 0) return mesh;
    mesh = static_cast<int>(out_.meshes.size());
    ReplayScene::Mesh& copy = out_.meshes.emplace_back();
    const float* vertices = m_->mesh_vert + 3 * m_->mesh_vertadr[id];
    copy.vertices.assign(vertices, vertices + 3 * m_->mesh_vertnum[id]);
    const int* faces = m_->mesh_face + 3 * m_->mesh_faceadr[id];
    for (int i = 0; i < 3 * m_->mesh_facenum[id]; ++i)
      copy.faces.push_back(static_cast<std::uint32_t>(faces[i]));
    return mesh;
  }

  int AddHeightField(int id) {
    const int rows = m_->hfield_nrow[id], columns = m_->hfield_ncol[id];
    const double* size = m_->hfield_size + 4 * id;
    const float* heights = m_->hfield_data + m_->hfield_adr[id];
    ReplayScene::Mesh& mesh = out_.meshes.emplace_back();
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        mesh.vertices.push_back(static_cast<float>(size[0] * (2.0 * c / (columns - 1) - 1)));
        mesh.vertices.push_back(static_cast<float>(size[1] * (2.0 * r / (rows - 1) - 1)));
        mesh.vertices.push_back(static_cast<float>(size[2] * heights[r * columns + c]));
      }
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c + 1 < columns; ++c) {
        const auto corner = static_cast<std::uint32_t>(r * columns + c);
        const auto above = corner + static_cast<std::uint32_t>(columns);
        for (const std::uint32_t v : {corner, corner + 1, above, corner + 1, above + 1, above})
          mesh.faces.push_back(v);
      }
    return static_cast<int>(out_.meshes.size()) - 1;
  }

  // The walls that the pool's geoms stand in for.
  void AddPooledWalls() {
    const auto rgba = ColourOf(scene_.pool.first_geom);
    std::vector<int> near;
    Vec2 low, high;
    const Pose2 X_GW = scene_.pool.X_WG.Inverse();
    low = high = X_GW * around_.low;
    for (const Vec2& corner : {around_.high, Vec2(around_.low.x(), around_.high.y()),
                               Vec2(around_.high.x(), around_.low.y())}) {
      low = low.cwiseMin(X_GW * corner);
      high = high.cwiseMax(X_GW * corner);
    }
    scene_.pool.grid.Near(low, high, near);
    const double half = scene_.pool.X_WG.yaw_rad / 2;
    for (const int i : near) {
      Frame frame;
      frame.quat = {std::cos(half), 0, 0, std::sin(half)};
      std::array<double, 3> size{};
      PlaceWall(scene_.pool.grid.boxes()[static_cast<std::size_t>(i)], scene_.pool.X_WG,
                frame.pos.data(), size.data());
      Push(mjGEOM_BOX, 0, -1, kWall, rgba, size.data(), frame);
    }
  }

  const Scene& scene_;
  const mjModel* m_;
  const Box2& around_;
  const std::vector<int>& first_of_;
  ReplayScene out_;
  std::vector<int> link_of_, mesh_of_;
  std::vector<Frame> in_link_;  // of each body, at rest
};

}  // namespace

ReplayScene::ReplayScene() = default;
ReplayScene::ReplayScene(ReplayScene&&) noexcept = default;
ReplayScene::~ReplayScene() = default;

bool IsRoller(const mjModel* m, int body) {
  if (m->body_jntnum[body] != 1 || !Turns(m, body) || !Turns(m, m->body_parentid[body]))
    return false;
  for (int b = body + 1; b < m->nbody; ++b)
    if (m->body_parentid[b] == body) return false;
  return true;
}

ReplayScene ReplaySceneOf(const Scene& scene, const Box2& around,
                          const std::vector<int>& first_of) {
  return Builder(scene, around, first_of).Build();
}

}  // namespace floorproof
