// SPDX-License-Identifier: Apache-2.0
// The room as a compiled model, and measures of pictures that tests share.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "env/core/path.h"
#include "media/media.h"
#include "render/gl_context.h"
#include "render/renderer.h"
#include "tests/render/scene.h"

// Skips the test where nothing can draw, saying why.
#define FP_NEED_GL()                                               \
  if (const auto gl = ::floorproof::ProbeGl(); gl.backend.empty()) \
  GTEST_SKIP() << "no OpenGL: " << (gl.failures.empty() ? std::string("?") : gl.failures.front())

namespace floorproof {

class Room {
 public:
  explicit Room(const RoomOptions& options = {}) {
    char error[500] = "";
    mjSpec* spec = mj_parseXMLString(RoomMjcf(options).c_str(), nullptr, error, sizeof error);
    EXPECT_NE(spec, nullptr) << error;
    model_.reset(mj_compile(spec, nullptr));
    EXPECT_NE(model_, nullptr) << mjs_getError(spec);
    mj_deleteSpec(spec);
    data_.reset(mj_makeData(model_.get()));
  }
  const mjModel* model() const { return model_.get(); }
  mjData* data() { return data_.get(); }
  int base() const { return mj_name2id(model(), mjOBJ_BODY, "base"); }
  void Put(const Pose2& X_WB, double z_m = 0, double pitch_rad = 0) {
    mjtNum yaw[4] = {std::cos(X_WB.yaw_rad / 2), 0, 0, std::sin(X_WB.yaw_rad / 2)};
    mjtNum pitch[4] = {std::cos(pitch_rad / 2), 0, std::sin(pitch_rad / 2), 0};
    data()->qpos[0] = X_WB.x_m;
    data()->qpos[1] = X_WB.y_m;
    data()->qpos[2] = z_m;
    mju_mulQuat(data()->qpos + 3, yaw, pitch);
    PoseForPicture(model(), data());
  }
  FilmSet Set() const { return {{-3.1, -2.1}, {3.1, 2.1}, 0.17, 16.0 / 9.0}; }

 private:
  struct Deleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<mjData, Deleter> data_;
};

inline const std::uint8_t* Pixel(const Image& image, int x, int y) {
  return image.data.data() + (static_cast<std::size_t>(y) * image.width + x) * image.channels;
}
inline double Luma(const Image& image, int x, int y) {
  const std::uint8_t* p = Pixel(image, x, y);
  return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}
// The largest difference of a channel.
inline int Difference(const Image& a, const Image& b, int x, int y) {
  int d = 0;
  for (int k = 0; k < 3; ++k) d = std::max(d, std::abs(Pixel(a, x, y)[k] - Pixel(b, x, y)[k]));
  return d;
}

inline Path Straight(const std::vector<Vec2>& points) {
  Path path;
  for (const Vec2& p_W : points) path.emplace_back().p_W = p_W;
  return path;
}

// A folder of the running test's own, removed with it.
class TestFolder {
 public:
  TestFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string(info->test_suite_name()) + "_" + info->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace floorproof
