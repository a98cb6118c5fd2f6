// SPDX-License-Identifier: Apache-2.0
#include "env/scene/model_numbers.h"

#include <mujoco/mjxmacro.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <type_traits>

#include "base/error.h"
#include "base/params.h"
#include "env/scene/part_name.h"

namespace floorproof {
namespace {

constexpr Bounds kNotNegative{0, mjMAXVAL, false}, kEither{-mjMAXVAL, mjMAXVAL, false};

// What the numbers of an array of the model must be, and the attribute that states them.
struct ArrayRule {
  std::string_view array;
  Bounds bounds;
  std::string_view attribute;
};
constexpr ArrayRule kRules[] = {
    {"body_pos", kEither, "pos"},
    {"body_ipos", kEither, "pos"},
    {"body_mass", kNotNegative, "mass"},
    {"body_inertia", kNotNegative, "inertia"},
    {"body_gravcomp", kEither, "gravcomp"},
    {"jnt_pos", kEither, "pos"},
    {"jnt_stiffness", kNotNegative, "stiffness"},
    {"jnt_stiffnesspoly", kEither, "stiffness"},
    {"jnt_range", kEither, "range"},
    {"jnt_actfrcrange", kEither, "actuatorfrcrange"},
    {"jnt_margin", kNotNegative, "margin"},
    {"dof_frictionloss", kNotNegative, "frictionloss"},
    {"dof_armature", kNotNegative, "armature"},
    {"dof_damping", kNotNegative, "damping"},
    {"dof_dampingpoly", kEither, "damping"},
    {"geom_pos", kEither, "pos"},
    {"geom_solmix", kNotNegative, "solmix"},
    {"geom_size", kNotNegative, "size"},
    {"geom_friction", kNotNegative, "friction"},
    {"geom_margin", kNotNegative, "margin"},
    {"geom_gap", kEither, "gap"},
    {"geom_surfacevel", kEither, "surfacevel"},
    {"geom_adhesion", kEither, "adhesion"},
    {"geom_fluid", kEither, "fluidcoef"},
    {"site_pos", kEither, "pos"},
    {"site_size", kNotNegative, "size"},
    {"pair_margin", kNotNegative, "margin"},
    {"pair_gap", kEither, "gap"},
    {"pair_friction", kNotNegative, "friction"},
    {"eq_data", kEither, "data"},
    {"tendon_range", kEither, "range"},
    {"tendon_margin", kNotNegative, "margin"},
    {"tendon_stiffness", kNotNegative, "stiffness"},
    {"tendon_damping", kNotNegative, "damping"},
    {"tendon_armature", kNotNegative, "armature"},
    {"tendon_frictionloss", kNotNegative, "frictionloss"},
    {"actuator_dynprm", kEither, "dynprm"},
    {"actuator_gainprm", kEither, "gainprm"},
    {"actuator_biasprm", kEither, "biasprm"},
    {"actuator_damping", kNotNegative, "damping"},
    {"actuator_armature", kNotNegative, "armature"},
    {"actuator_forcerange", kEither, "forcerange"},
    {"actuator_ctrlrange", kEither, "ctrlrange"},
    {"actuator_gear", kEither, "gear"},
};

// Solver parameters of contacts, limits and friction, by the begin of the arrays' names.
struct SolverArray {
  std::string_view array, solref, solimp;
};
constexpr SolverArray kSolver[] = {
    {"jnt_sol", "solreflimit", "solimplimit"},
    {"dof_sol", "solreffriction", "solimpfriction"},
    {"geom_sol", "solref", "solimp"},
    {"pair_sol", "solref", "solimp"},
    {"eq_sol", "solref", "solimp"},
    {"tendon_sol", "solreflimit", "solimplimit"},
};

class Check {
 public:
  Check(const mjModel* model, mjSpec* spec, const std::string& file)
      : m_(model), spec_(spec), file_(file) {}

  void StatedMasses() const {
    for (mjsElement* e = mjs_firstElement(spec_, mjOBJ_GEOM); e; e = mjs_nextElement(spec_, e)) {
      const mjsGeom* geom = mjs_asGeom(e);
      const auto part = [&] { return PartOf(mjOBJ_GEOM, "geom", mjs_getId(e)); };
      if (!std::isnan(geom->mass)) Require(part, "mass", geom->mass, kNotNegative);  // stated
      Require(part, "density", geom->density, kNotNegative);
    }
  }

