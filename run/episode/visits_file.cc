// SPDX-License-Identifier: Apache-2.0
#include "run/episode/visits_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace floorproof {
namespace {

constexpr std::string_view kHead =
    "P5\n# passes of the tool, the top row first; 255: out of its reach\n# ";

}  // namespace

std::string VisitsPgm(const EpisodeRecord& record) {
  const GridFrame& frame = record.passes_frame;
  const Grid<std::uint8_t>& passes = record.passes;
  std::string pgm(kHead);
  pgm += fmt::format("cell_m {:.17g} x_m {:.17g} y_m {:.17g} yaw_rad {:.17g}\n{} {}\n255\n",
                     frame.cell_m, frame.X_WG.x_m, frame.X_WG.y_m, frame.X_WG.yaw_rad, passes.width,
                     passes.height);
  pgm.reserve(pgm.size() + passes.cells.size());
  for (int iy = passes.height - 1; iy >= 0; --iy)
    for (int ix = 0; ix < passes.width; ++ix)
      pgm +=
          static_cast<char>(record.sweepable(ix, iy) ? std::min<std::uint8_t>(passes(ix, iy), 254)
                                                     : Visits::kOutOfReach);
  return pgm;
}

std::optional<Visits> ReadVisits(std::string_view bytes) {
  if (!bytes.starts_with(kHead)) return std::nullopt;
  const std::string head(bytes.substr(kHead.size(), 200));
  Visits visits;
  Pose2& X_WG = visits.frame.X_WG;
  int width = 0, height = 0, read = 0;
  if (std::sscanf(head.c_str(), "cell_m %lg x_m %lg y_m %lg yaw_rad %lg\n%d %d\n255%n",
                  &visits.frame.cell_m, &X_WG.x_m, &X_WG.y_m, &X_WG.yaw_rad, &width, &height,
                  &read) != 6 ||
      read == 0)
    return std::nullopt;
  const std::string_view cells =
      bytes.substr(std::min(bytes.size(), kHead.size() + static_cast<std::size_t>(read) + 1));
  constexpr int kMost = 1 << 20;
  if (width < 1 || height < 1 || width > kMost || height > kMost ||
      cells.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) ||
      !(visits.frame.cell_m > 0) ||
      !std::isfinite(visits.frame.cell_m + X_WG.x_m + X_WG.y_m + X_WG.yaw_rad))
    return std::nullopt;
  visits.frame.width = width;
  visits.frame.height = height;
  visits.passes = Grid<std::uint8_t>(width, height);
  for (int row = 0; row < height; ++row)
    for (int ix = 0; ix < width; ++ix)
      visits.passes(ix, height - 1 - row) = static_cast<std::uint8_t>(
          cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(ix)]);
  return visits;
}

}  // namespace floorproof
