// SPDX-License-Identifier: Apache-2.0
// A descent on  worth * width * (length + kBend * width * bends) - ground swept.  A point moves one
// step to the best of its eight neighbours, or a leg moves aside with both its ends. So a row that
// lies half on its neighbour slides off it, and a link between two rows draws back to where the
// rows are needed. The steps become finer, and `worth` rises with them to what is asked, so that
// the cheapest ground is given up first. What did not move and has no neighbour that did is not
// looked at again before the next step. Long legs keep their direction. Not done: changing the
// order of the points, or their number (prune.h does that).
#include "planners/lines/relax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace floorproof {
namespace {

constexpr double kLeast = 0.5;       // ground cells: less is not worth a move
constexpr double kBlocked = -1;      // ground cells: about what a step into a wall would lose
constexpr double kMostRows = 0.3e6;  // of the grid, looked at in one call before the last pass
constexpr int kMostSteps = 8;        // of a point or leg in one pass
// What a bend costs, in tool widths of length; less where it is gentler than what counts as a turn.
constexpr double kBend = 0.1, kTurn = 0.2126;  // tan 12 deg

constexpr double kLong = 6;       // tool widths: a longer leg is not turned
constexpr double kTurned = 0.02;  // cells, of its end

class Relaxer {
 public:
  Relaxer(const Floor& floor, double goal_cells, Polyline& path, Swept& swept)
      : floor_(floor), goal_cells_(goal_cells), path_(path), swept_(swept), exchange_(swept) {}

  void Settle(double step, double worth) {
    rate_ = worth * floor_.tool_width;
    awake_.assign(path_.size(), 1);
    while (Pass(step) && looked_ < kMostRows) {
    }
  }

 private:
  // True when something moved.
  bool Pass(double step) {
    bool any = false;
    next_awake_.assign(path_.size(), 0);
    for (std::size_t i = 1; i < path_.size(); ++i) {
      if (!awake_[i]) continue;
      const bool point = MovePoint(i, step), leg = MoveLeg(i, step);
      if (!point && !leg) continue;
      any = true;
      const std::size_t last = std::min(i + 3, path_.size() - 1);
      for (std::size_t k = i - 1; k <= last; ++k) next_awake_[k] = 1;
    }
    awake_.swap(next_awake_);
    return any;
  }

  bool IsLong(const Vec2& leg) const { return leg.norm() > kLong * floor_.tool_width; }

  // The leg before point i or the one behind it, whichever is long; the first if both are, or none.
  Vec2 LongerSide(std::size_t before, std::size_t behind) const {
    const Vec2 first = path_[before] - path_[before - 1];
    if (IsLong(first) || behind + 1 >= path_.size()) return first;
    const Vec2 second = path_[behind + 1] - path_[behind];
    return IsLong(second) ? second : first;
  }

  // Along the leg that ends there, or a long one that begins there, across it, or both.
  bool MovePoint(std::size_t i, double step) {
    const Vec2 leg = LongerSide(i, i);
    const double length = leg.norm();
    const Vec2 along = length > 0 ? Vec2(step / length * leg) : Vec2(step, 0);
    return Move(i, i, along, {-along.y(), along.x()});
  }

  // The leg from point i on: along a long leg beside it, or across itself.
  bool MoveLeg(std::size_t i, double step) {
    if (i + 1 >= path_.size()) return false;
    const Vec2 leg = path_[i + 1] - path_[i];
    const double length = leg.norm();
    if (length < 1) return false;
    const Vec2 beside = LongerSide(i, i + 1);
    return Move(i, i + 1,
                IsLong(beside) && !IsLong(leg) ? Vec2(step / beside.norm() * beside)
                                               : Vec2(step / length * Vec2(-leg.y(), leg.x())),
                Vec2::Zero());
  }

