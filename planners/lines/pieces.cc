// SPDX-License-Identifier: Apache-2.0
#include "planners/lines/pieces.h"

#include <algorithm>

namespace floorproof {

std::vector<Polyline> WorkingPieces(const Floor& floor, const Polyline& path, double share,
                                    Swept& swept) {
  std::vector<Polyline> pieces;
  Polyline piece;
  const auto finish = [&] {
    if (piece.size() > 1) pieces.push_back(piece);
    piece.clear();
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    const int lost = swept.Remove(path[i - 1], path[i]);
    if (lost <= share * length * floor.tool_width) {
      finish();
      continue;
    }
    swept.Add(path[i - 1], path[i]);
    if (piece.empty()) piece.push_back(path[i - 1]);
    piece.push_back(path[i]);
  }
  finish();
  return pieces;
}

void CutBeside(const Floor& floor, const std::vector<Polyline>& lines, double reach,
               std::vector<Polyline>& pieces) {
  for (const Polyline& line : lines)
    for (const Vec2& end : {line.front(), line.back()}) {
      double best = reach;
      std::size_t which = 0, segment = 0;
      for (std::size_t p = 0; p < pieces.size(); ++p)
        for (std::size_t i = 1; i < pieces[p].size(); ++i) {
          const double d = DistanceToSegment(pieces[p][i - 1], pieces[p][i], end);
          if (d < best) best = d, which = p, segment = i;
        }
      if (best >= reach) continue;
      Polyline& piece = pieces[which];
      const Vec2 a = piece[segment - 1], b = piece[segment];
      const Vec2 at = a + NearestFraction(a, b, end) * (b - a);
      const double width = floor.tool_width;
      if ((at - piece.front()).norm() < width || (at - piece.back()).norm() < width) continue;
      if (!floor.Sees(at, end)) continue;
      Polyline rest = {at};
      rest.insert(rest.end(), piece.begin() + static_cast<std::ptrdiff_t>(segment), piece.end());
      piece.resize(segment);
      if ((piece.back() - at).norm() > 0) piece.push_back(at);
      pieces.push_back(std::move(rest));
    }
}

}  // namespace floorproof
