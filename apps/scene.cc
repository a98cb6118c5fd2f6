// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/command.h"
#include "env/core/interrupt.h"
#include "env/run/file_output.h"
#include "env/scene/roller_wheels.h"

namespace floorproof {

void AddScene(CLI::App& app, const Globals& globals, int&) {
  struct Options {
    std::string scenario, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("scene",
                                         "Write the scene, robot included, as MJCF that the stock "
                                         "MuJoCo loads and steps (Mecanum wheels "
                                         "with rollers that are bodies)");
  command->add_option("SCENARIO", options->scenario, "Scenario file (YAML)")->required();
  command->add_option("--out", options->out, "MJCF file to write")->required();
  command->callback([options, &globals] {
    const Scenario s = ReadScenario(options->scenario, globals.Overrides());
    SayWarnings(s, globals);
    // The stock MuJoCo lacks the collider of ideal Mecanum wheels.
    const Scene scene =
        BuildScene(s.site.map, WithRollerWheels(s.robot), s.physics, s.start, WallSet::kAll);
    WriteFileWhole(options->out, SceneXml(scene));
    SayWhenInterrupted(options->out + " is written");
    globals.Say(fmt::format("{}: {} wall, {} floor and {} hazard geoms", options->out,
                            scene.num_wall_geoms, scene.num_floor_geoms, scene.num_hazard_geoms));
    globals.Result({{"file", options->out},
                    {"wall_geoms", scene.num_wall_geoms},
                    {"floor_geoms", scene.num_floor_geoms},
                    {"hazard_geoms", scene.num_hazard_geoms}});
  });
}

}  // namespace floorproof
