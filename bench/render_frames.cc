// SPDX-License-Identifier: Apache-2.0
// Frames a second of OffscreenRenderer with overlay, against a bare mjv_updateScene + mjr_render +
// mjr_readPixels loop over the same scene, size, quality and camera, taken in turns so that both
// see the same machine. Encoding is reported apart. Usage: render_frames [WIDTH HEIGHT ROUNDS
// [MODEL.xml]]
#include <mujoco/mujoco.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "render/gl_context.h"
#include "render/overlay.h"
#include "render/renderer.h"
#include "tests/render/scene.h"

namespace floorproof {
namespace {

constexpr int kFramesARound = 10;

double Median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

template <class F>
double Seconds(F&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

mjModel* Load(const char* file) {
  char error[1000] = "";
  mjSpec* spec = file != nullptr
                     ? mj_parseXML(file, nullptr, error, sizeof error)
                     : mj_parseXMLString(RoomMjcf().c_str(), nullptr, error, sizeof error);
  mjModel* model = spec == nullptr ? nullptr : mj_compile(spec, nullptr);
  if (model == nullptr) {
    std::fprintf(stderr, "%s\n", spec == nullptr ? error : mjs_getError(spec));
    std::exit(2);
  }
  mj_deleteSpec(spec);
  return model;
}

// MuJoCo's own calls and nothing else.
class BareLoop {
 public:
  BareLoop(const mjModel* model, int width, int height)
      : context_(MakeGlContext()), model_(model), width_(width), height_(height) {
    mjv_defaultOption(&option_);
    mjv_defaultFreeCamera(model, &camera_);
    camera_.elevation = -38;
    camera_.distance = 2.2;
    mjv_defaultScene(&scene_);
    mjv_makeScene(model, &scene_, static_cast<int>(model->ngeom) + 64);
    mjr_defaultContext(&draw_);
    mjModel sized = *model;
    sized.vis.global.offwidth = width;
    sized.vis.global.offheight = height;
    mjr_makeContext(&sized, &draw_, mjFONTSCALE_50);
    mjr_setBuffer(mjFB_OFFSCREEN, &draw_);
    rgb_.resize(static_cast<std::size_t>(width) * height * 3);
  }
  void Frame(mjData* data) {
    context_->MakeCurrent();
    const mjrRect whole = {0, 0, width_, height_};
    mjv_updateScene(model_, data, &option_, nullptr, &camera_, mjCAT_ALL, &scene_);
    mjr_render(whole, &scene_, &draw_);
    mjr_readPixels(rgb_.data(), nullptr, whole, &draw_);
  }
  // The same view, for the renderer.
  CameraView View() const {
    const mjvGLCamera& camera = scene_.camera[0];
    CameraView view;
    view.eye_W = Vec3(camera.pos[0], camera.pos[1], camera.pos[2]);
    view.target_W = view.eye_W + camera_.distance *
                                     Vec3(camera.forward[0], camera.forward[1], camera.forward[2]);
    view.fovy_rad = model_->vis.global.fovy * kPi / 180;
    return view;
  }

 private:
  std::unique_ptr<GlContext> context_;
  const mjModel* model_;
  int width_, height_;
  mjvOption option_;
  mjvCamera camera_;
  mjvScene scene_;
  mjrContext draw_;
  std::vector<unsigned char> rgb_;
};

int Main(int argc, char** argv) {
  const int width = argc > 2 ? std::atoi(argv[1]) : 1280,
            height = argc > 2 ? std::atoi(argv[2]) : 720;
  const int rounds = argc > 3 ? std::max(1, std::atoi(argv[3])) : 15;
  mjModel* model = Load(argc > 4 ? argv[4] : nullptr);
  mjData* data = mj_makeData(model);
  PoseForPicture(model, data);

  BareLoop bare(model, width, height);
  bare.Frame(data);
  OffscreenRenderer ours(model, width, height);
  Image image = ours.MakeImage();
  const CameraView view = bare.View();
  const std::filesystem::path film = std::filesystem::temp_directory_path() / "render_frames.mp4";
  const auto video = OpenVideo(film, width, height, 30);

  std::vector<double> bare_s, ours_s, encode_s;
  double t_s = 0;
  const auto move = [&] {
    t_s += 1.0 / 30;
    if (model->nq > 0) data->qpos[0] = 0.3 * t_s - std::floor(0.3 * t_s);
    PoseForPicture(model, data);
  };
  for (int round = 0; round < rounds; ++round) {
    bare_s.push_back(Seconds([&] {
      for (int i = 0; i < kFramesARound; ++i) {
        move();
        bare.Frame(data);
      }
    }));
    ours_s.push_back(Seconds([&] {
      for (int i = 0; i < kFramesARound; ++i) {
        move();
        ours.Render(data, view, nullptr, image);
        DrawOverlay({"benchmark", t_s, 0.5, 10, nullptr}, image);
      }
    }));
    encode_s.push_back(Seconds([&] { video->Add(image); }));
  }
  video->Close();
  std::filesystem::remove(film);
  const double bare_fps = kFramesARound / Median(bare_s), ours_fps = kFramesARound / Median(ours_s);
  std::printf(
      "%d x %d, %d geoms, %d samples, shadow map %d, %s, medians of %d rounds of %d frames\n",
      width, height, static_cast<int>(model->ngeom), model->vis.quality.offsamples,
      model->vis.quality.shadowsize, ProbeGl().renderer.c_str(), rounds, kFramesARound);
  std::printf("bare mjr loop          %7.1f frames/s\n", bare_fps);
  std::printf("renderer and overlay   %7.1f frames/s   ratio %.3f (target 0.9)\n", ours_fps,
              ours_fps / bare_fps);
  std::printf("encoding, apart        %7.2f ms a frame\n", 1e3 * Median(encode_s));
  mj_deleteData(data);
  mj_deleteModel(model);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
