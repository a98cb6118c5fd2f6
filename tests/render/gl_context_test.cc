// SPDX-License-Identifier: Apache-2.0
// Each backend alone, in a process of its own, because MuJoCo loads its GL functions once per
// process.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/render/room.h"

namespace floorproof {
namespace {

constexpr int kDrawn = 0, kNoBackend = 77, kBlack = 1;

// Draws a frame with one backend and ends the process.
[[noreturn]] void DrawWith(const char* backend) {
  setenv("FLOORPROOF_GL", backend, 1);
  const GlReport report = ProbeGl();
  if (report.backend != backend) std::_Exit(kNoBackend);
  Room room;
  room.Put({0, 0, 0});
  OffscreenRenderer dut(room.model(), 64, 48);
  Image image = dut.MakeImage();
  CameraView view;
  view.eye_W = {-2, 0, 1.5};
  view.target_W = {0, 0, 0};
  dut.Render(room.data(), view, nullptr, image);
  int bright = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) bright += Luma(image, x, y) > 60;
  std::_Exit(bright > 64 * 48 / 2 ? kDrawn : kBlack);
}

class GlBackend : public ::testing::TestWithParam<const char*> {};

TEST_P(GlBackend, DrawsOrIsNotThere) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      DrawWith(GetParam()),
      [](int status) {
        return WIFEXITED(status) &&
               (WEXITSTATUS(status) == kDrawn || WEXITSTATUS(status) == kNoBackend);
      },
      "");
}

// The library's threads are not in the child: it would wait for them for ever.
[[noreturn]] void DrawAfterFork() {
  Room room;
  OffscreenRenderer before(room.model(), 64, 48);
  Image image = before.MakeImage();
  before.Render(room.data(), CameraView{}, nullptr, image);
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    int refused = 0;
    try {
      before.Render(room.data(), CameraView{}, nullptr, image);
    } catch (const InputError&) {
      ++refused;
    }
    try {
      OffscreenRenderer(room.model(), 64, 48);
    } catch (const InputError&) {
      ++refused;
    }
    std::_Exit(refused == 2 ? kDrawn : kBlack);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::_Exit(WIFEXITED(status) ? WEXITSTATUS(status) : kNoBackend);
}

TEST(GlContextTest, AForkOfWhatHasDrawnIsTold) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(DrawAfterFork(), ::testing::ExitedWithCode(kDrawn), "");
}

INSTANTIATE_TEST_SUITE_P(Backends, GlBackend, ::testing::Values("osmesa", "egl"));

TEST(GlContextTest, UnknownBackendIsNamed) {
  const char* before = std::getenv("FLOORPROOF_GL");
  const std::string kept = before == nullptr ? "" : before;
  setenv("FLOORPROOF_GL", "vulkan", 1);
  const GlReport report = ProbeGl();
  EXPECT_EQ(report.backend, "");
  ASSERT_EQ(report.failures.size(), 1u);
  EXPECT_THAT(report.failures[0], ::testing::HasSubstr("FLOORPROOF_GL = vulkan"));
  try {
    MakeGlContext();
    ADD_FAILURE() << "made a context of an unknown kind";
  } catch (const InternalError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("must be osmesa or egl"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("apt-get install"));
  }
  setenv("FLOORPROOF_GL", kept.c_str(), 1);
}

}  // namespace
}  // namespace floorproof
