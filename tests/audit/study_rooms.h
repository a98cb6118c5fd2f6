// SPDX-License-Identifier: Apache-2.0
// Rooms like those of trials 1a and 1b of "audit-sampling" (section 6.1): 4.5 m x 4.5 m, with few
// obstacles and with more. The paper shows them in photographs alone; these are drawn by chance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/streams.h"
#include "env/geometry/geometry.h"

namespace floorproof::testing {

enum class Trial { k1a, k1b };

struct StudyRoom {
  std::string rows;  // a site's grid, the highest row first, walls around
  Vec2 start_W = Vec2::Zero();
};

inline constexpr double kStudyCell_m = 0.15;
inline constexpr int kStudyCells = 30;  // along a side of the room, within its walls

namespace study {

struct Piece {
  int x, y, width, height;  // cells, from the room's lower left corner
};

// Between two pieces, and between a piece and a wall that it does not touch, there is room for the
// cleaning robot (StudyScenario): so all free floor is connected.
inline bool Fits(const Piece& piece, const std::vector<Piece>& others) {
  constexpr int kGap = 3;
  const auto off_walls = [](int low, int length) {
    const int high = kStudyCells - low - length;
    return (low == 0 || low >= kGap) && (high == 0 || high >= kGap);
  };
  if (!off_walls(piece.x, piece.width) || !off_walls(piece.y, piece.height)) return false;
  for (const Piece& p : others)
    if (piece.x < p.x + p.width + kGap && p.x < piece.x + piece.width + kGap &&
        piece.y < p.y + p.height + kGap && p.y < piece.y + piece.height + kGap)
      return false;
  return true;
}

}  // namespace study

// 1a has two to four pieces of furniture, 1b six to nine, of 0.45 m to 1.2 m a side; half of them
// and more stand along walls. Draws from Stream(seed, 0, "study_room_1a") or "study_room_1b".
inline StudyRoom DrawStudyRoom(Trial trial, std::uint64_t seed) {
  Stream random(seed, 0, trial == Trial::k1a ? "study_room_1a" : "study_room_1b");
  const auto below = [&random](int n) {
    return static_cast<int>(random.Below(static_cast<std::uint64_t>(n)));
  };
  const int wanted = trial == Trial::k1a ? 2 + below(3) : 6 + below(4);
  std::vector<study::Piece> pieces;
  constexpr int kTries = 2000;  // a full room ends with fewer pieces
  for (int i = 0; i < kTries && static_cast<int>(pieces.size()) < wanted; ++i) {
    study::Piece p{0, 0, 4 + below(trial == Trial::k1a ? 5 : 4), 3 + below(3)};
    if (below(2)) std::swap(p.width, p.height);
    p.x = below(kStudyCells - p.width + 1), p.y = below(kStudyCells - p.height + 1);
    switch (below(8)) {  // half of them are moved to a wall
      case 0:
        p.x = 0;
        break;
      case 1:
        p.y = 0;
        break;
      case 2:
        p.x = kStudyCells - p.width;
        break;
      case 3:
        p.y = kStudyCells - p.height;
        break;
      default:
        break;
    }
    if (study::Fits(p, pieces)) pieces.push_back(p);
  }
  const auto free = [&pieces](int x, int y) {
    for (const study::Piece& p : pieces)
      if (x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height) return false;
    return x >= 0 && y >= 0 && x < kStudyCells && y < kStudyCells;
  };
  StudyRoom room;
  for (int y = kStudyCells; y >= -1; --y) {
    for (int x = -1; x <= kStudyCells; ++x) room.rows += free(x, y) ? '.' : '#';
    room.rows += '\n';
  }
  // In the middle of nine free cells.
  const auto fits = [&free](int x, int y) {
    for (int k = 0; k < 9; ++k)
      if (!free(x + k % 3 - 1, y + k / 3 - 1)) return false;
    return true;
  };
  int x = 0, y = 0;
  do x = below(kStudyCells), y = below(kStudyCells);
  while (!fits(x, y));
  room.start_W = kStudyCell_m * Vec2(x + 1.5, y + 1.5);
  return room;
}

// The cleaning robot: BELUGA's base and the planner `boustrophedon` without laps along walls, with
// two keys of its plan. The paper's is "a commercial cleaning robot" of which it states nothing.
// Assumed: a brush half as wide as the body, as household robots have them, and 4 cm kept from
// walls. So 13 cm along a wall are never swept; the bundled disc, 0.30 m wide and with no margin in
// rooms this small, would leave 3 cm, less than the nose of an audit robot gets to.
inline constexpr const char* kStudyCleaner = ", tool_width_m: 0.17, radius_m: 0.22";
inline constexpr const char* kBundledCleaner = "";

// `cleaner`: more keys of its plan.
inline std::string StudyScenario(const StudyRoom& room, const std::string& cleaner) {
  std::string rows;
  for (const char c : room.rows) {
    if (rows.empty() || rows.back() == '\n') rows += "      ";
    rows += c;
  }
  return "scenario: 1\nsite:\n  site: 1\n  name: study\n  grid:\n    cell_m: " +
         std::to_string(kStudyCell_m) + "\n    rows: |\n" + rows +
         "  start: {x_m: " + std::to_string(room.start_W.x()) +
         ", y_m: " + std::to_string(room.start_W.y()) +
         ", yaw_deg: 0}\nrobot: beluga\nplan: {planner: boustrophedon" + cleaner + "}\n";
}

}  // namespace floorproof::testing
