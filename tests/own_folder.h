// SPDX-License-Identifier: Apache-2.0
// Tests that write: a folder for each, which is empty when it begins and gone when it has ended.
// They run side by side, so that its name is the test's.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/test_name.h"

namespace floorproof {

class OwnFolderTest : public ::testing::Test {
 protected:
  OwnFolderTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~OwnFolderTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Save(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  const std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) / TestName();
};

}  // namespace floorproof