  void Options() const {
    const auto part = [] { return Part{"option", "", 0}; };
    Require(part, "timestep", m_->opt.timestep, {0, 1, true});
    Require(part, "impratio", m_->opt.impratio, {0, mjMAXVAL, true});
    Require(part, "density", m_->opt.density, kNotNegative);
    Require(part, "viscosity", m_->opt.viscosity, kNotNegative);
    for (const mjtNum g : m_->opt.gravity) Require(part, "gravity", g, kEither);
  }

  // Of joints with one coordinate; the others' come of their bodies' places.
  void Springs() const {
    for (int j = 0; j < m_->njnt; ++j) {
      if (m_->jnt_type[j] != mjJNT_SLIDE && m_->jnt_type[j] != mjJNT_HINGE) continue;
      const auto part = [&] { return PartOf(mjOBJ_JOINT, "joint", j); };
      Require(part, "ref", m_->qpos0[m_->jnt_qposadr[j]], kEither);
      Require(part, "springref", m_->qpos_spring[m_->jnt_qposadr[j]], kEither);
    }
  }

  // A motor that turns nothing.
  void Gears() const {
    for (int a = 0; a < m_->nactuator; ++a)
      if (m_->actuator_trntype[a] == mjTRN_JOINT &&
          m_->actuator_gear[6 * m_->actuator_outadr[a]] == 0)
        Refuse(PartOf(mjOBJ_ACTUATOR, "actuator", a), "gear", 0, "must not be 0");
  }

  void Ranges() const {
    ForEachArray([&](std::string_view array, std::string_view rows, mjtSize count, int columns,
                     const auto* data) {
      const auto rule = std::ranges::find(kRules, array, &ArrayRule::array);
      const auto solver = std::ranges::find_if(
          kSolver, [&](const SolverArray& s) { return array.starts_with(s.array); });
      for (mjtSize row = 0; row < count; ++row, data += columns) {
        const auto part = [&] { return PartOf(array, rows, static_cast<int>(row)); };
        if (rule != std::end(kRules))
          for (int c = 0; c < columns; ++c)
            Require(part, rule->attribute, static_cast<double>(data[c]), rule->bounds);
        else if (solver != std::end(kSolver) && array.find("solref") != array.npos)
          Solref(part, solver->solref, data);
        else if (solver != std::end(kSolver) && array.find("solimp") != array.npos)
          Solimp(part, solver->solimp, data);
      }
    });
  }

  // Whatever else the compiler made of the file's numbers.
  void Finite() const {
    ForEachArray([&](std::string_view array, std::string_view rows, mjtSize count, int columns,
                     const auto* data) {
      for (mjtSize i = 0; i < count * columns; ++i)
        if (!std::isfinite(data[i]))
          Refuse(PartOf(array, rows, static_cast<int>(i / columns)),
                 array.substr(array.find('_') + 1), static_cast<double>(data[i]),
                 "must be a finite number");
    });
  }

 private:
  struct Part {
    std::string element, name;
    int line = 0;
  };

  [[noreturn]] void Refuse(const Part& part, std::string_view attribute, double value,
                           std::string_view rule) const {
    throw InputError({file_, part.line}, PartName(part.element, part.name, attribute),
                     FormatDouble(value), rule);
  }
  // `part()`: whose number it is, asked for where it is refused.
  void Require(const auto& part, std::string_view attribute, double value,
               const Bounds& bounds) const {
    if (!bounds.Allows(value))
      Refuse(part(), attribute, value,
             std::isfinite(value) ? bounds.Text() : "must be a finite number");
  }

  // Time constant and damping ratio, both above 0, or minus stiffness and minus damping.
  void Solref(const auto& part, std::string_view attribute, const auto* of) const {
    for (int c = 0; c < mjNREF; ++c) Require(part, attribute, static_cast<double>(of[c]), kEither);
    if ((of[0] > 0) != (of[1] > 0))
      Refuse(part(), attribute, static_cast<double>(of[1]),
             "must be above 0 where the number before it is, and else not");
  }

  // Impedances at contact and at full depth, that depth, midpoint and power.
  void Solimp(const auto& part, std::string_view attribute, const auto* of) const {
    constexpr Bounds kShare{0, 1, false};
    constexpr Bounds kEach[mjNIMP] = {kShare, kShare, kNotNegative, kShare, {1, mjMAXVAL, false}};
    for (int c = 0; c < mjNIMP; ++c) Require(part, attribute, static_cast<double>(of[c]), kEach[c]);
  }

  template <class Visit>
  void ForEachArray(const Visit& visit) const {
    const mjModel* m = m_;
    const auto numbers = [&](std::string_view array, std::string_view rows, const auto* data,
                             mjtSize count, auto columns) {
      if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(*data)>>)
        visit(array, rows, count, static_cast<int>(columns), data);
    };
#undef MJ_M
#define MJ_M(n) m->n
#define X(type, name, nr, nc) numbers(#name, #nr, m->name, m->nr, nc);
    MJMODEL_POINTERS
#undef X
#undef MJ_M
#define MJ_M(n) n
  }

