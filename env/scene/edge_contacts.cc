// SPDX-License-Identifier: Apache-2.0
#include "env/scene/edge_contacts.h"

#include <algorithm>
#include <array>
#include <optional>

#include "env/geometry/geometry.h"
#include "env/scene/farthest_along.h"
#include "env/scene/world_geoms.h"

namespace floorproof {
namespace {

// Indices in a geom's user data: the mark, the number of its memory, the length of a whole step, s.
constexpr int kMarkAt = 3, kNumberAt = 4, kStepAt = 5, kUserData = 6;
constexpr double kMark = 1414213.562;  // other programs' models have user data of their own

constexpr double kMaxDepth_m = 0.02;  // a geom that is deeper did not come from the side
constexpr double kApart_m = 2e-4;     // gap between geoms that are just apart; lowest edge
constexpr double kMaxSideZ = 0.5;     // largest z of a normal at a side
constexpr double kAlike = 0.999;      // dot product of two equal normals
constexpr double kCarries = 0.9;      // least z of a normal at a floor

std::array<std::array<mjfCollision, mjNGEOMTYPES>, mjNGEOMTYPES> g_original;

bool IsMarked(const mjModel* m, int geom) {
  return m->nuser_geom >= kUserData && m->geom_user[m->nuser_geom * geom + kMarkAt] == kMark;
}

// The memory of a body geom: its sink into the floor that carries it, and for each solid near it
// the normal toward the geom. Entries older than one step are ignored.
class Memory {
 public:
  static constexpr int kSlots = 16, kSlotSize = 5, kSize = 2 + kSlots * kSlotSize;

  Memory(const mjModel* m, mjData* d, int geom)
      : data_(d->userdata +
              kSize * static_cast<int>(m->geom_user[m->nuser_geom * geom + kNumberAt])),
        t_s_(d->time),
        since_s_(d->time - 1.5 * m->geom_user[m->nuser_geom * geom + kStepAt]) {}

  std::optional<Vec3> Normal(int solid) const {
    const mjtNum* slot = Find(solid);
    return slot == nullptr ? std::nullopt : std::optional<Vec3>(Vec3(slot + 2));
  }
  // Does nothing if all slots are in use.
  void Keep(int solid, const Vec3& normal_W) {
    mjtNum* slot = Find(solid);
    for (int s = 0; slot == nullptr && s < kSlots; ++s)
      if (!IsInUse(Slot(s))) slot = Slot(s);
    if (slot == nullptr) return;
    slot[0] = solid + 1;
    slot[1] = t_s_;
    std::copy_n(normal_W.data(), 3, slot + 2);
  }
  void Carry(double depth_m) {
    data_[0] = data_[1] == t_s_ ? std::max(data_[0], depth_m) : depth_m;
    data_[1] = t_s_;
  }
  // An edge reaches higher than this above the geom's bottom.
  double LeastEdge_m() const { return kApart_m + (IsFresh(data_[1]) ? 2 * data_[0] : 0); }

 private:
  bool IsFresh(double t_s) const { return t_s > since_s_ && t_s <= t_s_; }
  // A slot: the number of the solid + 1 (0: never used), the time, the normal.
  mjtNum* Slot(int s) const { return data_ + 2 + kSlotSize * s; }
  bool IsInUse(const mjtNum* slot) const { return slot[0] != 0 && IsFresh(slot[1]); }
  // Null if it is not remembered.
  mjtNum* Find(int solid) const {
    for (int s = 0; s < kSlots; ++s)
      if (IsInUse(Slot(s)) && Slot(s)[0] == solid + 1) return Slot(s);
    return nullptr;
  }

  mjtNum* data_;
  double t_s_, since_s_;
};

// A body geom near a solid.
class Meeting {
 public:
  Meeting(const mjModel* m, mjData* d, int g1, int g2, bool body_is_first)
      : m_(m),
        d_(d),
        g1_(g1),
        g2_(g2),
        body_(body_is_first ? g1 : g2),
        solid_(body_is_first ? g2 : g1),
        toward_body_(body_is_first ? -1 : 1),
        original_(g_original[static_cast<std::size_t>(m->geom_type[g1])]
                            [static_cast<std::size_t>(m->geom_type[g2])]) {}

