// SPDX-License-Identifier: Apache-2.0
#include "report/ladder_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "report/capability_chart.h"

namespace floorproof {

namespace fs = std::filesystem;

bool IsLadderFile(std::string_view name) {
  return name == "ladder.csv" || name == "ladder_oblique.csv" || name == "ladder_sweep.csv" ||
         (name.ends_with(".png") &&
          (name.starts_with("capability_") || name.starts_with("sweep_")));
}

void ClearLadder(const fs::path& folder) {
  WriteFileWhole(folder / "ladder.csv", LadderCsv({}));
  WriteFileWhole(folder / "ladder_oblique.csv", ObliqueCsv({}));
  WriteFileWhole(folder / "ladder_sweep.csv", SweepCsv({}));
  std::error_code ignored;
  for (const RobotEntry& robot : Robots())
    for (const char* name : {"capability", "sweep"})
      fs::remove(folder / fmt::format("{}_{}.png", name, robot.name), ignored);
}

void WriteLadderCharts(std::span<const LadderRow> rows, std::span<const LadderRow> sweep,
                       const fs::path& folder) {
  for (const RobotEntry& robot : Robots()) {
    WriteCapabilityChart(rows, std::string(robot.name),
                         folder / fmt::format("capability_{}.png", robot.name));
    WriteSweepChart(sweep, std::string(robot.name), folder);
  }
}

nlohmann::ordered_json LadderJson(std::span<const LadderRow> rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    nlohmann::ordered_json object = {{"robot", RobotName(cell)},
                                     {"wheels", cell.wheels},
                                     {"hazard", cell.hazard},
                                     {"direction", Name(cell.direction)},
                                     {"speed_mps", cell.speed_mps},
                                     {"friction", cell.friction},
                                     {"limit", row.limit},
                                     {"unit", FindLadderHazard(cell.hazard).unit},
                                     {"oblique_deg", cell.oblique_deg},
                                     {"run_up_m", cell.run_up_m},
                                     {"at_least", row.above_all},
                                     {"held_by", row.held_by}};
    if (cell.changes.clearance_m) object["clearance_m"] = *cell.changes.clearance_m;
    if (cell.changes.mass_kg) object["mass_kg"] = *cell.changes.mass_kg;
    json.push_back(std::move(object));
  }
  return json;
}

}  // namespace floorproof
