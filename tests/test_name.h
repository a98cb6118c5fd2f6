// SPDX-License-Identifier: Apache-2.0
// The running test's name as that of a file: tests run side by side.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace floorproof {

inline std::string TestName() {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.test_suite_name()) + "." + test.name();
  std::ranges::replace(name, '/', '.');  // of parameters
  return name;
}

}  // namespace floorproof
