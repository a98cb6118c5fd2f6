// SPDX-License-Identifier: Apache-2.0
// A film is written as browsers want it, the same bytes each time, and says nothing on stderr.
#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/videoio.hpp>

#include "base/error.h"
#include "media/media.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 240, kFrames = 25;

std::string Bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A white square that moves right by 8 pixels a frame over blue.
Image Frame(int i) {
  Image image{kWidth, kHeight, 3, {}, false};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool in = x >= 8 * i && x < 8 * i + 64 && y >= 80 && y < 144;
      image.data.insert(image.data.end(), {static_cast<std::uint8_t>(in ? 255 : 0),
                                           static_cast<std::uint8_t>(in ? 255 : 0), 255});
    }
  return image;
}

class VideoTest : public OwnFolderTest {
 protected:
  void Film(const fs::path& path) const {
    auto dut = OpenVideo(path, kWidth, kHeight, 25);
    for (int i = 0; i < kFrames; ++i) dut->Add(Frame(i));
    dut->Close();
  }
};

TEST_F(VideoTest, FramesComeBackInOrderWithTheirColours) {
  const fs::path path = folder_ / "film.mp4";
  Film(path);
  cv::VideoCapture capture(path.string(), cv::CAP_FFMPEG);
  ASSERT_TRUE(capture.isOpened());
  EXPECT_EQ(capture.get(cv::CAP_PROP_FRAME_WIDTH), kWidth);
  EXPECT_EQ(capture.get(cv::CAP_PROP_FRAME_HEIGHT), kHeight);
  EXPECT_EQ(capture.get(cv::CAP_PROP_FPS), 25);
  cv::Mat bgr;
  int n = 0;
  for (; capture.read(bgr); ++n) {
    const auto square = bgr.at<cv::Vec3b>(112, 8 * n + 32), ground = bgr.at<cv::Vec3b>(20, 20);
    for (int k = 0; k < 3; ++k) EXPECT_GT(square[k], 235) << n;
    EXPECT_GT(ground[0], 235);  // blue, and not red: the channels are in order
    EXPECT_LT(ground[2], 20);
  }
  EXPECT_EQ(n, kFrames);
}

TEST_F(VideoTest, IsH264HighInYuv420pWithItsIndexFirst) {
  const fs::path path = folder_ / "film.mp4";
  Film(path);
  const std::string mp4 = Bytes(path);
  EXPECT_LT(mp4.find("moov"), mp4.find("mdat"));
  // The avcC box: version 1, profile 100 (High); browsers want its 4:2:0 form.
  const auto config = mp4.find("avcC");
  ASSERT_NE(config, std::string::npos);
  EXPECT_EQ(mp4[config + 4], 1);
  EXPECT_EQ(mp4[config + 5], 100);
  EXPECT_NE(mp4.find("avc1"), std::string::npos);
}

// Whatever lay in the heap before: an encoder that reads memory it never wrote shows here.
TEST_F(VideoTest, SameFramesSameBytes) {
  Film(folder_ / "a.mp4");
  const std::string a = Bytes(folder_ / "a.mp4");
  EXPECT_GT(a.size(), 1000u);
  for (const int filler : {1, 85, 170}) {
    mallopt(M_PERTURB, filler);
    Film(folder_ / "b.mp4");
    mallopt(M_PERTURB, 0);
    EXPECT_TRUE(a == Bytes(folder_ / "b.mp4")) << filler;
  }
}

TEST_F(VideoTest, NothingIsSaidOnStderr) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  Film(folder_ / "film.mp4");
  std::fflush(nullptr);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST_F(VideoTest, AnUnfinishedFilmLeavesNothing) {
  {
    auto dut = OpenVideo(folder_ / "film.mp4", kWidth, kHeight, 25);
    dut->Add(Frame(0));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(VideoTest, WhatCannotBeWrittenIsRefused) {
  EXPECT_THROW(OpenVideo(folder_ / "odd.mp4", 321, 240, 25), InputError);
  EXPECT_THROW(OpenVideo(folder_ / "odd.mp4", 320, 0, 25), InputError);
  EXPECT_THROW(OpenVideo(folder_ / "still.mp4", 320, 240, 0), InputError);
  EXPECT_THROW(OpenVideo(folder_ / "no" / "film.mp4", 320, 240, 25), InputError);
}

}  // namespace
}  // namespace floorproof
