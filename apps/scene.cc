// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/command.h"
#include "base/file_output.h"
#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/result_folder.h"
#include "env/scene/roller_wheels.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {

namespace {

constexpr std::string_view kMark = "<!-- Written by floorproof scene, which may replace it. -->\n";

// What is no file, writing to it says.
void RefuseToReplaceOthers(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 40;
  std::error_code ignored;
  using Type = std::filesystem::file_type;
  const bool is_link = std::filesystem::is_symlink(file, ignored);
  const Type there = std::filesystem::status(file, ignored).type();
  if (is_link ? there == Type::regular || there == Type::not_found
              : there == Type::regular && ReadStartOfFile(file, kMark.size(), kMostBytes) != kMark)
    throw InputError({file.string(), 0}, "", "",
                     "is not a file that `scene` wrote, and is not replaced; --out names another");
}

}  // namespace

void AddScene(CommandLine& line, const Globals& globals, int&) {
  struct Options {
    std::string scenario, out;
  };
  auto options = std::make_shared<Options>();
  Subcommand command = line.Add("scene",
                                "Write the scene, robot included, as MJCF that the stock "
                                "MuJoCo loads and steps (Mecanum wheels "
                                "with rollers that are bodies)");
  command.Text("SCENARIO", options->scenario, "Scenario file (YAML)", Subcommand::Need::kRequired);
  command.Text(
      "--out", options->out,
      "MJCF file to write, anywhere, the scenario's folder included; replaces only a file that "
      "`scene` wrote",
      Subcommand::Need::kRequired);
  command.OnRun([options, &globals] {
    const Scenario s = ReadScenario(options->scenario, globals.Overrides(), globals.trust());
    for (const std::string& warning : Warnings(s)) globals.Say(warning);
    RefuseToReplace(InputsOf(s), options->out);
    RefuseToReplaceOthers(options->out);
    // The stock MuJoCo lacks the collider of ideal Mecanum wheels.
    const Scene scene = BuildScene(s.world.site.map, WithRollerWheels(s.world.robot),
                                   s.world.physics, s.world.start, WallSet::kAll);
    WriteFileWhole(options->out, std::string(kMark) + SceneXml(scene));
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