  int body() const { return body_; }
  int solid() const { return solid_; }
  int Collide(mjPreContact* con, double margin_m) const {
    return original_(m_, d_, con, g1_, g2_, margin_m);
  }
  // The same with the body moved.
  int CollideMoved(const Vec3& by_W, mjPreContact* con, double margin_m) const {
    mjtNum* p = d_->geom_xpos + 3 * body_;
    const Vec3 kept(p);
    mju_addTo3(p, by_W.data());
    const int n = Collide(con, margin_m);
    std::copy_n(kept.data(), 3, p);
    return n;
  }
  // From the solid to the body.
  Vec3 Normal(const mjPreContact& c) const { return toward_body_ * Vec3(c.normal); }
  // An upper bound of how far the body must move along the vector to be apart.
  double Depth(const Vec3& along_W) const { return Far(solid_, along_W) + Far(body_, -along_W); }

 private:
  // How far along the vector a geom reaches, in the world.
  double Far(int geom, const Vec3& along_W) const {
    Vec3 along, p_W;
    mju_mulMatTVec3(along.data(), d_->geom_xmat + 9 * geom, along_W.data());
    mju_mulMatVec3(p_W.data(), d_->geom_xmat + 9 * geom, FarthestAlong(m_, geom, along).data());
    return along_W.dot(p_W + Vec3(d_->geom_xpos + 3 * geom));
  }

