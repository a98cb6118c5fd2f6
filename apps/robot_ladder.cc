// SPDX-License-Identifier: Apache-2.0
#include "apps/robot_ladder.h"

#include <floorproof/version.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <nlohmann/json.hpp>

#include "apps/ladder.h"
#include "apps/written_model.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "env/scene/measured_block.h"
#include "report/capability_chart.h"
#include "report/ladder_files.h"
#include "validate/ladder_limits.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

fs::path With(const fs::path& pictures, const char* ending) { return pictures.string() + ending; }

}  // namespace

nlohmann::ordered_json MeasureLimits(const RobotModel& robot, const fs::path& target,
                                     const fs::path& pictures, int jobs, const Globals& globals) {
  const fs::path& file = robot.files.front();
  const std::string model = ModelHash(robot.files, {});
  const std::vector<LadderCell> cells = RobotCells(file.string());
  const fs::path table = With(pictures, kLadderTable), chart = With(pictures, kLadderChart);
  WriteFileWhole(table, LadderCsv({}));
  std::error_code ignored;
  fs::remove(chart, ignored);
  const std::string kept =
      target.string() + (fs::exists(target, ignored) ? " is as it was" : " is not written");
  globals.Say(fmt::format("the ladder: {} limits", cells.size()));
  SayWhenInterrupted("no limit was found; " + kept);
  const HoldInterrupts hold;
  const std::vector<LadderRow> rows = ClimbWithProgress(cells, jobs, globals);
  WriteFileWhole(table, LadderCsv(rows));
  SayWhenInterrupted(fmt::format("{} of {} limits are in {}; {}", rows.size(), cells.size(),
                                 table.string(), kept));
  if (Interrupted()) throw Interruption();
  if (ModelHash(robot.files, {}) != model)
    throw InputError({file.string(), 0}, "", "",
                     "was changed while it was measured: the limits, in " + table.string() +
                         ", are of what it was, and are not written into it");
  WriteLimits(
      file, target,
      MeasuredElements(
          rows, fmt::format("Floorproof {}, MuJoCo {}", FLOORPROOF_VERSION, mj_versionString()),
          model));
  WriteCapabilityChart(rows, file.string(), chart);
  SayLeastLimits(rows, globals);
  globals.Say(fmt::format("{} limits measured: in {}, {} and {}", rows.size(), target.string(),
                          table.string(), chart.string()));
  return LadderJson(rows);
}

}  // namespace floorproof
