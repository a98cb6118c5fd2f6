// SPDX-License-Identifier: Apache-2.0
#include "env/scene/feet.h"

#include <algorithm>
#include <cmath>

#include "env/scene/compiled_robot.h"
#include "env/scene/free_names.h"
#include "env/scene/loads.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

constexpr Bounds kStiffness_npmm = {1, 100'000, false};
constexpr Bounds kDampingRatio = {0.01, 5, false};

TyreMaterial ReadMaterial(const CompiledRobot& compiled, const char* key, TyreMaterial usual) {
  const auto text = compiled.OptionalText(key);
  if (!text) return usual;
  for (const TyreMaterial material :
       {TyreMaterial::kSoftRubber, TyreMaterial::kHardRubber, TyreMaterial::kPolyurethane})
    if (*text == Name(material)) return material;
  throw InputError({compiled.file(), 0}, key, *text,
                   "must be soft_rubber, hard_rubber or polyurethane");
}

TyreSpec ReadTyre(const CompiledRobot& compiled, const std::string& key, TyreMaterial usual) {
  TyreSpec spec{.material = ReadMaterial(compiled, key.c_str(), usual)};
  if (const auto npmm = compiled.OptionalNumber((key + "_stiffness_npmm").c_str(), kStiffness_npmm))
    spec.stiffness_npm = 1000 * *npmm;
  spec.damping_ratio = compiled.OptionalNumber((key + "_damping_ratio").c_str(), kDampingRatio);
  return spec;
}

// A pad or a mesh counts as a ball that fits into it.
Tread TreadOf(const mjModel* m, int geom) {
  const mjtNum* size = m->geom_size + 3 * geom;
  switch (m->geom_type[geom]) {
    case mjGEOM_CYLINDER:
      return {size[0] + RollersOf(m, geom).radius_m, 2 * size[1]};
    case mjGEOM_CAPSULE:
      return {size[0], 2 * size[1]};
    case mjGEOM_SPHERE:
      return {size[0], 0};
    default: {
      const mjtNum* half = m->geom_aabb + 6 * geom + 3;
      return {std::min({half[0], half[1], half[2]}), 0};
    }
  }
}

double RollsOn(const mjModel* m, int geom) {
  const int type = m->geom_type[geom];
  const bool round = type == mjGEOM_CYLINDER || type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE;
  if (!round || RollingJoint(m, m->geom_bodyid[geom]) < 0) return 0;
  return m->geom_size[3 * geom] + RollersOf(m, geom).radius_m;
}

}  // namespace

std::vector<Foot> FeetOf(mjSpec* mjcf, const mjModel* m, const RobotSpec& robot) {
  // A foot that carries little at rest carries more as the robot leans.
  constexpr double kLeastShare = 0.1;  // of the mean load
  const CompiledRobot compiled(m, robot.model_file);
  const TyreSpec tyre = ReadTyre(compiled, "tyre", kUsualTyre),
                 caster = ReadTyre(compiled, "caster", kUsualCaster);
  const double mass_kg = m->body_subtreemass[compiled.base()];
  const std::vector<LoadedGeom> carriers = LoadsOf(m, robot);
  double mean_n = 0;
  for (const LoadedGeom& carrier : carriers)
    mean_n += carrier.load_n / static_cast<double>(carriers.size());
  const FreeNames names(mjcf, mjOBJ_GEOM);
  std::vector<Foot> feet;
  for (mjsElement* e = mjs_firstElement(mjcf, mjOBJ_GEOM); e; e = mjs_nextElement(mjcf, e)) {
    const int g = mjs_getId(e);
    const auto carrier = std::ranges::find(carriers, g, &LoadedGeom::geom);
    if (carrier == carriers.end()) continue;
    if (mjs_getString(mjs_getName(e))[0] == '\0')
      mjs_setName(e, names.For("foot/" + std::to_string(feet.size())).c_str());
    const int body = m->geom_bodyid[g];
    const Tread tread = TreadOf(m, g);
    Foot foot{.geom = mjs_getString(mjs_getName(e)),
              .driven = IsDriven(m, body),
              .rolls_m = RollsOn(m, g),
              .scrubs_m = RollersOf(m, g).radius_m > 0 ? 0 : tread.width_m / 4,
              .load_n = carrier->load_n,
              .inverse_mass_pkg = m->body_invweight0[2 * body]};
    foot.tyre = TyreUnder(std::max(foot.load_n, kLeastShare * mean_n), tread,
                          foot.driven ? tyre : caster, mass_kg);
    feet.push_back(std::move(foot));
  }
  return feet;
}

double FastestPhase(const std::vector<Foot>& feet, double time_s) {
  double fastest_radps = 0;
  for (const Foot& foot : feet)
    fastest_radps =
        std::max(fastest_radps, std::sqrt(foot.tyre.stiffness_npm * foot.inverse_mass_pkg));
  return fastest_radps * time_s;
}

}  // namespace floorproof
