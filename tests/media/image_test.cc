// SPDX-License-Identifier: Apache-2.0
// Images are read as stored, in every form a map comes in, and a file that lies is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/error.h"
#include "media/media.h"
#include "tests/media/png_maker.h"
#include "tests/own_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ImageTest : public OwnFolderTest {
 protected:
  // What refusing this file says.
  std::string Refusal(const fs::path& path) const {
    try {
      ReadImage(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(ImageTest, NetpbmInAllFourForms) {
  const std::string pixels = {'\x00', '\x64', '\xcd', '\xff'};
  const auto p5 = ReadImage(Save("a.pgm", "P5\n# CREATOR: a map saver\n2 2\n255\n" + pixels));
  EXPECT_EQ(p5.width, 2);
  EXPECT_EQ(p5.height, 2);
  EXPECT_EQ(p5.channels, 1);
  EXPECT_THAT(p5.data, ElementsAre(0, 100, 205, 255));

  const auto p2 = ReadImage(Save("b.pgm", "P2 # plain\n2 2 255\n0 100\n# between\n205 255"));
  EXPECT_EQ(p2.data, p5.data);

  const auto p6 = ReadImage(Save("c.ppm", "P6 1 1 255 abc"));
  EXPECT_EQ(p6.channels, 3);
  EXPECT_THAT(p6.data, ElementsAre('a', 'b', 'c'));
  const auto p3 = ReadImage(Save("d.ppm", "P3\n1 1\n255\n97 98 99\n"));
  EXPECT_EQ(p3.data, p6.data);
}

TEST_F(ImageTest, NetpbmScalesItsLargestValueToWhite) {
  const auto four = ReadImage(Save("a.pgm", "P2 3 1 15  0 12 15"));
  EXPECT_THAT(four.data, ElementsAre(0, 204, 255));
  EXPECT_FALSE(four.sixteen_bit);
  const auto wide =
      ReadImage(Save("b.pgm", std::string("P5 2 1 65535\n") + std::string("\xcd\xcd\xff\xff", 4)));
  EXPECT_THAT(wide.data, ElementsAre(205, 255));
  EXPECT_TRUE(wide.sixteen_bit);
}

TEST_F(ImageTest, PngGreyOfEveryDepthSpansBlackToWhite) {
  for (const int bits : {1, 2, 4, 8, 16}) {
    const unsigned top = (1U << bits) - 1;
    const auto image = ReadImage(Save("grey.png", MakePng({.width = 3,
                                                           .height = 1,
                                                           .bit_depth = bits,
                                                           .color_type = 0,
                                                           .samples = {0, top, 0}})));
    EXPECT_EQ(image.channels, 1) << bits;
    EXPECT_THAT(image.data, ElementsAre(0, 255, 0)) << bits;
    EXPECT_EQ(image.sixteen_bit, bits == 16);
  }
}

TEST_F(ImageTest, PngColourTypesKeepTheirChannels) {
  const auto ga = ReadImage(Save("ga.png", MakePng({.width = 2,
                                                    .height = 1,
                                                    .bit_depth = 8,
                                                    .color_type = 4,
                                                    .samples = {205, 255, 9, 7}})));
  EXPECT_EQ(ga.channels, 2);
  EXPECT_THAT(ga.data, ElementsAre(205, 255, 9, 7));

  const auto rgb = ReadImage(Save("rgb.png", MakePng({.width = 1,
                                                      .height = 2,
                                                      .bit_depth = 8,
                                                      .color_type = 2,
                                                      .samples = {1, 2, 3, 4, 5, 6}})));
  EXPECT_EQ(rgb.channels, 3);
  EXPECT_THAT(rgb.data, ElementsAre(1, 2, 3, 4, 5, 6));

  const auto rgba = ReadImage(Save("rgba.png", MakePng({.width = 1,
                                                        .height = 1,
                                                        .bit_depth = 8,
                                                        .color_type = 6,
                                                        .samples = {10, 20, 30, 40}})));
  EXPECT_EQ(rgba.channels, 4);
  EXPECT_THAT(rgba.data, ElementsAre(10, 20, 30, 40));

  const auto deep = ReadImage(Save("deep.png", MakePng({.width = 1,
                                                        .height = 1,
                                                        .bit_depth = 16,
                                                        .color_type = 6,
                                                        .samples = {0xffff, 0x8080, 0x0101, 0}})));
  EXPECT_THAT(deep.data, ElementsAre(255, 128, 1, 0));
  const auto between =
      ReadImage(Save("between.png", MakePng({.width = 4,
                                             .height = 1,
                                             .bit_depth = 16,
                                             .color_type = 0,
                                             .samples = {0x64ff, 0x6464, 0x80, 0x81}})));
  EXPECT_THAT(between.data, ElementsAre(101, 100, 0, 1)) << "rounded, not cut";
}

TEST_F(ImageTest, PngPaletteIsExpandedWithAndWithoutTransparency) {
  PngSpec spec{.width = 3,
               .height = 1,
               .bit_depth = 2,
               .color_type = 3,
               .samples = {0, 1, 2},
               .palette = std::string("\0\0\0\xcd\xcd\xcd\xfe\xfd\xfc", 9)};
  const auto plain = ReadImage(Save("p.png", MakePng(spec)));
  EXPECT_EQ(plain.channels, 3);
  EXPECT_THAT(plain.data, ElementsAre(0, 0, 0, 205, 205, 205, 254, 253, 252));

  spec.transparency = std::string("\xff\x00", 2);  // the rest are opaque
  const auto alpha = ReadImage(Save("pt.png", MakePng(spec)));
  EXPECT_EQ(alpha.channels, 4);
  EXPECT_THAT(alpha.data, ElementsAre(0, 0, 0, 255, 205, 205, 205, 0, 254, 253, 252, 255));
}

TEST_F(ImageTest, PngGreyWithASeeThroughLevelGainsAlpha) {
  for (const int bits : {4, 8, 16}) {
    const unsigned top = (1U << bits) - 1;
    const std::string level = {static_cast<char>(top >> 8), static_cast<char>(top & 0xff)};
    const auto image = ReadImage(Save("key.png", MakePng({.width = 2,
                                                          .height = 1,
                                                          .bit_depth = bits,
                                                          .color_type = 0,
                                                          .samples = {0, top},
                                                          .transparency = level})));
    EXPECT_EQ(image.channels, 2);
    EXPECT_THAT(image.data, ElementsAre(0, 255, 255, 0)) << bits;
  }
  // So does one colour of many.
  const auto rgb =
      ReadImage(Save("rgb.png", MakePng({.width = 2,
                                         .height = 1,
                                         .bit_depth = 8,
                                         .color_type = 2,
                                         .samples = {1, 2, 3, 4, 5, 6},
                                         .transparency = std::string("\0\4\0\5\0\6", 6)})));
  EXPECT_EQ(rgb.channels, 4);
  EXPECT_THAT(rgb.data, ElementsAre(1, 2, 3, 255, 4, 5, 6, 0));
}

TEST_F(ImageTest, PngThatIsInterlacedIsReadAsAnyOther) {
  for (const int type : {0, 2, 3, 4, 6}) {
    PngSpec spec{.width = 11, .height = 9, .bit_depth = type == 3 ? 4 : 8, .color_type = type};
    if (type == 3) spec.palette = std::string("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUV");
    for (unsigned i = 0; i < 11 * 9 * 4; ++i)
      spec.samples.push_back(i * 37 % (type == 3 ? 16 : 256));
    const auto plain = ReadImage(Save("plain.png", MakePng(spec)));
    spec.adam7 = true;
    const auto interlaced = ReadImage(Save("interlaced.png", MakePng(spec)));
    EXPECT_EQ(interlaced.channels, plain.channels) << type;
    EXPECT_EQ(interlaced.data, plain.data) << type;
  }
}

// A map's greys are what its YAML's thresholds were chosen for, whatever a screen would make of
// them.
TEST_F(ImageTest, PngIsReadAsStoredWhateverItsColourSpace) {
  for (const int bits : {8, 16}) {
    PngSpec spec{.width = 2, .height = 1, .bit_depth = bits, .color_type = 0};
    spec.samples =
        bits == 8 ? std::vector<unsigned>{100, 205} : std::vector<unsigned>{25700, 52685};
    spec.other = PngChunk("gAMA", PngBigEndian(100'000));  // linear light
    EXPECT_THAT(ReadImage(Save("g.png", MakePng(spec))).data, ElementsAre(100, 205)) << bits;
  }
}

TEST_F(ImageTest, BmpOfGreyAndColour) {
  cv::Mat grey(3, 5, CV_8UC1), color(3, 5, CV_8UC3, cv::Scalar(30, 20, 10));
  for (int i = 0; i < 15; ++i) grey.data[i] = static_cast<uchar>(17 * i);
  cv::imwrite((folder_ / "g.bmp").string(), grey);
  cv::imwrite((folder_ / "c.bmp").string(), color);
  const auto g = ReadImage(folder_ / "g.bmp");
  ASSERT_EQ(g.width, 5);
  ASSERT_EQ(g.height, 3);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(g.data[i * g.channels], 17 * i);
  const auto c = ReadImage(folder_ / "c.bmp");
  ASSERT_EQ(c.channels, 3);
  EXPECT_EQ(c.data[0], 10);
  EXPECT_EQ(c.data[1], 20);
  EXPECT_EQ(c.data[2], 30);
}

TEST_F(ImageTest, WhatIsNoImageIsRefusedInOneLineWithItsName) {
  EXPECT_THAT(Refusal(folder_ / "missing.pgm"), HasSubstr("missing.pgm: no such file"));
  EXPECT_THAT(Refusal(folder_), HasSubstr("is a folder"));
  EXPECT_THAT(Refusal("/dev/zero"), HasSubstr("a pipe or a device"));
  EXPECT_THAT(Refusal(Save("empty.png", "")), HasSubstr("is empty"));
  EXPECT_THAT(Refusal(Save("text.png", "hello")), HasSubstr("not an image that can be read"));
  EXPECT_THAT(Refusal(Save("n.pgm", "P5")), HasSubstr("not an image that can be read"));
  EXPECT_THAT(Refusal(Save("w.pgm", "P5 \nx 3 255\n")), HasSubstr("no number where the width"));
  EXPECT_THAT(Refusal(Save("z.pgm", "P5 0 3 255\n")), HasSubstr("at least 1 x 1"));
  EXPECT_THAT(Refusal(Save("m.pgm", "P5 3 3 0\n")), HasSubstr("largest value must be > 0"));
  EXPECT_THAT(Refusal(Save("v.pgm", "P2 2 1 10\n5 11\n")), HasSubstr("more than 10"));
  EXPECT_THAT(Refusal(Save("h.png", "\x89PNG\r\n\x1a\n....")), HasSubstr("truncated"));
  EXPECT_THAT(Refusal(Save("h.bmp", "BM....")), HasSubstr("truncated"));
  for (const auto& message : {Refusal(Save("text.png", "hello")), Refusal(folder_)})
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST_F(ImageTest, AHeaderThatClaimsTooMuchIsRefusedUnread) {
  EXPECT_THAT(Refusal(Save("a.pgm", "P5 200000 200000 255\n0000")),
              HasSubstr("200000 x 200000 pixels, more than its"));
  EXPECT_THAT(Refusal(Save("b.pgm", "P2 99999 9999 255\n0 0 0")), HasSubstr("more than its"));
  EXPECT_THAT(Refusal(Save("c.pgm", "P5 99999999999999999999 1 255\n")), HasSubstr("is more than"));
  EXPECT_THAT(
      Refusal(Save("d.png",
                   MakePng({.width = 200000, .height = 200000, .bit_depth = 8, .color_type = 0}))),
      HasSubstr("200000 x 200000 pixels: at most"));
  EXPECT_THAT(
      Refusal(
          Save("e.png", MakePng({.width = 8000, .height = 8000, .bit_depth = 8, .color_type = 6}))),
      HasSubstr("bytes of compressed data"));
  std::string bmp(54, '\0');
  bmp[0] = 'B', bmp[1] = 'M', bmp[10] = 54, bmp[14] = 40, bmp[26] = 1, bmp[28] = 8;
  bmp[18] = bmp[22] = 64;
  EXPECT_THAT(Refusal(Save("f.bmp", bmp)), HasSubstr("BMP is truncated"));
  // A caller's own limit holds too.
  EXPECT_THROW(ReadImage(Save("g.pgm", "P5 2 2 255\n0000"), 3), InputError);
  EXPECT_NO_THROW(ReadImage(Save("g.pgm", "P5 2 2 255\n0000"), 4));
}

TEST_F(ImageTest, EveryTruncationIsRefused) {
  cv::Mat noise(20, 20, CV_8UC1);
  cv::randu(noise, 0, 255);
  for (const char* ending : {".png", ".pgm", ".bmp"}) {
    std::vector<uchar> bytes;
    ASSERT_TRUE(cv::imencode(ending, noise, bytes));
    const std::string whole(bytes.begin(), bytes.end());
    ASSERT_EQ(Refusal(Save(std::string("whole") + ending, whole)), "accepted") << ending;
    for (std::size_t keep = 0; keep < whole.size(); keep += keep < 80 ? 1 : 13)
      EXPECT_NE(Refusal(Save(std::string("cut") + ending, whole.substr(0, keep))), "accepted")
          << ending << " cut to " << keep << " of " << whole.size();
  }
}

TEST_F(ImageTest, DamagedPngIsRefused) {
  PngSpec spec{.width = 30, .height = 30, .bit_depth = 8, .color_type = 0};
  spec.samples.assign(900, 205);
  std::string png = MakePng(spec);
  std::string flipped = png;
  flipped[flipped.size() - 30] ^= 1;
  EXPECT_THAT(Refusal(Save("flipped.png", flipped)), HasSubstr("wrong checksum"));
  // Chunks that are whole, around compressed data that stops halfway: rows would stay grey.
  spec.drop_rows = 10;
  ::testing::internal::CaptureStderr();
  const std::string said = Refusal(Save("rows.png", MakePng(spec)));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "libpng's own line comes on top";
  EXPECT_THAT(said, HasSubstr("cannot be decoded: Not enough image data"));
}

// With right checksums, so that libpng meets it: it may read it or refuse it, in one line of ours.
TEST_F(ImageTest, AnyByteChangedWithinAChunkIsReadOrRefused) {
  PngSpec spec{.width = 16, .height = 16, .bit_depth = 4, .color_type = 3};
  spec.samples.assign(256, 1);
  spec.palette = std::string(12, '\x40');
  spec.transparency = "ab";
  int refused = 0;
  ::testing::internal::CaptureStderr();
  for (const bool adam7 : {false, true}) {
    spec.adam7 = adam7;
    const std::string whole = MakePng(spec);
    for (std::size_t at = 8; at < whole.size(); ++at)
      for (const int value : {0, 1, 0x20, 0x7f, 0xff}) {
        std::string changed = whole;
        changed[at] = static_cast<char>(value);
        refused +=
            Refusal(Save("changed.png", WithRightChecksums(changed))).find("cannot be decoded: ") !=
            std::string::npos;
      }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 100) << "libpng was asked";
}

TEST_F(ImageTest, PngThatLibpngRefusesIsRefusedWithItsReason) {
  PngSpec spec{.width = 2, .height = 1, .color_type = 3, .samples = {0, 1}};
  EXPECT_THAT(Refusal(Save("p.png", MakePng(spec))),
              HasSubstr("cannot be decoded: IDAT: Missing PLTE"));
  spec.palette = std::string(6, 'a');
  spec.other = PngChunk("WHAT", "is critical, as its first letter says");
  EXPECT_THAT(Refusal(Save("w.png", MakePng(spec))), HasSubstr("cannot be decoded: WHAT"));
  // Texts are not even looked at.
  spec.other = PngChunk("zTXt", std::string("Comment\0\0", 9) + "no zlib");
  EXPECT_EQ(Refusal(Save("z.png", MakePng(spec))), "accepted");
}

TEST_F(ImageTest, APngsTextsAreNotUnpacked) {
  const std::string text(7'500'000, 'a');  // a thousandth of it when packed
  std::vector<Bytef> packed(compressBound(text.size()));
  uLongf size = packed.size();
  ASSERT_EQ(
      compress(packed.data(), &size, reinterpret_cast<const Bytef*>(text.data()), text.size()),
      Z_OK);
  PngSpec spec{.width = 1, .height = 1, .color_type = 0, .samples = {7}};
  for (int i = 0; i < 40; ++i)
    spec.other += PngChunk(
        "zTXt", std::string("Comment\0\0", 9) + std::string(packed.begin(), packed.begin() + size));
  const fs::path file = Save("texts.png", MakePng(spec));
  ASSERT_LT(fs::file_size(file), 1'000'000u);
  const auto most_kb = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  const long before_kb = most_kb();
  EXPECT_EQ(ReadImage(file).data.at(0), 7);
  EXPECT_LT(most_kb() - before_kb, 100'000) << "unpacked they are 300 MB";
}

TEST_F(ImageTest, ALongPngIsReadUpToLibpngsLimit) {
  const auto line = [&](unsigned width, unsigned height) {
    return Save("line.png", MakePng({.width = width,
                                     .height = height,
                                     .color_type = 0,
                                     .samples = std::vector<unsigned>(width * height, 7)}));
  };
  EXPECT_EQ(ReadImage(line(1'000'000, 1)).data.back(), 7);
  EXPECT_EQ(ReadImage(line(1, 1'000'000)).data.back(), 7);
  EXPECT_THAT(Refusal(line(1'000'001, 1)), HasSubstr("at most 1000000 a side"));
  EXPECT_THAT(Refusal(line(1, 1'000'001)), HasSubstr("at most 1000000 a side"));
}

// OpenCV would say so on stderr, in lines of its own.
TEST_F(ImageTest, ABmpsWrongHeaderIsRefusedInOneLine) {
  cv::Mat grey(4, 4, CV_8UC1, cv::Scalar(9));
  std::vector<uchar> bytes;
  ASSERT_TRUE(cv::imencode(".bmp", grey, bytes));
  bytes[47] = 2;  // 512 colours and more of 256
  ::testing::internal::CaptureStderr();
  const std::string said = Refusal(Save("c.bmp", std::string(bytes.begin(), bytes.end())));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(said, HasSubstr("c.bmp: cannot be decoded"));
  EXPECT_EQ(said.find('\n'), std::string::npos);
}

TEST_F(ImageTest, AnyByteChangedNeverCrashes) {
  PngSpec spec{.width = 16, .height = 16, .bit_depth = 4, .color_type = 3};
  spec.samples.assign(256, 1);
  spec.palette = std::string(12, '\x40');
  for (const std::string& whole : {MakePng(spec), std::string("P5\n4 4\n255\n0123456789abcdef"),
                                   std::string("P2\n4 1\n255\n1 2 3 4")}) {
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const int value : {0, 0x20, 0x39, 0x7f, 0xff}) {
        std::string changed = whole;
        changed[at] = static_cast<char>(value);
        const std::string said = Refusal(Save("changed", changed));
        EXPECT_FALSE(said.empty());
      }
  }
}

TEST_F(ImageTest, WrittenPngReadsBackTheSame) {
  for (const int channels : {1, 3, 4}) {
    Image image;
    image.width = 7;
    image.height = 4;
    image.channels = channels;
    for (int i = 0; i < 28 * channels; ++i) image.data.push_back(static_cast<std::uint8_t>(i * 37));
    WritePng(folder_ / "out.png", image);
    const Image back = ReadImage(folder_ / "out.png");
    EXPECT_EQ(back.channels, channels);
    EXPECT_TRUE(back.data == image.data) << channels;
    // Another reader sees the same.
    const cv::Mat other = cv::imread((folder_ / "out.png").string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(other.channels(), channels);
    const int red = channels == 1 ? 0 : 2;  // OpenCV keeps blue first
    EXPECT_EQ(other.ptr(3)[6 * channels + red],
              image.data[27 * static_cast<std::size_t>(channels)]);
  }
  // Nothing but the picture is left in the folder.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ImageTest, WritingWhereThereIsNoFolderSaysSo) {
  const Image image{1, 1, 1, {0}, false};
  EXPECT_THROW(WritePng(folder_ / "no" / "out.png", image), InputError);
}

}  // namespace
}  // namespace floorproof
