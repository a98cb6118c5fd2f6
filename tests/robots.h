// SPDX-License-Identifier: Apache-2.0
// Every robot of models/list.inc, for tests of what must hold on all of them.
//
// The parameters of such tests are made each time that one of them starts, a thousand times in a
// run of all, and to read hTetro takes 40 ms. So they are made of names, and what tells robots
// apart is looked up in their files as text. robot_model_test holds that against robots read whole.
#pragma once

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "env/scene/robot_model.h"

namespace floorproof {

inline std::vector<std::string> RobotNames() {
  std::vector<std::string> names;
  for (const RobotEntry& entry : Robots()) names.emplace_back(entry.name);
  return names;
}

// What a bundled robot's file states under <custom> as text of this name; empty: nothing.
inline std::string CustomText(const std::string& robot, const std::string& name) {
  std::ifstream file(FindRobotFile(robot, {}));
  const std::string mjcf(std::istreambuf_iterator<char>(file), {}),
      stated = "<text name=\"" + name + "\" data=\"";
  const std::size_t at = mjcf.find(stated);
  if (at == mjcf.npos) return "";
  const std::size_t begin = at + stated.size();
  return mjcf.substr(begin, mjcf.find('"', begin) - begin);
}

// Of a bundled robot that folds, the one in which it starts first; none of others.
inline std::vector<std::string> ShapeNames(const std::string& robot) {
  std::istringstream words(CustomText(robot, "shapes"));
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace floorproof
