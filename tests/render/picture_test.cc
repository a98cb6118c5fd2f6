// SPDX-License-Identifier: Apache-2.0
// Pictures, judged as an eye would.
#include <array>

#include "tests/render/room.h"

namespace floorproof {
namespace {

constexpr int kWidth = 480, kHeight = 270;

// Straight down on the room, 6.4 m wide: pixels and metres keep a fixed ratio.
CameraView Above() {
  CameraView view;
  view.eye_W = {0, 0, 5};
  view.target_W = {0, 0, 0};
  view.up_W = Vec3::UnitY();
  view.orthographic = true;
  view.height_m = 6.4 * kHeight / kWidth;
  return view;
}
int Column(double x_m) { return static_cast<int>(kWidth * (0.5 + x_m / 6.4)); }
int Row(double y_m) { return static_cast<int>(kHeight * 0.5 - kWidth * y_m / 6.4); }

Image Picture(Room& room, const CameraView& view, const FloorPaint* paint = nullptr) {
  OffscreenRenderer dut(room.model(), kWidth, kHeight);
  Image image = dut.MakeImage();
  dut.Render(room.data(), view, paint, image);
  return image;
}

CameraView First(const char* camera, const Room& room, const Pose2& X_WB) {
  const auto made = MakePlugin(Cameras(), camera, "camera");
  made->Reset(room.Set(), X_WB);
  return made->Next(X_WB, {1.0 / 30, 1});
}

class EveryCamera : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryCamera, GivesABrightPictureWithContrast) {
  FP_NEED_GL();
  Room room;
  const Pose2 X_WB{0.4, -0.4, 0.3};
  room.Put(X_WB);
  const Image image = Picture(room, First(GetParam(), room, X_WB));
  double sum = 0, squares = 0;
  int black = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double v = Luma(image, x, y);
      sum += v;
      squares += v * v;
      black += v < 12;
    }
  }
  constexpr double kCount = kWidth * kHeight;
  const double mean = sum / kCount, deviation = std::sqrt(squares / kCount - mean * mean);
  EXPECT_GT(mean, 70);
  EXPECT_LT(mean, 225);
  EXPECT_GT(deviation, 18);
  EXPECT_LT(black / kCount, 0.03);
}

TEST_P(EveryCamera, HasTheRobotNearTheMiddle) {
  FP_NEED_GL();
  Room room;
  const Pose2 X_WB{0.0, 0.0, 0.3};
  room.Put(X_WB);
  const CameraView view = First(GetParam(), room, X_WB);
  const Image with = Picture(room, view);
  room.Put({0, 0, 0}, /*z_m=*/-5);
  const Image without = Picture(room, view);
  double sx = 0, sy = 0, n = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (Difference(with, without, x, y) < 12) continue;
      sx += x;
      sy += y;
      ++n;
    }
  }
  ASSERT_GT(n, 100);
  EXPECT_NEAR(sx / n, kWidth / 2, kWidth / 8);
  EXPECT_NEAR(sy / n, kHeight / 2, kHeight / 5);
}

INSTANTIATE_TEST_SUITE_P(Cameras, EveryCamera, ::testing::Values("auto", "chase", "top", "side"));

// The wheel behind the shell is seen through it, and the shell still is; then as before.
TEST(PictureTest, TheShellIsSeenThrough) {
  FP_NEED_GL();
  Room room;
  room.Put({0, 0, 0});
  const mjModel* m = room.model();
  const int base = mj_name2id(m, mjOBJ_BODY, "base");
  std::vector<int> shell;
  for (int g = 0; g < m->body_geomnum[base]; ++g) shell.push_back(m->body_geomadr[base] + g);
  OffscreenRenderer dut(m, kWidth, kHeight);
  const auto picture = [&](std::vector<int> geoms) {
    dut.SeeThrough(std::move(geoms));
    Image image = dut.MakeImage();
    dut.Render(room.data(), Above(), nullptr, image);
    return image;
  };
  const Image whole = picture({}), thin = picture(shell), again = picture({});
  EXPECT_EQ(again.data, whole.data);
  const int x = Column(0), y = Row(0);  // the shell's middle
  EXPECT_GT(Difference(whole, thin, x, y), 8);
  room.Put({0, 0, 0}, /*z_m=*/-5);
  const Image floor = picture({});
  EXPECT_GT(Difference(floor, thin, x, y), 3) << "it is glass, not gone";
}

