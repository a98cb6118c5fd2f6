// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_model.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/params.h"
#include "env/scene/engine.h"
#include "env/scene/engine_files.h"
#include "env/scene/engine_refusal.h"
#include "env/scene/mesh_hull.h"
#include "env/urdf/link_mass.h"
#include "env/urdf/urdf_text.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kHullCorners = 64;  // as many as a mesh's hull needs

// The meshes that are there, by the names that the text gives them.
class MeshFiles {
 public:
  MeshFiles(const UrdfText& text, const InputFiles& files) {
    mj_defaultVFS(&vfs_);
    for (const UrdfMesh& mesh : text.meshes) {
      const std::string& bytes =
          mesh.obj.empty() ? files.Read(mesh.file, EngineFiles::kMaxBytes) : mesh.obj;
      mj_addBufferVFS(&vfs_, mesh.name.c_str(), bytes.data(), static_cast<int>(bytes.size()));
    }
  }
  ~MeshFiles() { mj_deleteVFS(&vfs_); }
  MeshFiles(const MeshFiles&) = delete;
  MeshFiles& operator=(const MeshFiles&) = delete;
  const mjVFS* vfs() const { return &vfs_; }

 private:
  mjVFS vfs_{};
};

[[noreturn]] void Refuse(const fs::path& file, const UrdfText& text, std::string message,
                         std::string_view rule) {
  for (const UrdfMesh& mesh : text.meshes)
    if (const std::size_t at = message.find(mesh.name); at != std::string::npos)
      message.replace(at, mesh.name.size(), mesh.file.filename().string());
  throw EngineRefusal(file, rule, message);
}

template <class T>
void ForEach(mjSpec* spec, mjtObj type, T* (*as)(mjsElement*), const auto& visit) {
  for (mjsElement* e = mjs_firstElement(spec, type); e; e = mjs_nextElement(spec, e)) visit(as(e));
}

// What the file states of each body's mass; the model that is compiled for its shapes and places
// has other, sound ones.
std::map<std::string, StatedMass> TakeMasses(mjSpec* spec) {
  std::map<std::string, StatedMass> stated;
  ForEach<mjsBody>(spec, mjOBJ_BODY, mjs_asBody, [&](mjsBody* body) {
    StatedMass& mass = stated[mjs_getString(mjs_getName(body->element))];
    mass.mass_kg = body->mass;
    mass.com = Vec3(body->ipos);
    const double* full = body->fullinertia;
    mass.inertia << full[0], full[3], full[4], full[3], full[1], full[5], full[4], full[5], full[2];
    const Eigen::Quaterniond q(body->iquat[0], body->iquat[1], body->iquat[2], body->iquat[3]);
    mass.axes = q.toRotationMatrix();
    body->explicitinertial = 1;
    body->mass = 1;
    std::fill_n(body->inertia, 3, 1.0);
    std::fill_n(body->ipos, 3, 0.0);
    body->iquat[0] = 1;
    std::fill_n(body->iquat + 1, 3, 0.0);
    body->fullinertia[0] = std::nan("");
  });
  return stated;
}

UrdfShape ShapeOf(const mjModel* m, const mjData* d, int geom, bool collides) {
  UrdfShape shape;
  using Kind = UrdfShape::Kind;
  shape.size = Vec3(m->geom_size + 3 * geom);
  shape.p_M = Vec3(d->geom_xpos + 3 * geom);
  const mjtNum* R = d->geom_xmat + 9 * geom;
  shape.R_M << R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8];
  shape.collides = collides;
  std::copy_n(m->geom_rgba + 4 * geom, 4, shape.rgba.begin());
  switch (m->geom_type[geom]) {
    case mjGEOM_CYLINDER:
      shape.kind = Kind::kCylinder;
      break;
    case mjGEOM_SPHERE:
      shape.kind = Kind::kSphere;
      break;
    case mjGEOM_CAPSULE:
      shape.kind = Kind::kCapsule;
      break;
    case mjGEOM_MESH:
      shape.kind = Kind::kHull;
      ForEachHullVertex(m, m->geom_dataid[geom], [&](const Vec3& p) { shape.hull.push_back(p); });
      break;
    default:
      shape.kind = Kind::kBox;
  }
  return shape;
}

// Joints whose range leaves 0 out stand where it is nearest.
void Pose(const mjModel* m, mjData* d) {
  for (int j = 0; j < m->njnt; ++j) {
    const bool one = m->jnt_type[j] == mjJNT_HINGE || m->jnt_type[j] == mjJNT_SLIDE;
    if (one && m->jnt_limited[j])
      d->qpos[m->jnt_qposadr[j]] = std::clamp(0.0, m->jnt_range[2 * j], m->jnt_range[2 * j + 1]);
  }
  ForwardEngine(m, d);
}

void ReadJoint(const mjModel* m, const mjData* d, int body, const UrdfText& text, UrdfLink& link) {
  if (m->body_jntnum[body] == 0) return;
  const int j = m->body_jntadr[body];
  link.joint = m->jnt_type[j] == mjJNT_HINGE   ? UrdfLink::Joint::kHinge
               : m->jnt_type[j] == mjJNT_SLIDE ? UrdfLink::Joint::kSlide
                                               : UrdfLink::Joint::kBall;
  link.axis_M = Vec3(d->xaxis + 3 * j);
  link.joint_name = mj_id2name(m, mjOBJ_JOINT, j);
  const auto written = std::ranges::find(text.joints, link.joint_name, &UrdfJoint::name);
  if (written == text.joints.end()) return;
  link.turns_freely = link.joint == UrdfLink::Joint::kHinge &&
                      (written->type == "continuous" || !m->jnt_limited[j]);
  link.effort_nm = written->effort;
  link.velocity_radps = written->velocity;
}

