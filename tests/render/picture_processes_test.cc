// SPDX-License-Identifier: Apache-2.0
#include "render/picture_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>
#include <vector>

#include "base/error.h"

namespace floorproof {
namespace {

// Each picture holds its number, and which process drew it.
PictureProcesses::Draw Numbers() {
  return [](std::size_t i, std::uint8_t* pixels) {
    pixels[0] = static_cast<std::uint8_t>(i);
    pixels[1] = static_cast<std::uint8_t>(getpid());
  };
}

TEST(PictureProcesses, PicturesComeInOrderFromAllOfThem) {
  for (const int processes : {1, 2, 3, 7}) {
    PictureProcesses dut(40, 2, processes, Numbers);
    std::set<std::uint8_t> drew;
    for (std::size_t i = 0; i < 40; ++i) {
      const std::uint8_t* picture = dut.Next();
      EXPECT_EQ(picture[0], i);
      drew.insert(picture[1]);
    }
    EXPECT_EQ(drew.size(), static_cast<std::size_t>(processes));
  }
}

TEST(PictureProcesses, MoreThanThereArePicturesIsNoHarm) {
  PictureProcesses dut(2, 2, 5, Numbers);
  EXPECT_EQ(dut.Next()[0], 0);
  EXPECT_EQ(dut.Next()[0], 1);
  EXPECT_THROW(dut.Next(), InternalError);
}

TEST(PictureProcesses, NobodyWaitsForThoseThatAreNotAskedAgain) {
  PictureProcesses dut(1000, 1 << 16, 3, Numbers);  // they would be far ahead
  EXPECT_EQ(dut.Next()[0], 0);
}

TEST(PictureProcesses, WhatOneSaysIsThrown) {
  const auto fails_at = [](std::size_t at) {
    return [at]() -> PictureProcesses::Draw {
      if (at == 0) throw InputError("there is no GL here");
      return [at](std::size_t i, std::uint8_t*) {
        if (i == at) throw InternalError("it went dark");
      };
    };
  };
  const auto why = [](PictureProcesses& dut) -> std::string {
    try {
      for (int i = 0; i < 10; ++i) dut.Next();
    } catch (const InternalError& e) {
      return e.what();
    }
    return "";
  };
  PictureProcesses none(10, 1, 2, fails_at(0)), dark(10, 1, 2, fails_at(5));
  EXPECT_THAT(why(none), ::testing::HasSubstr("there is no GL here"));
  EXPECT_THAT(why(dark), ::testing::HasSubstr("it went dark"));
}

TEST(PictureProcesses, OneThatDiesIsNoticed) {
  PictureProcesses dut(10, 1, 2, []() -> PictureProcesses::Draw {
    return [](std::size_t i, std::uint8_t*) {
      if (i == 3) _exit(0);
    };
  });
  for (int i = 0; i < 3; ++i) dut.Next();
  EXPECT_THROW(dut.Next(), InternalError);
}

}  // namespace
}  // namespace floorproof
