// SPDX-License-Identifier: Apache-2.0
// Every hazard as its plug-in makes it, in the pictures that users get.
#include <array>
#include <map>
#include <string>
#include <utility>

#include "run/scenario/scenario.h"
#include "tests/render/room.h"
#include "tests/run/scenario_text.h"

namespace floorproof {
namespace {

constexpr int kWidth = 480, kHeight = 270;

class HazardPictures : public ScenarioTest {
 protected:
  HazardPictures() { Save("plan.csv", "x_m,y_m\n1.5,2.5\n7,2.5\n"); }

  // The room with this hazard in it as this camera sees it, drawn once: most tests compare with the
  // room without any.
  const Image& Picture(const std::string& hazard, const std::string& camera) const {
    static std::map<std::pair<std::string, std::string>, Image> drawn;
    const std::pair key(hazard, camera);
    if (!drawn.contains(key)) drawn.emplace(key, Picture(hazard, View(camera)));
    return drawn.at(key);
  }
  // The robot is 0.75 m before x = 4 m.
  Image Picture(const std::string& hazard, const CameraView& view) const {
    const Scenario s = Read(RoomScenario(hazard));
    const Scene scene = BuildScene(s.world.site.map, s.world.robot, s.world.physics, kRobot);
    const DataPtr data = MakeData(scene.model.get());
    PoseForPicture(scene.model.get(), data.get());
    OffscreenRenderer renderer(scene.model.get(), kWidth, kHeight);
    Image image = renderer.MakeImage();
    renderer.Render(data.get(), view, nullptr, image);
    return image;
  }
  static CameraView View(const std::string& camera) {
    const auto made = MakePlugin(Cameras(), camera, "camera");
    made->Reset({{0.5, 0.5}, {8.5, 4.5}, 0.18, double{kWidth} / kHeight}, kRobot);
    return made->Next(kRobot, {1.0 / 30, 1});
  }
  static constexpr Pose2 kRobot{3.25, 2.5, 0};
};

struct Seen {
  int pixels = 0;            // that differ by more than an eye would miss
  int dark = 0, bright = 0;  // of them, those a quarter darker, or brighter
};
Seen Compare(const Image& with, const Image& without) {
  Seen seen;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      seen.pixels += Difference(with, without, x, y) >= 16;
      seen.dark += Luma(with, x, y) < 0.75 * Luma(without, x, y);
      seen.bright += Luma(with, x, y) > 1.25 * Luma(without, x, y);
    }
  return seen;
}

constexpr const char* kStrip = "polygon_m: [[4, 1], [4.6, 1], [4.6, 4], [4, 4]]}";
constexpr const char* kLine = "line_m: [[4, 1], [4, 4]]}";
const std::array<std::pair<const char*, std::string>, 13> kHazards = {{
    {"glass", std::string("{type: glass, height_m: 0.6, thickness_m: 0.01, ") + kLine},
    {"step", std::string("{type: step, height_m: 0.02, ") + kStrip},
    {"drop", std::string("{type: step, height_m: -0.15, ") + kStrip},
    {"groove", std::string("{type: groove, width_m: 0.06, depth_m: 0.05, ") + kLine},
    {"cable_cover", std::string("{type: cable_cover, height_m: 0.02, ") + kLine},
    {"rough", std::string("{type: rough, amplitude_m: 0.01, ") + kStrip},
    {"blind_object", std::string("{type: blind_object, height_m: 0.3, ") + kStrip},
    {"threshold", std::string("{type: threshold, ") + kLine},
    {"carpet", std::string("{type: carpet, ") + kStrip},
    {"lift_sill", std::string("{type: lift_sill, level_m: 0.01, ") + kStrip},
    {"ramp", std::string("{type: ramp, slope_deg: 8, ") + kStrip},
    {"ramp_down", std::string("{type: ramp, slope_deg: -8, ") + kStrip},
    {"wet", std::string("{type: wet, ") + kStrip},
}};

class EveryHazard : public HazardPictures,
                    public ::testing::WithParamInterface<
                        std::tuple<std::pair<const char*, std::string>, const char*>> {};

// Against the same room without it, a hazard near the robot takes some hundred pixels.
TEST_P(EveryHazard, IsSeenAtAGlance) {
  FP_NEED_GL();
  const auto& [hazard, camera] = GetParam();
  const Seen seen = Compare(Picture(hazard.second, camera), Picture("", camera));
  EXPECT_GT(seen.pixels, kWidth * kHeight / 500);
}
INSTANTIATE_TEST_SUITE_P(All, EveryHazard,
                         ::testing::Combine(::testing::ValuesIn(kHazards),
                                            ::testing::Values("side", "chase")),
                         [](const auto& suite) {
                           return std::string(std::get<0>(suite.param).first) + "_" +
                                  std::get<1>(suite.param);
                         });

TEST_F(HazardPictures, AGrooveAndADropAreDarkerThanTheFloor) {
  FP_NEED_GL();
  for (const char* camera : {"side", "chase"}) {
    for (const auto& [name, hazard] : kHazards) {
      if (hazard.find("groove") == std::string::npos && hazard.find("-0.15") == std::string::npos)
        continue;
      const Seen seen = Compare(Picture(hazard, camera), Picture("", camera));
      EXPECT_GT(seen.dark, kWidth * kHeight / 500) << name << " " << camera;
      EXPECT_LT(seen.bright, seen.dark / 10) << name << " " << camera;
    }
  }
}

// A dark box on the light floor keeps 20-90 % of its contrast behind the pane that stands before
// it.
TEST_F(HazardPictures, GlassLetsThroughAShareOfWhatIsBehind) {
  FP_NEED_GL();
  const std::string box =
      "{type: blind_object, height_m: 0.02, polygon_m: [[5, 2.5], [6, 2.5], [6, 4], [5, 4]]}";
  const std::string pane = kHazards[0].second;
  CameraView view;
  view.eye_W = {2.5, 2.5, 0.8};
  view.target_W = {5.5, 2.5, 0.02};
  const auto contrast = [&](const Image& image) {
    return std::abs(Luma(image, kWidth / 2 - 20, kHeight / 2) -
                    Luma(image, kWidth / 2 + 20, kHeight / 2));
  };
  const double clear = contrast(Picture(box, view));
  const double through = contrast(Picture(box + ", " + pane, view));
  ASSERT_GT(clear, 30);
  EXPECT_GT(through, 0.2 * clear);
  EXPECT_LT(through, 0.9 * clear);
}

// Looked at along its line, a cover shows its trapezoid: each row of pixels as wide as it is there.
TEST_F(HazardPictures, ACableCoverShowsItsProfile) {
  FP_NEED_GL();
  CameraView view;  // along +y, at the height of the floor
  view.eye_W = {4, 0.6, 0.02};
  view.target_W = {4, 3, 0.02};
  view.orthographic = true;
  view.height_m = 0.2;
  const std::string cover =
      "{type: cable_cover, height_m: 0.04, width_m: 0.20, top_width_m: 0.08, line_m: [[4, 1], [4, "
      "4]]}";
  const Image with = Picture(cover, view), without = Picture("", view);
  const double pixel_m = view.height_m / kHeight;
  const auto width_at = [&](double z_m) {
    const int y = static_cast<int>(kHeight / 2.0 - (z_m - 0.02) / pixel_m);
    int n = 0;
    for (int x = 0; x < kWidth; ++x) n += Difference(with, without, x, y) > 8;
    return n * pixel_m;
  };
  for (const double z_m : {0.005, 0.015, 0.025, 0.035})
    EXPECT_NEAR(width_at(z_m), 0.20 - 0.12 * z_m / 0.04, 0.012) << z_m;
  EXPECT_LT(width_at(0.043), 0.01);
}

}  // namespace
}  // namespace floorproof
