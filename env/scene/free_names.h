// SPDX-License-Identifier: Apache-2.0
// Names for what a scene adds to a robot's model, which may have any names itself.
#pragma once

#include <mujoco/mujoco.h>

#include <set>
#include <string>

namespace floorproof {

class FreeNames {
 public:
  // Beside those that elements of this type have.
  FreeNames(mjSpec* spec, mjtObj type) {
    for (mjsElement* e = mjs_firstElement(spec, type); e; e = mjs_nextElement(spec, e))
      taken_.insert(mjs_getString(mjs_getName(e)));
  }
  // The name, or what is like it.
  std::string For(std::string name) const {
    while (taken_.contains(name)) name += '_';
    return name;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace floorproof
