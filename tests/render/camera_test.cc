// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floorproof {
namespace {

constexpr double kDt = 1.0 / 30;

double Azimuth(const CameraView& view) {
  const Vec3 d = view.target_W - view.eye_W;
  return std::atan2(d.y(), d.x());
}

TEST(CameraTest, EachSeesTheRobotAndStaysAboveTheFloor) {
  const FilmSet set{{0, 0}, {8, 6}, 0.2, 16.0 / 9};
  for (const auto& entry : Cameras()) {
    const auto dut = entry.make();
    dut->Reset(set, {1, 1, 0});
    for (int i = 0; i < 200; ++i) {
      const Pose2 X_WB{1 + 0.03 * i, 1 + 0.02 * i, 0.05 * i};
      const CameraView view = dut->Next(X_WB, {kDt, 1});
      const Vec3 forward = (view.target_W - view.eye_W).normalized();
      const Vec3 to_robot = (Vec3(X_WB.x_m, X_WB.y_m, 0.1) - view.eye_W).normalized();
      EXPECT_GT(view.eye_W.z(), 0.15) << entry.name;
      EXPECT_GT(forward.dot(to_robot), std::cos(0.5 * view.fovy_rad * set.aspect)) << entry.name;
      EXPECT_LT(std::abs(forward.dot(view.up_W)), 0.999) << entry.name;
    }
  }
}

// A turn on the spot, at once, moves the picture by a bounded rate.
TEST(CameraTest, ChaseTurnsSmoothly) {
  const auto dut = MakePlugin(Cameras(), "chase", "camera");
  dut->Reset({}, {});
  double last = Azimuth(dut->Next({}, {kDt, 1})), turned = 0;
  for (int i = 0; i < 300; ++i) {
    const double now = Azimuth(dut->Next({0, 0, 2.5}, {kDt, 1}));
    EXPECT_LT(std::abs(WrapAngle(now - last)), 60 * kPi / 180 * kDt);
    turned += WrapAngle(now - last);
    last = now;
  }
  EXPECT_NEAR(turned, 2.5, 0.1);
}

// In a time lapse a mowing robot turns about several times a second; the picture must not.
TEST(CameraTest, ChaseDoesNotSwingWithAMowingRobot) {
  const auto dut = MakePlugin(Cameras(), "chase", "camera");
  dut->Reset({}, {});
  double least = 0, most = 0;
  for (int i = 0; i < 600; ++i) {
    const double a = Azimuth(dut->Next({0, 0, i / 6 % 2 == 0 ? 0.0 : kPi}, {kDt, 1}));
    least = std::min(least, a);
    most = std::max(most, a);
  }
  EXPECT_LT(most - least, 25 * kPi / 180);
}

TEST(CameraTest, TopShowsAllOfASmallSiteAndStandsStill) {
  const FilmSet set{{0, 0}, {4, 3}, 0.2, 16.0 / 9};
  const auto dut = MakePlugin(Cameras(), "top", "camera");
  dut->Reset(set, {0.5, 0.5, 0});
  const CameraView a = dut->Next({0.5, 0.5, 0}, {kDt, 1}), b = dut->Next({3.5, 2.5, 0}, {kDt, 1});
  EXPECT_EQ(a.eye_W, b.eye_W);
  const double half = a.eye_W.z() * std::tan(0.5 * a.fovy_rad);
  EXPECT_GE(half, 1.5);
  EXPECT_GE(half * set.aspect, 2.0);
}

// A camera that follows swims in a time lapse: over a large site it stands, and seldom looks
// elsewhere.
TEST(CameraTest, TopStandsStillOverALargeSiteAndAlwaysSeesTheRobot) {
  const FilmSet set{{0, 0}, {60, 40}, 0.2, 16.0 / 9};
  const auto dut = MakePlugin(Cameras(), "top", "camera");
  dut->Reset(set, {1, 1, 0});
  int views = 0;
  std::optional<Vec3> last;
  // Rows over all of it, an aisle apart, 20 times as fast as in truth.
  for (double y = 1; y < 39.5; y += 0.5)
    for (double x = 1; x < 59.5; x += 0.2) {
      const CameraView view = dut->Next({x, y, 0}, {kDt, 20});
      const double half = view.eye_W.z() * std::tan(0.5 * view.fovy_rad);
      EXPECT_LT(std::abs(y - view.target_W.y()), half) << x << ", " << y;
      EXPECT_LT(std::abs(x - view.target_W.x()), half * set.aspect) << x << ", " << y;
      EXPECT_GT(view.target_W.x(), 4);
      EXPECT_LT(view.target_W.x(), 56) << "it does not look far beyond the site";
      views += last != view.target_W;
      last = view.target_W;
    }
  EXPECT_LE(views, 77 * 8) << "in 22,000 pictures";
}

TEST(CameraTest, AutoLooksFromAboveInATimeLapseAndFromBehindInRealTime) {
  const auto dut = MakePlugin(Cameras(), "auto", "camera");
  dut->Reset({{0, 0}, {6, 4}, 0.2, 16.0 / 9}, {1, 1, 0});
  const auto steepness = [](const CameraView& view) {
    return -(view.target_W - view.eye_W).normalized().z();
  };
  EXPECT_GT(steepness(dut->Next({1, 1, 0}, {kDt, 20})), 0.99);
  EXPECT_LT(steepness(dut->Next({1, 1, 0}, {kDt, 1})), 0.8);
  EXPECT_GT(steepness(dut->Next({1, 1, 0}, {kDt, 20})), 0.99);
}

// At what holds the robot: low, across its heading, from where there is floor; and however it turns
// then, the camera does not.
TEST(CameraTest, AutoLooksAtTheWheelsFromTheSideWhereTheyAreHeld) {
  const auto dut = MakePlugin(Cameras(), "auto", "camera");
  for (const double y : {0.4, 3.6}) {  // beside the lower wall, beside the upper one
    const Pose2 X_WB{3, y, 1.2};       // it came along x, whatever its heading
    dut->Reset({{0, 0}, {6, 4}, 0.2, 16.0 / 9}, X_WB);
    dut->Next(X_WB, {kDt, 20});
    const CameraView view = dut->Next(X_WB, {kDt, 1, 0.0});
    const Vec3 sight = (view.target_W - view.eye_W).normalized();
    EXPECT_LT(std::abs(sight.x()), 0.4);
    EXPECT_LT(std::abs(sight.z()), 0.3);
    EXPECT_EQ(view.eye_W.y() > y, y < 2) << "from the middle of the floor";
    EXPECT_LT((view.target_W - Vec3(3, y, 0)).norm(), 0.2);
    EXPECT_LT((view.eye_W - view.target_W).norm(), 1.5);
    CameraView turned;
    for (int i = 0; i < 60; ++i) turned = dut->Next({3, y, 2.0}, {kDt, 20, 0.0});
    EXPECT_LT(((turned.target_W - turned.eye_W).normalized() - sight).norm(), 1e-6);
    // Afterwards as if nothing had been.
    EXPECT_GT(
        -(dut->Next(X_WB, {kDt, 20}).target_W - dut->Next(X_WB, {kDt, 20}).eye_W).normalized().z(),
        0.99);
  }
}

TEST(CameraTest, UnknownNameListsTheKnown) {
  try {
    MakePlugin(Cameras(), "chse", "video.camera");
    ADD_FAILURE() << "made an unknown camera";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean chase"));
  }
}

}  // namespace
}  // namespace floorproof