// What changes when the robot moves lies where it was and where it is.
TEST(PictureTest, RobotsPixelsMoveAndNothingElseDoes) {
  FP_NEED_GL();
  Room room;
  room.Put({-1.0, 0.5, 0});
  const Image before = Picture(room, Above());
  room.Put({0.5, -0.5, 0});
  const Image after = Picture(room, Above());
  int at_old = 0, at_new = 0, elsewhere = 0;
  const double reach = 0.35;  // the robot and its shadow
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (Difference(before, after, x, y) < 8) continue;
      const Vec2 p(6.4 * (x + 0.5) / kWidth - 3.2, 6.4 / kWidth * (kHeight / 2.0 - y - 0.5));
      if ((p - Vec2(-1.0, 0.5)).norm() < reach) {
        ++at_old;
      } else if ((p - Vec2(0.5, -0.5)).norm() < reach) {
        ++at_new;
      } else {
        ++elsewhere;
      }
    }
  }
  const double robot_px = kPi * std::pow(0.17 * kWidth / 6.4, 2);
  EXPECT_GT(at_old, 0.5 * robot_px);
  EXPECT_GT(at_new, 0.5 * robot_px);
  EXPECT_EQ(elsewhere, 0);
}

TEST(PictureTest, UpIsNorthAndRightIsEastSeenFromAbove) {
  FP_NEED_GL();
  Room room({.step = false, .glass = false, .walls = false});
  room.Put({1.0, 0.8, 0});
  const Image image = Picture(room, Above());
  room.Put({0, 0, 0}, -5);
  const Image empty = Picture(room, Above());
  EXPECT_GT(Difference(image, empty, Column(1.0), Row(0.7)), 12);
  EXPECT_LT(Difference(image, empty, Column(1.0), Row(-0.7)), 4);
  EXPECT_LT(Difference(image, empty, Column(-1.0), Row(0.7)), 4);
}

TEST(PictureTest, StepIsSeenInItsColumnsOnly) {
  FP_NEED_GL();
  Room with({.step = true}), without({.step = false});
  with.Put({-1, 0, 0});
  without.Put({-1, 0, 0});
  const Image a = Picture(with, Above()), b = Picture(without, Above());
  std::array<double, kWidth> profile{};
  for (int x = 0; x < kWidth; ++x) {
    for (int y = 0; y < kHeight; ++y) profile[x] += Difference(a, b, x, y) / double{kHeight};
  }
  const int low = Column(1.0), high = Column(1.5);
  for (int x = low + 2; x < high - 2; ++x) EXPECT_GT(profile[x], 10) << "column " << x;
  const int shadow = Column(1.6);
  for (int x = 0; x < kWidth; ++x) {
    if (x < low - 2 || x > shadow) {
      EXPECT_LT(profile[x], 0.5) << "column " << x;
    }
  }
}

// Black and white stripes behind the pane keep a share of their contrast.
TEST(PictureTest, GlassIsSeenAndSeenThrough) {
  FP_NEED_GL();
  const auto contrast = [](bool glass) {
    Room room({.step = false, .glass = glass});
    room.Put({-1, 0, 0});
    FloorPaint paint;
    paint.AddStripe({2.3, 0.0}, {2.3, 0.35}, 0.002, 0.5, {0, 0, 0, 1});
    paint.AddStripe({2.3, -0.35}, {2.3, 0.0}, 0.002, 0.5, {1, 1, 1, 1});
    CameraView view;
    view.eye_W = {0.9, 0, 0.5};
    view.target_W = {2.3, 0, 0};
    const Image image = Picture(room, view, &paint);
    return Luma(image, kWidth / 2 + 25, kHeight / 2) - Luma(image, kWidth / 2 - 25, kHeight / 2);
  };
  const double clear = contrast(false), through = contrast(true);
  ASSERT_GT(clear, 60);
  EXPECT_GT(through, 0.2 * clear);
  EXPECT_LT(through, 0.9 * clear);
}

