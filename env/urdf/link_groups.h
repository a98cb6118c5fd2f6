// SPDX-License-Identifier: Apache-2.0
// Links that move as one.
#pragma once

#include <string>
#include <vector>

#include "env/urdf/urdf_model.h"

namespace floorproof {

// What turns for ever against what carries it, and all that is fixed to it. Other joints are held.
struct LinkGroup {
  int head = 0;     // the link whose joint turns; of the first group the root
  int parent = -1;  // index of the group that carries it
  MassOf mass;
  std::vector<UrdfShape> shapes;
  std::vector<std::size_t> links;  // indices of the model's, the head first
};

// The root's group first; each stands behind its parent. `held` gets a note for each joint that
// could move and does not.
std::vector<LinkGroup> GroupLinks(const UrdfModel& model, std::vector<std::string>& held);

}  // namespace floorproof
