// SPDX-License-Identifier: Apache-2.0
// Models of robots that others make (models/others), as docs/real-robots.md describes them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "env/urdf/urdf_answers.h"

namespace floorproof {

struct RealRobot {
  std::string_view name;     // of its file, without the ending
  std::string_view answers;  // the keys of `floorproof robot NAME.urdf --set ...`, as YAML
  double top_mps = 0;        // what it is driven at against steps: its top speed, at most 1 m/s
  double mass_kg = 0;
  double battery_wh = 0;                // 0: not known
  bool motor_data = false;              // its motors' are published, so its top speed is predicted
  std::string_view stated_as = "step";  // the ladder's hazard that the maker's limit is closest to
  double stated_mm = 0;                 // that limit; 0: not known
  bool stated_unloaded = false;         // it holds without a load; else with and without
  double payload_kg = 0;                // rated
  double deck_x_m = 0, deck_z_m = 0;    // of the deck, in base_link, whose origin is on the floor
};

std::span<const RealRobot> RealRobots();

// `more` answers (YAML) override its own.
UrdfAnswers AnswersOf(const RealRobot& robot, const std::string& more = "");
enum class Load { kNone, kRated };  // a box 0.2 m high on its deck

// Writes the MJCF that `floorproof robot` makes of its URDF with these answers into a folder of the
// running test's own.
std::filesystem::path MjcfFile(const RealRobot& robot, const std::string& more = "",
                               Load load = Load::kNone);
// With none: what is made of the URDF by guesses alone.
std::filesystem::path GuessedMjcfFile(const RealRobot& robot);

}  // namespace floorproof
