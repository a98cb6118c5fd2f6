// SPDX-License-Identifier: Apache-2.0
// An episode's film.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/console.h"
#include "render/film.h"
#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

// video.mp4 and frame_*.png; returns which file that is and how it went, in words. In the
// scenario's own size and pace and quality; `only_around` not empty: of the seconds around the
// first event of each of these modes, and small and quick unless the scenario says how good.
std::string WriteVideo(const Scenario& scenario, const Scene& scene, const PlanResult& plan,
                       const EpisodeRecord& record, const Recording& recording,
                       const std::vector<FailureMode>& only_around,
                       const std::filesystem::path& folder, const Console& console);
// Pictures of that film, as it looks at these times (ascending), of another size and by another
// camera. Throws InputError, InternalError.
std::vector<Image> DrivePictures(const Scenario& scenario, const Scene& scene,
                                 const PlanResult& plan, const EpisodeRecord& record,
                                 const Recording& recording, std::span<const double> t_s, int width,
                                 int height, const std::string& camera);
// Pictures of a drive that goes on, as it stands.
class LivePicture {
 public:
  // All outlive it; the recording, of a state at least, may grow. `beams`: of the robot's lidar.
  LivePicture(const Scenario& scenario, const Scene& scene, const PlanResult& plan,
              const Recording& recording, int beams, int width, int height,
              const std::string& camera, RenderQuality quality);
  // `events`: those so far. Stands until the next call.
  const Image& Draw(std::span<const Event> events) { return draw_(events); }

 private:
  std::function<const Image&(std::span<const Event>)> draw_;
};
// The same of `drive: cells`: from above, without physics or GL. Nothing fails there.
std::string WriteCellVideo(const Scenario& scenario, const EpisodeRecord& record,
                           const std::filesystem::path& folder, const Console& console);

}  // namespace floorproof
