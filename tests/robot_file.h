// SPDX-License-Identifier: Apache-2.0
// A robot's text as a file, for as long as this lives. Tests run side by side, so the file's name
// holds the test's.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/test_name.h"

namespace floorproof {

class RobotFile {
 public:
  explicit RobotFile(const std::string& mjcf) { std::ofstream(path_) << mjcf; }
  RobotFile(const RobotFile&) = delete;
  RobotFile& operator=(const RobotFile&) = delete;
  ~RobotFile() { std::filesystem::remove(path_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / (TestName() + ".xml");
};

}  // namespace floorproof
