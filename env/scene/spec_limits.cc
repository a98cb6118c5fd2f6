// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "env/scene/measured_names.h"
#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

bool IsMeasured(const char* name) {
  return name != nullptr && std::string_view(name).starts_with(kMeasuredPrefix);
}

std::vector<double> Numbers(const CompiledRobot& compiled, int id) {
  const mjModel* m = compiled.model();
  const mjtNum* first = m->numeric_data + m->numeric_adr[id];
  return {first, first + m->numeric_size[id]};
}

std::vector<double> Conditions(const CompiledRobot& compiled, const char* name) {
  const int id = mj_name2id(compiled.model(), mjOBJ_NUMERIC, name);
  if (id < 0) compiled.Refuse(name, "missing under <custom>, beside measured limits");
  std::vector<double> values = Numbers(compiled, id);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0 && std::isfinite(values[i])) || (i > 0 && values[i] <= values[i - 1]))
      throw InputError({compiled.file(), 0}, name, FormatDouble(values[i]),
                       "must be above 0, and each more than the one before");
  return values;
}

// The kind of the limit `name`, measured_KIND_DIRECTION_UNIT.
const MeasuredKind& KindOf(const CompiledRobot& compiled, const std::string& name) {
  const auto refuse = [&](const std::string& what, const std::string& rule) {
    throw InputError({compiled.file(), 0}, name, what, rule);
  };
  const auto known = [](const auto& names) {
    std::vector<std::string> all;
    for (const auto& each : names) all.emplace_back(each);
    return all;
  };
  const std::size_t unit_at = name.rfind('_');
  const std::size_t direction_at = name.rfind('_', unit_at - 1);
  if (direction_at == name.npos || direction_at <= kMeasuredPrefix.size())
    compiled.Refuse(name, "must be measured_KIND_DIRECTION_UNIT");
  const std::string kind =
                        name.substr(kMeasuredPrefix.size(), direction_at - kMeasuredPrefix.size()),
                    direction = name.substr(direction_at + 1, unit_at - direction_at - 1),
                    unit = name.substr(unit_at + 1);
  const auto found = std::ranges::find(MeasuredKinds(), kind, &MeasuredKind::name);
  if (found == MeasuredKinds().end()) {
    std::vector<std::string_view> kinds;
    for (const MeasuredKind& each : MeasuredKinds()) kinds.push_back(each.name);
    refuse(kind, "unknown kind of hazard" + DidYouMeanOneOf(kind, known(kinds)));
  }
  if (std::ranges::find(MeasuredDirections(), direction) == MeasuredDirections().end())
    refuse(direction,
           "unknown direction" + DidYouMeanOneOf(direction, known(MeasuredDirections())));
  if (unit != found->unit.name)
    refuse(unit, "must be " + std::string(found->unit.name) + ", the unit of " + kind);
  return *found;
}

// Of one friction: the numbers that begin here, one a speed. What is larger than what was tried is
// not known to be crossed.
double Least(const double* of, std::size_t speeds, double unit) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < speeds; ++s) least = std::min(least, std::abs(of[s]) * unit);
  return least;
}

void ReadLimit(const CompiledRobot& compiled, int id, std::size_t speeds,
               MeasuredLimits& measured) {
  const std::string name = mj_id2name(compiled.model(), mjOBJ_NUMERIC, id);
  const MeasuredKind& kind = KindOf(compiled, name);
  const std::vector<double> values = Numbers(compiled, id);
  if (values.size() != speeds * measured.frictions.size())
    compiled.Refuse(name, "must have one number a friction and speed, " +
                              std::to_string(speeds * measured.frictions.size()));
  const Bounds rule = Between(-kind.unit.most, kind.unit.most);
  for (const double value : values)
    if (!rule.Allows(value))
      throw InputError({compiled.file(), 0}, name, FormatDouble(value), rule.Text());
  auto limit = std::ranges::find(measured.limits, kind.name, &MeasuredLimit::kind);
  if (limit == measured.limits.end())
    limit = measured.limits.insert(
        limit,
        {std::string(kind.name),
         std::vector<double>(measured.frictions.size(), std::numeric_limits<double>::infinity())});
  for (std::size_t f = 0; f < measured.frictions.size(); ++f)
    limit->most[f] =
        std::min(limit->most[f], Least(values.data() + f * speeds, speeds, kind.unit.si));
}

// What the model says under names of what was measured.
std::map<std::string, std::string> Said(const CompiledRobot& compiled) {
  const mjModel* m = compiled.model();
  std::map<std::string, std::string> said;
  for (int id = 0; id < m->ntext; ++id)
    if (const char* name = mj_id2name(m, mjOBJ_TEXT, id); IsMeasured(name))
      said[name] = m->text_data + m->text_adr[id];
  for (int id = 0; id < m->nnumeric; ++id)
    if (const char* name = mj_id2name(m, mjOBJ_NUMERIC, id); IsMeasured(name))
      said[name] = FiguresText(Numbers(compiled, id));
  return said;
}

void RefuseUnknownTexts(const CompiledRobot& compiled) {
  const std::vector<std::string> known = {kMeasuredBy, kMeasuredModel, kMeasuredFigures,
                                          kMeasuredHow};
  const mjModel* m = compiled.model();
  for (int id = 0; id < m->ntext; ++id)
    if (const char* name = mj_id2name(m, mjOBJ_TEXT, id);
        IsMeasured(name) && std::ranges::find(known, name) == known.end())
      compiled.Refuse(name, "unknown text of what was measured" + DidYouMeanOneOf(name, known));
}

void ReadBlock(const CompiledRobot& compiled, MeasuredLimits& measured) {
  const mjModel* m = compiled.model();
  const auto said = Said(compiled);
  if (said.empty()) return;
  if (mj_name2id(m, mjOBJ_TEXT, kMeasuredBy) < 0)
    compiled.Refuse(kMeasuredBy, "missing under <custom>, beside " + said.begin()->first);
  RefuseUnknownTexts(compiled);
  measured.by = compiled.Text(kMeasuredBy);
  measured.model = compiled.Text(kMeasuredModel);
  measured.frictions = Conditions(compiled, kMeasuredFrictions);
  const std::size_t speeds = Conditions(compiled, kMeasuredSpeeds).size();
  for (int id = 0; id < m->nnumeric; ++id)
    if (const char* name = mj_id2name(m, mjOBJ_NUMERIC, id);
        IsMeasured(name) && name != std::string_view(kMeasuredFrictions) &&
        name != std::string_view(kMeasuredSpeeds))
      ReadLimit(compiled, id, speeds, measured);
  measured.hashed = said.contains(kMeasuredFigures);
  if (measured.hashed && compiled.Text(kMeasuredFigures) != FiguresHash(said))
    DropLimits(measured, "they were edited since");
}

}  // namespace

void ReadMeasuredLimits(const CompiledRobot& compiled, RobotSpec& robot) {
  try {
    ReadBlock(compiled, robot.measured);
  } catch (const InputError& e) {
    throw InputError(e.what() + std::string("; or take out all that begins with measured_: "
                                            "`floorproof robot FILE --ladder` writes it anew"));
  }
}

}  // namespace floorproof
