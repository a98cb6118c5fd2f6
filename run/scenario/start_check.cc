// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/start_check.h"

#include <algorithm>

#include "controllers/estimator.h"
#include "run/scenario/agents.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"
#include "run/scenario/scenario_parts.h"

namespace floorproof {
namespace {

// Where the last part of this path is written that is; the file's own mark where none is.
SourceMark MarkOfPath(const ConfigNode& root, std::string_view path) {
  const ConfigNode* node = &root;
  while (!path.empty()) {
    const std::size_t dot = path.find('.');
    const ConfigNode* below = node->Find(path.substr(0, dot));
    if (below == nullptr) break;
    node = below;
    path = dot == std::string_view::npos ? "" : path.substr(dot + 1);
  }
  return node->mark;
}

// Plug-ins know the key, not where it is written: their lines begin with it, or with the robot's
// file.
template <class Start>
void Check(const ConfigNode& root, Start start) {
  try {
    start();
  } catch (const InputError& e) {
    const std::string_view line = e.what();
    const std::string_view path = line.substr(0, line.find_first_of(" :"));
    const auto& keys = ScenarioKeys();
    if (std::ranges::find(keys, path.substr(0, path.find('.'))) == keys.end()) throw;
    throw InputError(MarkOfPath(root, path), "", "", line);
  }
}

}  // namespace

void CheckStarts(const ConfigNode& root, const Scenario& s) {
  const HazardMap known = KnownFloor(s.world);
  Check(root, [&] {
    MakePlugin(Estimators(), s.spec.estimator, "estimator")
        ->Start({known, s.world.robot.spec, s.world.start, Stream(0, 0, "estimator")});
  });
  if (std::ranges::all_of(s.spec.sensors, &SensorSpec::implied)) return;
  HazardMap bare;
  bare.frame = {1, 1, 1, {}};
  bare.occupancy = Grid<CellState>(1, 1);
  const Scene scene = BuildScene(bare, s.world.robot, s.world.physics, {});
  const DataPtr data = MakeData(scene.model.get());
  ForwardEngine(scene.model.get(), data.get());
  Observation sensed;
  const std::vector<double> motor_nm(static_cast<std::size_t>(scene.model->nu));
  for (const auto& [name, sensor, implied] : MakeSensors(s.spec))
    Check(root, [&, &name = name, &sensor = sensor] {
      sensor->Start({scene, bare, s.world.robot.spec, 1.0 / s.spec.episode.control_hz, motor_nm},
                    data.get(), {}, Stream(0, 0, name), sensed);
    });
}

}  // namespace floorproof