std::vector<UrdfLink> LinksOf(const mjModel* m, const mjData* d, const UrdfText& text,
                              const std::vector<char>& collides) {
  std::vector<UrdfLink> links;
  for (int b = 0; b < m->nbody; ++b) {
    UrdfLink& link = links.emplace_back();
    link.name = mj_id2name(m, mjOBJ_BODY, b);
    link.parent = b > 0 ? m->body_parentid[b] : -1;
    link.p_M = Vec3(d->xpos + 3 * b);
    const auto lost = std::ranges::find(text.lost_collisions, link.name, &LostMesh::link);
    if (lost != text.lost_collisions.end()) link.lost_mesh = lost->why;
    ReadJoint(m, d, b, text, link);
    for (int g = m->body_geomadr[b]; g < m->body_geomadr[b] + m->body_geomnum[b]; ++g)
      link.shapes.push_back(ShapeOf(m, d, g, collides[static_cast<std::size_t>(g)] != 0));
  }
  return links;
}

}  // namespace

std::vector<Vec3> UrdfShape::Points() const {
  constexpr int kAround = 48, kRings = 12;
  std::vector<Vec3> points;
  const auto add = [&](double x, double y, double z) {
    points.push_back(p_M + R_M * Vec3(x, y, z));
  };
  const auto ring = [&](double radius, double z) {
    for (int k = 0; k < kAround; ++k)
      add(radius * std::cos(2 * kPi * k / kAround), radius * std::sin(2 * kPi * k / kAround), z);
  };
  switch (kind) {
    case Kind::kBox:
      for (int k = 0; k < 8; ++k)
        add(k & 1 ? size.x() : -size.x(), k & 2 ? size.y() : -size.y(),
            k & 4 ? size.z() : -size.z());
      break;
    case Kind::kCylinder:
      ring(size.x(), -size.y());
      ring(size.x(), size.y());
      break;
    case Kind::kSphere:
    case Kind::kCapsule:
      for (int k = 0; k <= kRings; ++k) {
        const double angle = kPi * (static_cast<double>(k) / kRings - 0.5);
        const double raised = kind == Kind::kCapsule ? std::copysign(size.y(), angle) : 0;
        ring(size.x() * std::cos(angle), size.x() * std::sin(angle) + raised);
      }
      // Exactly as low and as high, however it is turned.
      for (const double side : {-1.0, 1.0}) {
        const double tip = kind == Kind::kCapsule ? std::abs(R_M(2, 2)) * size.y() : 0;
        points.push_back(p_M + side * (size.x() + tip) * Vec3::UnitZ());
      }
      break;
    case Kind::kHull:
      for (const Vec3& p : hull) add(p.x(), p.y(), p.z());
      break;
  }
  return points;
}

void UrdfModel::MoveInto(const Mat3& R_MN, const Vec3& p_MN) {
  const Mat3 R_NM = R_MN.transpose();
  const auto move = [&](Vec3& p_M) { p_M = R_NM * (p_M - p_MN); };
  for (UrdfLink& link : links) {
    move(link.p_M);
    link.axis_M = R_NM * link.axis_M;
    move(link.mass.com_M);
    link.mass.inertia_M = R_NM * link.mass.inertia_M * R_MN;
    for (UrdfShape& shape : link.shapes) {
      move(shape.p_M);
      shape.R_M = R_NM * shape.R_M;
    }
  }
}

UrdfModel ReadUrdfModel(const fs::path& file, const InputFiles& files) {
  const UrdfText text = PrepareUrdf(file, files);
  UrdfModel out;
  out.name = text.robot;
  out.notes = text.notes;
  const MeshFiles meshes(text, files);
  char error[1000] = "";
  const SpecPtr spec(mj_parseXMLString(text.xml.c_str(), meshes.vfs(), error, sizeof error));
  if (!spec) Refuse(file, text, error, "is not URDF that MuJoCo reads");
  const auto stated = TakeMasses(spec.get());
  std::vector<std::pair<mjsElement*, bool>> geoms;
  ForEach<mjsGeom>(spec.get(), mjOBJ_GEOM, mjs_asGeom, [&](mjsGeom* geom) {
    geoms.emplace_back(geom->element, geom->contype != 0);
    geom->contype = 1;  // so that every mesh gets its hull
  });
  ForEach<mjsMesh>(spec.get(), mjOBJ_MESH, mjs_asMesh,
                   [](mjsMesh* mesh) { mesh->maxhullvert = kHullCorners; });
  const ModelPtr model(mj_compile(spec.get(), meshes.vfs()));
  if (!model) Refuse(file, text, mjs_getError(spec.get()), "MuJoCo does not take it");
  std::vector<char> collides(static_cast<std::size_t>(model->ngeom));
  for (const auto& [element, solid] : geoms)
    collides[static_cast<std::size_t>(mjs_getId(element))] = solid;
  const DataPtr data = MakeData(model.get());
  Pose(model.get(), data.get());
  out.links = LinksOf(model.get(), data.get(), text, collides);
  for (std::size_t b = 0; b < out.links.size(); ++b) {
    const mjtNum* R = data->xmat + 9 * b;
    Mat3 R_ML;
    R_ML << R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8];
    const auto mass = stated.find(out.links[b].name);
    if (mass != stated.end()) ReadMass(mass->second, R_ML, file, out.links[b], out.notes);
  }
  return out;
}

}  // namespace floorproof