TEST(PictureTest, WallBetweenCameraAndRobotIsThinned) {
  FP_NEED_GL();
  Room room;
  CameraView view;
  view.eye_W = {0, -3.5, 0.9};
  view.target_W = {0, -1.6, 0.05};
  room.Put({0, -1.6, 0});
  const Image with = Picture(room, view);
  room.Put({0, -1.6, 0}, -5);
  const Image without = Picture(room, view);
  int seen = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) seen += Difference(with, without, x, y) > 12;
  EXPECT_GT(seen, 1000);
}

TEST(PictureTest, PaintColoursTheFloorUnderIt) {
  FP_NEED_GL();
  Room room({.step = false, .glass = false});
  room.Put({-2, 1.5, 0});
  FloorPaint paint;
  paint.AddStripe({-1, -0.5}, {1, -0.5}, 0.002, 0.2, {0.9f, 0.1f, 0.1f, 1});
  const Image plain = Picture(room, Above()), painted = Picture(room, Above(), &paint);
  const std::uint8_t* p = Pixel(painted, Column(0), Row(-0.5));
  EXPECT_GT(p[0], p[1] + 60);
  EXPECT_EQ(Difference(plain, painted, Column(0), Row(0.2)), 0);
}

TEST(PictureTest, FullPaintGivesUpItsOldestStripe) {
  FloorPaint dut(2);
  for (int i = 0; i < 3; ++i) dut.AddStripe({0, 1.0 * i}, {1, 1.0 * i}, 0, 0.1, {1, 1, 1, 1});
  ASSERT_EQ(dut.geoms().size(), 2u);
  EXPECT_FLOAT_EQ(dut.geoms()[0].pos[1], 2);
  EXPECT_FLOAT_EQ(dut.geoms()[1].pos[1], 1);
}

TEST(PictureTest, SamePoseSameBytes) {
  FP_NEED_GL();
  Room room;
  room.Put({0.2, 0.1, 1});
  const Image a = Picture(room, Above());
  room.Put({1, 1, 0});
  Picture(room, Above());
  room.Put({0.2, 0.1, 1});
  EXPECT_EQ(a.data, Picture(room, Above()).data);
}

TEST(PictureTest, TooLargeAPictureIsRefused) {
  FP_NEED_GL();
  Room room;
  EXPECT_THROW(OffscreenRenderer(room.model(), 1'000'000, 16), InternalError);
}

// A page to look at: each camera at three places, the last one fallen over.
TEST(PictureTest, ContactSheet) {
  FP_NEED_GL();
  Room room;
  OffscreenRenderer dut(room.model(), kWidth, kHeight);
  Image frame = dut.MakeImage(), page = frame;
  page.width = 3 * kWidth;
  page.height = 3 * kHeight;
  page.data.assign(static_cast<std::size_t>(page.width) * page.height * 3, 0);
  const std::array<Pose2, 3> places = {Pose2{-1.8, -1.2, 0}, Pose2{0.7, -0.3, 0},
                                       Pose2{1.2, 0.6, 1.2}};
  const std::array<const char*, 3> cameras = {"chase", "top", "side"};
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      room.Put(places[row], row == 2 ? 0.1 : 0, row == 2 ? 1.2 : 0);
      dut.Render(room.data(), First(cameras[column], room, places[row]), nullptr, frame);
      for (int y = 0; y < kHeight; ++y) {
        std::copy_n(
            Pixel(frame, 0, y), 3 * kWidth,
            page.data.begin() +
                (static_cast<std::ptrdiff_t>(row * kHeight + y) * page.width + column * kWidth) *
                    3);
      }
    }
  }
  const auto path = std::filesystem::path(::testing::TempDir()) / "contact_sheet.png";
  WritePng(path, page);
  const Image back = ReadImage(path);
  EXPECT_EQ(back.data, page.data);
  // No two of the nine are alike.
  for (int a = 0; a < 9; ++a) {
    for (int b = 0; b < a; ++b) {
      int different = 0;
      for (int y = 0; y < kHeight; y += 2) {
        for (int x = 0; x < kWidth; x += 2) {
          const std::uint8_t* p = Pixel(back, a % 3 * kWidth + x, a / 3 * kHeight + y);
          const std::uint8_t* q = Pixel(back, b % 3 * kWidth + x, b / 3 * kHeight + y);
          different += std::abs(p[0] - q[0]) > 12;
        }
      }
      EXPECT_GT(different, 50) << a << " and " << b;
    }
  }
}

}  // namespace
}  // namespace floorproof