  // The part that a row of an array is of.
  Part PartOf(std::string_view array, std::string_view rows, int row) const {
    struct Rows {
      std::string_view name;
      mjtObj type;
      const char* element;
    };
    static constexpr Rows kRows[] = {
        {"nbody", mjOBJ_BODY, "body"},
        {"njnt", mjOBJ_JOINT, "joint"},
        {"ngeom", mjOBJ_GEOM, "geom"},
        {"nsite", mjOBJ_SITE, "site"},
        {"ncam", mjOBJ_CAMERA, "camera"},
        {"nlight", mjOBJ_LIGHT, "light"},
        {"nmesh", mjOBJ_MESH, "mesh"},
        {"nhfield", mjOBJ_HFIELD, "hfield"},
        {"nmat", mjOBJ_MATERIAL, "material"},
        {"npair", mjOBJ_PAIR, "pair"},
        {"neq", mjOBJ_EQUALITY, "equality"},
        {"ntendon", mjOBJ_TENDON, "tendon"},
        {"nactuator", mjOBJ_ACTUATOR, "actuator"},
        {"nsensor", mjOBJ_SENSOR, "sensor"},
        {"nkey", mjOBJ_KEY, "key"},
    };
    for (const Rows& known : kRows)
      if (known.name == rows) return PartOf(known.type, known.element, row);
    if (rows == "nv") return PartOf(mjOBJ_JOINT, "joint", m_->dof_jntid[row]);
    if (rows == "nq")
      return PartOf(mjOBJ_JOINT, "joint", LastAtMost(m_->jnt_qposadr, m_->njnt, row));
    if (rows == "nu")
      return PartOf(mjOBJ_ACTUATOR, "actuator",
                    LastAtMost(m_->actuator_ctrladr, m_->nactuator, row));
    if (rows == "nout")
      return PartOf(mjOBJ_ACTUATOR, "actuator",
                    LastAtMost(m_->actuator_outadr, m_->nactuator, row));
    if (rows == "nnumericdata")
      return PartOf(mjOBJ_NUMERIC, "numeric", LastAtMost(m_->numeric_adr, m_->nnumeric, row));
    return {std::string(array.substr(0, array.find('_'))), "", 0};
  }

  static int LastAtMost(const int* addresses, mjtSize count, int at) {
    return static_cast<int>(std::upper_bound(addresses, addresses + count, at) - addresses) - 1;
  }

  Part PartOf(mjtObj type, const char* element, int id) const {
    const char* name = mj_id2name(m_, type, id);
    return {element, name != nullptr ? name : "", LineOf(type, id)};
  }

  // The element's line in the file; 0: unknown, or in an included file.
  int LineOf(mjtObj type, int id) const {
    for (mjsElement* e = mjs_firstElement(spec_, type); e; e = mjs_nextElement(spec_, e)) {
      if (mjs_getId(e) != id) continue;
      const mjString* info = Info(e, type);
      int line = 0;
      return info != nullptr && std::sscanf(mjs_getString(info), "line %d", &line) == 1 ? line : 0;
    }
    return 0;
  }
  static const mjString* Info(mjsElement* e, mjtObj type) {
    switch (type) {
      case mjOBJ_BODY:
        return mjs_asBody(e)->info;
      case mjOBJ_JOINT:
        return mjs_asJoint(e)->info;
      case mjOBJ_GEOM:
        return mjs_asGeom(e)->info;
      case mjOBJ_SITE:
        return mjs_asSite(e)->info;
      case mjOBJ_PAIR:
        return mjs_asPair(e)->info;
      case mjOBJ_EQUALITY:
        return mjs_asEquality(e)->info;
      case mjOBJ_TENDON:
        return mjs_asTendon(e)->info;
      case mjOBJ_ACTUATOR:
        return mjs_asActuator(e)->info;
      case mjOBJ_NUMERIC:
        return mjs_asNumeric(e)->info;
      default:
        return nullptr;
    }
  }

  const mjModel* m_;
  mjSpec* spec_;
  const std::string& file_;
};

}  // namespace

void RefuseWrongNumbers(const mjModel* model, mjSpec* spec, const std::string& file) {
  const Check check(model, spec, file);
  check.Options();
  check.StatedMasses();
  check.Ranges();
  check.Springs();
  check.Gears();
  check.Finite();
}

}  // namespace floorproof
