// SPDX-License-Identifier: Apache-2.0
#include "render/film_reel.h"

#include <chrono>

#include "base/error.h"
#include "base/interrupt.h"

namespace floorproof {
namespace {

double Seconds(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

void CheckReel(const ReelOptions& options) {
  if (options.width % 2 != 0 || options.height % 2 != 0 || options.width < 64 ||
      options.height < 64) {
    throw InputError("a film's width and height must be even and at least 64 pixels");
  }
  if (!(options.pace.fps > 0) || options.pace.fps > 240 || options.pace.max_frames < 2) {
    throw InputError("a film needs at least 2 frames, at most 240 a second");
  }
}

bool FilmMoments::Stands(std::size_t i) const {
  return i > 0 && frames[i].t_s == frames.back().t_s && frames[i - 1].t_s == frames[i].t_s;
}

std::vector<FilmFrame> FilmMoments::Drawn() const {
  std::vector<FilmFrame> drawn;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (!Stands(i)) drawn.push_back(frames[i]);
  return drawn;
}

FilmResult WriteReel(const FilmMoments& moments, const ReelOptions& options, const DrawFrame& draw,
                     const std::filesystem::path& path) {
  const std::vector<FilmFrame>& frames = moments.frames;
  const auto video = OpenVideo(path, options.width, options.height, options.pace.fps);
  const auto still = [&](const char* name, const Image& image) {
    if (options.stills) WritePng(*options.stills / name, image);
  };

  FilmResult result;
  const Image* image = nullptr;
  bool failure_shown = false;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (Interrupted()) return result;  // the unfinished film goes with `video`
    const FilmFrame& frame = frames[i];
    const bool ends = frame.t_s == frames.back().t_s, last = ends && frame.t_s == moments.end_s;
    const auto begin = std::chrono::steady_clock::now();
    if (!moments.Stands(i)) image = &draw(frame, last);
    result.render_s += Seconds(begin);

    if (i == 0) still("frame_start.png", *image);
    if (!failure_shown && moments.failure_s && (ends || frame.t_s >= *moments.failure_s - 1e-9)) {
      still("frame_failure.png", *image);
      failure_shown = true;
    }
    const auto encode = std::chrono::steady_clock::now();
    video->Add(*image);
    result.encode_s += Seconds(encode);
    if (options.on_frame)
      options.on_frame(static_cast<int>(i + 1), static_cast<int>(frames.size()));
  }
  still("frame_end.png", *image);
  video->Close();
  result.frames = static_cast<int>(frames.size());
  result.fps = options.pace.fps;
  for (const FilmFrame& frame : frames) result.t_s.push_back(frame.t_s);
  return result;
}

}  // namespace floorproof
