// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "env/scene/measured_block.h"
#include "env/scene/spec_parts.h"

namespace floorproof {
namespace {

// What a number of this unit is of the unit inside; 0: no unit.
double UnitOf(std::string_view unit) {
  if (unit == "mm") return 1e-3;
  if (unit == "deg") return kPi / 180;
  if (unit == "pct") return 1e-2;
  return 0;
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
    if (!(values[i] > 0) || (i > 0 && values[i] <= values[i - 1]))
      compiled.Refuse(name, "must be above 0, and each more than the one before");
  return values;
}

// Of one friction: the numbers that begin here, one a speed. What is larger than what was tried is
// not known to be crossed.
double Least(const double* of, std::size_t speeds, double unit) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < speeds; ++s) least = std::min(least, std::abs(of[s]) * unit);
  return least;
}

}  // namespace

void ReadMeasuredLimits(const CompiledRobot& compiled, RobotSpec& robot) {
  const mjModel* m = compiled.model();
  if (mj_name2id(m, mjOBJ_TEXT, kMeasuredBy) < 0) return;
  MeasuredLimits& measured = robot.measured;
  measured.by = compiled.Text(kMeasuredBy);
  measured.model = compiled.Text(kMeasuredModel);
  measured.frictions = Conditions(compiled, kMeasuredFrictions);
  const std::size_t speeds = Conditions(compiled, kMeasuredSpeeds).size();
  for (int id = 0; id < m->nnumeric; ++id) {
    const std::string name = mj_id2name(m, mjOBJ_NUMERIC, id);
    if (!name.starts_with(kMeasuredPrefix) || name == kMeasuredFrictions || name == kMeasuredSpeeds)
      continue;
    // measured_KIND_DIRECTION_UNIT
    const std::size_t unit_at = name.rfind('_');
    const std::size_t direction_at = name.rfind('_', unit_at - 1);
    const double unit = UnitOf(std::string_view(name).substr(unit_at + 1));
    if (unit == 0 || direction_at + 1 <= kMeasuredPrefix.size())
      compiled.Refuse(name, "must be measured_KIND_DIRECTION_UNIT, UNIT mm, deg or pct");
    const std::string kind =
        name.substr(kMeasuredPrefix.size(), direction_at - kMeasuredPrefix.size());
    const std::vector<double> values = Numbers(compiled, id);
    if (values.size() != speeds * measured.frictions.size())
      compiled.Refuse(name, "must have one number a friction and speed, " +
                                std::to_string(speeds * measured.frictions.size()));
    for (const double value : values)
      if (!std::isfinite(value)) compiled.Refuse(name, "must be numbers");
    auto limit = std::ranges::find(measured.limits, kind, &MeasuredLimit::kind);
    if (limit == measured.limits.end())
      limit = measured.limits.insert(
          limit, {kind, std::vector<double>(measured.frictions.size(),
                                            std::numeric_limits<double>::infinity())});
    for (std::size_t f = 0; f < measured.frictions.size(); ++f)
      limit->most[f] = std::min(limit->most[f], Least(values.data() + f * speeds, speeds, unit));
  }
}

}  // namespace floorproof
