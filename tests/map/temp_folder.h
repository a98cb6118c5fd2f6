// SPDX-License-Identifier: Apache-2.0
// A folder of its own for each test, and what refusing something says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "tests/own_folder.h"

namespace floorproof {

class TempFolder : public OwnFolderTest {
 protected:
  template <class Action>
  static std::string Refusal(const Action& action) {
    try {
      action();
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

}  // namespace floorproof
