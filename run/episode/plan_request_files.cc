// SPDX-License-Identifier: Apache-2.0
#include "run/episode/plan_request_files.h"

#include <nlohmann/json.hpp>
#include <string>

#include "base/file_output.h"
#include "env/core/coverage.h"
#include "media/media.h"
#include "run/episode/descriptions.h"
#include "run/episode/records.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

// Grey values, as ROS map_server writes them.
constexpr std::uint8_t kOccupied = 0, kUnknown = 205, kFree = 254;

// The layer as NAME.pgm and NAME.png, the top row first.
template <class T, class Grey>
void WriteLayer(const Grid<T>& layer, const Grey& grey, const std::filesystem::path& folder,
                const std::string& name) {
  Image image{layer.width, layer.height, 1, {}};
  image.data.reserve(layer.cells.size());
  for (int iy = layer.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < layer.width; ++ix) image.data.push_back(grey(layer(ix, iy)));
  WritePng(folder / (name + ".png"), image);
  WriteFileWhole(folder / (name + ".pgm"), "P5\n" + std::to_string(layer.width) + " " +
                                               std::to_string(layer.height) + "\n255\n" +
                                               std::string(image.data.begin(), image.data.end()));
}

std::uint8_t GreyOf(CellState state) {
  if (state == CellState::kFree) return kFree;
  return state == CellState::kOccupied ? kOccupied : kUnknown;
}

}  // namespace

void WritePlanRequest(const PlanRequest& request, std::uint32_t seed,
                      const std::filesystem::path& folder) {
  const HazardMap& map = request.map;
  const RobotSpec& robot = request.robot;
  const SweepArea area = ComputeSweepArea(map, robot, robot.clear, robot.tool, request.start);
  Json goal;
  if (request.goal) goal = {{"x_m", request.goal->x()}, {"y_m", request.goal->y()}};
  Json map_json = {{"pgm", "map.pgm"}, {"png", "map.png"}};
  map_json.update(DescribeFrame(map.frame));
  map_json.update({{"occupied", kOccupied},
                   {"unknown", kUnknown},
                   {"free", kFree},
                   {"unknown_is_wall", map.unknown_is_wall}});
  Json reach_json = {{"pgm", "reach.pgm"}, {"png", "reach.png"}};
  reach_json.update(DescribeFrame(area.frame));
  reach_json.update({{"no", kOccupied}, {"yes", kFree}});
  Json risk_json = {{"csv", "risk.csv"}};
  risk_json.update(DescribeFrame(request.risk->grid.frame));
  const Json json = {{"request", kPlanRequestVersion},
                     {"robot", DescribeRobot(robot)},
                     {"start", DescribePose(request.start)},
                     {"goal", std::move(goal)},
                     {"seed", seed},
                     {"map", std::move(map_json)},
                     {"reach", std::move(reach_json)},
                     {"hazards", DescribeHazards(map, robot.step_m)},
                     {"risk", std::move(risk_json)}};
  WriteLayer(map.occupancy, GreyOf, folder, "map");
  WriteLayer(
      area.reachable, [](std::uint8_t yes) { return yes != 0 ? kFree : kOccupied; }, folder,
      "reach");
  WriteFileWhole(folder / "risk.csv", RiskCsv(*request.risk));
  WriteFileWhole(folder / "request.json", JsonText(json) + "\n");
}

}  // namespace floorproof
