// SPDX-License-Identifier: Apache-2.0
// From moments to a film and its stills, whatever it is that is drawn.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "media/media.h"
#include "render/film_schedule.h"

namespace floorproof {

// What all films are told of how they are to be.
struct ReelOptions {
  int width = 960, height = 540;  // even
  FilmPace pace;
  std::function<void(int done, int all)> on_frame;  // after each
  // Where frame_start.png, frame_failure.png (the first event that is shown) and frame_end.png go;
  // none: nowhere.
  std::optional<std::filesystem::path> stills;
};

struct FilmResult {
  int frames = 0;
  double fps = 0;
  std::vector<double> t_s{};          // which moment each frame shows
  double render_s = 0, encode_s = 0;  // wall time: picture and overlay; writing the film
};

// Throws InputError where no film can be so.
void CheckReel(const ReelOptions& options);

// Draws a moment; `last`: the end of what was recorded. The picture stands until the next call.
using DrawFrame = std::function<const Image&(const FilmFrame& frame, bool last)>;

struct FilmMoments {
  std::vector<FilmFrame> frames;    // at least one
  double end_s = 0;                 // of what was recorded
  std::optional<double> failure_s;  // of frame_failure.png

  // Whether the frame's picture is the one before it, at the film's end.
  bool Stands(std::size_t i) const;
  std::vector<FilmFrame> Drawn() const;  // those that do not stand
};

// Writes an MP4; a picture that stands is drawn once. Throws InputError (a file that cannot be
// written).
FilmResult WriteReel(const FilmMoments& moments, const ReelOptions& options, const DrawFrame& draw,
                     const std::filesystem::path& path);

}  // namespace floorproof
