// SPDX-License-Identifier: Apache-2.0
#include "base/try_in_child.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "base/error.h"
#include "base/sanitizer.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;

std::string FailureOf(const std::function<std::string()>& work, const TrialLimits& limits = {}) {
  const TrialOutcome dut = TryInChild(work, limits);
  EXPECT_FALSE(dut.answer.has_value());
  return dut.failure;
}

TEST(TryInChild, AnswersAtAnyLength) {
  for (const std::size_t size : {0u, 1u, 1'000'000u}) {
    const TrialOutcome dut = TryInChild([&] { return std::string(size, 'x'); });
    ASSERT_TRUE(dut.answer.has_value()) << dut.failure;
    EXPECT_EQ(*dut.answer, std::string(size, 'x'));
  }
}

TEST(TryInChild, WhatItChangesIsNotFelt) {
  int value = 1;
  const TrialOutcome dut = TryInChild([&] { return std::to_string(++value); });
  EXPECT_EQ(dut.answer, "2");
  EXPECT_EQ(value, 1);
}

TEST(TryInChild, SaysHowItFailed) {
  EXPECT_THAT(FailureOf([]() -> std::string {
                raise(SIGSEGV);
                return "";
              }),
              HasSubstr("crashed (Segmentation fault)"));
  EXPECT_THAT(FailureOf([]() -> std::string { std::abort(); }), HasSubstr("crashed (Abort"));
  EXPECT_EQ(FailureOf([]() -> std::string { std::exit(0); }), "gave up");
  EXPECT_EQ(FailureOf([]() -> std::string { throw std::runtime_error("no"); }), "gave up");
  EXPECT_EQ(FailureOf([]() -> std::string { EndForWantOfMemory(); }), "needed more than 384 MiB");
}

TEST(TryInChild, DoesNotTakeALostChildsEndForAnAnswer) {
  const auto before = signal(SIGCHLD, SIG_IGN);  // as a shell's `trap '' CHLD` leaves it
  EXPECT_THROW(TryInChild([]() -> std::string { std::abort(); }), InternalError);
  signal(SIGCHLD, before);
}

TEST(TryInChild, EndsWhatHangsWorkingOrWaiting) {
  EXPECT_EQ(FailureOf(
                []() -> std::string {
                  volatile bool on = true;
                  while (on) {
                  }
                  return "";
                },
                {.cpu_s = 1}),
            "took more than 1 s of processor time");
  EXPECT_EQ(FailureOf(
                []() -> std::string {
                  for (;;) pause();
                },
                {.wall_s = 1}),
            "took more than 1 s");
}

#ifndef FP_ADDRESS_SANITIZER
TEST(TryInChild, BoundsWhatIsAllocatedBeyondWhatIsHeld) {
  const std::vector<char> held(100u << 20, 'x');
  const auto take = [](std::size_t bytes) {
    return [bytes] { return std::string(1, std::string(bytes, 'y').back()); };
  };
  const TrialLimits limits = {.memory_bytes = 64u << 20};
  EXPECT_EQ(TryInChild(take(32u << 20), limits).answer, "y");
  EXPECT_EQ(FailureOf(take(96u << 20), limits), "needed more than 64 MiB");
  EXPECT_EQ(held.back(), 'x');
}
#endif

}  // namespace
}  // namespace floorproof