  const mjModel* m_;
  mjData* d_;
  int g1_, g2_, body_, solid_;
  double toward_body_;
  mjfCollision original_;
};

using Contacts = std::array<mjPreContact, mjMAXCONPAIR>;

const mjPreContact& Nearest(const mjPreContact* con, int n) {
  return *std::min_element(con, con + n,
                           [](const auto& a, const auto& b) { return a.dist < b.dist; });
}

// Whether the body, if moved, would meet a side of the solid.
bool MeetsSide(const Meeting& meeting, const Vec3& by_W, double margin_m) {
  Contacts con;
  const int n = meeting.CollideMoved(by_W, con.data(), margin_m);
  return n > 0 && meeting.Normal(Nearest(con.data(), n)).z() < kMaxSideZ;
}

// Turns contacts of the moved body into contacts of the body where it is, without those that do not
// touch there.
int MoveBack(const Meeting& meeting, const Vec3& by_W, const mjPreContact* moved, int n,
             mjPreContact* con) {
  int kept = 0;
  for (int i = 0; i < n; ++i) {
    const double dist = moved[i].dist - by_W.dot(meeting.Normal(moved[i]));
    if (dist > 0) continue;
    con[kept] = moved[i];
    con[kept].dist = dist;
    mju_addToScl3(con[kept++].pos, by_W.data(), -0.5);
  }
  return kept;
}

// The contacts of a body that overlaps a solid which it met at its side. They stay as MuJoCo has
// them if the body has left that side or the solid has no edge there.
int HoldFromSide(const Meeting& meeting, const Vec3& side_W, Memory& memory, mjPreContact* con,
                 int n) {
  Contacts moved;
  double out_m = meeting.Depth(side_W) + kApart_m;
  // Back in until they are just apart: by the gap between them they cannot meet.
  int n_moved = 0;
  constexpr int kMaxSteps = 4;
  for (int i = 0; i < kMaxSteps; ++i) {
    n_moved = meeting.CollideMoved(out_m * side_W, moved.data(), out_m + kLookAhead_m);
    if (n_moved == 0) return n;
    const double gap_m = Nearest(moved.data(), n_moved).dist;
    if (gap_m < 2 * kApart_m) break;
    out_m -= gap_m - kApart_m;
  }
  const Vec3 out_W = out_m * side_W, raised_W = out_W + memory.LeastEdge_m() * Vec3::UnitZ();
  const Vec3 normal_W = meeting.Normal(Nearest(moved.data(), n_moved));
  if (out_m > kMaxDepth_m || normal_W.z() > kMaxSideZ ||
      !MeetsSide(meeting, raised_W, out_m + kLookAhead_m))
    return n;
  memory.Keep(meeting.solid(), normal_W);
  if (normal_W.dot(meeting.Normal(Nearest(con, n))) > kAlike) return n;
  return MoveBack(meeting, out_W, moved.data(), n_moved, con);
}

// Remembers the side on which the body is, if it is near an edge.
void LookAhead(const Meeting& meeting, Memory& memory) {
  Contacts con;
  const int n = meeting.Collide(con.data(), kLookAhead_m);
  if (n == 0) return;
  const Vec3 normal_W = meeting.Normal(Nearest(con.data(), n));
  if (normal_W.z() < kMaxSideZ &&
      MeetsSide(meeting, memory.LeastEdge_m() * Vec3::UnitZ(), 2 * kLookAhead_m))
    memory.Keep(meeting.solid(), normal_W);
}

int Collide(const mjModel* m, mjData* d, mjPreContact* con, int g1, int g2, mjtNum margin) {
  const bool first = IsMarked(m, g1), second = IsMarked(m, g2);
  const Meeting meeting(m, d, g1, g2, first);
  if (!first && !second) return meeting.Collide(con, margin);
  // Contacts within the gap are no contacts.
  const double gaps_m = (first ? kLookAhead_m : 0) + (second ? kLookAhead_m : 0);
  const int n = meeting.Collide(con, margin < gaps_m ? margin : margin - gaps_m);
  const int solid = meeting.solid();
  if (first == second || m->geom_bodyid[solid] != 0 || (m->geom_contype[solid] & kFloorBit) == 0)
    return n;
  Memory memory(m, d, meeting.body());
  if (n == 0) {
    if (m->geom_type[solid] != mjGEOM_PLANE) LookAhead(meeting, memory);
    return 0;
  }
  if (const auto side_W = memory.Normal(solid))
    return HoldFromSide(meeting, *side_W, memory, con, n);
  const mjPreContact& nearest = Nearest(con, n);
  if (meeting.Normal(nearest).z() > kCarries) memory.Carry(-nearest.dist);
  return n;
}

}  // namespace

void InstallEdgeCollider() {
  static const bool installed = [] {
    for (const int a : {mjGEOM_PLANE, mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_ELLIPSOID,
                        mjGEOM_CYLINDER, mjGEOM_BOX, mjGEOM_MESH})
      for (const int b : {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_ELLIPSOID, mjGEOM_CYLINDER,
                          mjGEOM_BOX, mjGEOM_MESH}) {
        const bool floor_or_solid = a == mjGEOM_PLANE || b == mjGEOM_BOX || b == mjGEOM_MESH;
        if (b < a || !floor_or_solid) continue;
        mjfCollision& entry = mjCOLLISIONFUNC[a][b];
        g_original[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = entry;
        entry = &Collide;
      }
    return true;
  }();
  static_cast<void>(installed);
}

void ReserveEdgeMemory(mjSpec* spec) {
  int num_geoms = 0;
  for (mjsElement* e = mjs_firstElement(spec, mjOBJ_GEOM); e; e = mjs_nextElement(spec, e))
    ++num_geoms;
  spec->nuserdata = std::max(spec->nuserdata, Memory::kSize * num_geoms);
  spec->nuser_geom = std::max(spec->nuser_geom, kUserData);
}

void MarkBodyGeoms(mjModel* model, std::span<const int> geoms) {
  int number = 0;
  for (const int geom : geoms) {
    mjtNum* user = model->geom_user + model->nuser_geom * geom;
    user[kMarkAt] = kMark;
    user[kNumberAt] = number++;
    user[kStepAt] = model->opt.timestep;
    model->geom_gap[geom] = kLookAhead_m;
    mjtNum& bound_m = model->body_margin[model->geom_bodyid[geom]];
    bound_m = std::max(bound_m, model->geom_margin[geom] + kLookAhead_m);
  }
}

void UnmarkBodyGeoms(mjModel* model) {
  for (int g = 0; g < model->ngeom; ++g)
    if (IsMarked(model, g))
      model->geom_user[model->nuser_geom * g + kMarkAt] = model->geom_gap[g] = 0;
}

}  // namespace floorproof
