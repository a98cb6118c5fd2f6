// SPDX-License-Identifier: Apache-2.0
#include "render/cell_film.h"

#include "base/error.h"
#include "render/cell_stage.h"

namespace floorproof {

FilmResult WriteCellFilm(const CellFilmScript& script, const ReelOptions& options,
                         const std::filesystem::path& path) {
  CheckReel(options);
  if (script.steps.empty()) throw InternalError("there are no steps to film");
  const double begin_s = script.steps.front().t_s, end_s = script.steps.back().t_s;
  FilmMoments moments{
      .frames = ScheduleFilm(begin_s, end_s, {}, options.pace), .end_s = end_s, .failure_s = {}};
  CellStage stage(script, options.width, options.height);
  return WriteReel(
      moments, options,
      [&](const FilmFrame& frame, bool last) -> const Image& { return stage.Draw(frame, last); },
      path);
}

}  // namespace floorproof
