// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/link_groups.h"

namespace floorproof {

std::vector<LinkGroup> GroupLinks(const UrdfModel& model, std::vector<std::string>& held) {
  std::vector<LinkGroup> groups;
  std::vector<int> group_of(model.links.size());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const UrdfLink& link = model.links[i];
    const int above = link.parent >= 0 ? group_of[static_cast<std::size_t>(link.parent)] : -1;
    if (above < 0 || link.turns_freely) {
      groups.push_back({static_cast<int>(i), above, {}, {}, {}});
      group_of[i] = static_cast<int>(groups.size()) - 1;
    } else {
      group_of[i] = above;
      if (link.joint == UrdfLink::Joint::kHinge || link.joint == UrdfLink::Joint::kSlide)
        held.push_back("joint " + link.joint_name + " is held where it stands");
    }
    LinkGroup& group = groups[static_cast<std::size_t>(group_of[i])];
    group.mass += link.mass;
    group.links.push_back(i);
    group.shapes.insert(group.shapes.end(), link.shapes.begin(), link.shapes.end());
  }
  return groups;
}

}  // namespace floorproof