  // Moves the points from .. to by +-u, +-v (if that is not zero), or one of both, whatever is
  // best, as often as that is better than to stay.
  bool Move(std::size_t from, std::size_t to, const Vec2& u, const Vec2& v) {
    const std::size_t first = from - 1, last = std::min(to + 1, path_.size() - 1);
    const std::span<Vec2> chain(&path_[first], last - first + 1);
    std::array<Vec2, Swept::Exchange::kMaxLegs + 1> kept;
    const std::span<Vec2> old(kept.data(), chain.size());
    std::copy(chain.begin(), chain.end(), old.begin());
    const double old_cost = Cost(first, last), rows = Rows(old);
    exchange_.Begin(old);
    looked_ += rows;

    const auto shift = [&](const Vec2& by) {
      for (std::size_t i = from; i <= to; ++i) path_[i] = old[i - first] + by;
    };
    double best = kLeast;
    Vec2 best_shift = Vec2::Zero();
    // What is gained; kBlocked where it may not be done.
    const auto look = [&](const Vec2& by) {
      shift(by);
      if (TurnsLongLeg(old, chain) || !Free(chain)) return kBlocked;
      looked_ += rows;
      const int won = exchange_.Won(chain);
      if (won < 0 && swept_.swept_cells() + won < goal_cells_) return kBlocked;
      const double gain = rate_ * (old_cost - Cost(first, last)) + won;
      if (gain > best) best = gain, best_shift = by;
      return gain;
    };
    const double gain_u[2] = {look(u), look(-u)};
    if (v != Vec2::Zero()) {
      const double gain_v[2] = {look(v), look(-v)};
      for (const int i : {0, 1})
        for (const int k : {0, 1})
          if (gain_u[i] + gain_v[k] > kLeast)
            look(std::sqrt(0.5) * Vec2((i == 0 ? 1 : -1) * u + (k == 0 ? 1 : -1) * v));
    }
    const bool better = best > kLeast;
    if (better) {
      const Vec2 way = best_shift;
      for (int steps = 2; steps <= kMostSteps; ++steps) {
        const double before = best;
        if (look(steps * way) <= before) break;
      }
    }
    std::copy(old.begin(), old.end(), chain.begin());
    if (!better) return false;
    for (std::size_t i = 1; i < chain.size(); ++i) swept_.Remove(chain[i - 1], chain[i]);
    shift(best_shift);
    for (std::size_t i = 1; i < chain.size(); ++i) swept_.Add(chain[i - 1], chain[i]);
    return true;
  }

  // Of the grid, under a chain: what it costs to look at it.
  double Rows(std::span<const Vec2> chain) const {
    double rows = 0;
    for (std::size_t i = 1; i < chain.size(); ++i)
      rows += std::abs(chain[i].y() - chain[i - 1].y()) + 2 * floor_.tool_reach;
    return rows;
  }

  // Rows stay straight: a robot that drives beside a wall or another row drives along it.
  bool TurnsLongLeg(std::span<const Vec2> old, std::span<const Vec2> fresh) const {
    for (std::size_t i = 1; i < old.size(); ++i) {
      const Vec2 was = old[i] - old[i - 1], is = fresh[i] - fresh[i - 1];
      if (IsLong(was) && std::abs(Cross(was, is)) > kTurned * was.norm()) return true;
    }
    return false;
  }

  bool Free(std::span<const Vec2> chain) const {
    for (std::size_t i = 1; i < chain.size(); ++i)
      if (!floor_.Sees(chain[i - 1], chain[i])) return false;
    return true;
  }

  // Length from the point `first` to the point `last`, with the bends at both and between them.
  double Cost(std::size_t first, std::size_t last) const {
    double length = 0, bends = 0;
    for (std::size_t i = first; i < last; ++i) length += (path_[i + 1] - path_[i]).norm();
    const std::size_t end = std::min(last + 1, path_.size() - 1);
    for (std::size_t i = std::max<std::size_t>(first, 1); i < end; ++i) {
      const Vec2 before = path_[i] - path_[i - 1], after = path_[i + 1] - path_[i];
      const double ahead = before.dot(after), aside = std::abs(Cross(before, after));
      bends += aside >= kTurn * ahead ? 1 : aside / ahead / kTurn;
    }
    return length + kBend * floor_.tool_width * bends;
  }

  const Floor& floor_;
  const double goal_cells_;
  Polyline& path_;
  Swept& swept_;
  Swept::Exchange exchange_;
  double looked_ = 0;                     // rows of the grid
  double rate_ = 0;                       // ground cells that a cell of length must sweep
  std::vector<char> awake_, next_awake_;  // by point: it and the leg from it on
};

}  // namespace

void Relax(const Floor& floor, const RelaxOptions& options, Polyline& path, Swept& swept) {
  if (path.size() < 2) return;
  Relaxer relaxer(floor, options.goal_cells, path, swept);
  for (double step = options.coarsest; step >= options.finest; step /= 2)
    relaxer.Settle(step, options.worth / (0.5 + step));
}

}  // namespace floorproof
