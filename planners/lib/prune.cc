// SPDX-License-Identifier: Apache-2.0
// A window of the path is replaced by the straight line between its ends, or a pair of corners is
// drawn in along its two legs, where the floor can be seen through and the ground lost is little
// against the length saved. Windows are tried again and again with rising tolerance, so that the
// cheapest losses come first.
#include "planners/lib/prune.h"

#include <algorithm>
#include <array>

namespace floorproof {
namespace {

constexpr std::size_t kWindow = 8;  // points

class Pruner {
 public:
  Pruner(const Floor& floor, const PruneOptions& options, Polyline& path, Swept& swept)
      : floor_(floor), options_(options), path_(path), swept_(swept) {}

  bool Round(double worth) {
    bool any = false;
    Polyline done = {path_.front()};
    // `todo` is what lies ahead, the next point last.
    Polyline todo(path_.rbegin(), path_.rend() - 1);
    while (!todo.empty()) {
      if (Cut(done, todo, worth)) {
        any = true;
        if (done.size() > 1) {  // look again from one point before
          todo.push_back(done.back());
          done.pop_back();
        }
        continue;
      }
      done.push_back(todo.back());
      todo.pop_back();
    }
    // The end: whatever comes after the last ground worth sweeping.
    while (done.size() > 1) {
      const Polyline tail = {done[done.size() - 2], done.back()};
      const int lost = swept_.Remove(tail);
      if (!Worthwhile(PolylineLength(tail), lost, worth)) {
        swept_.Add(tail);
        break;
      }
      done.pop_back();
      any = true;
    }
    path_ = std::move(done);
    return any;
  }

 private:
  bool Worthwhile(double saved, double lost, double worth) const {
    return saved > 0.5 && lost <= worth * saved * floor_.tool_width &&
           (lost <= 0 || swept_.swept_cells() >= options_.goal_cells);
  }

  bool Try(const Polyline& old, const Polyline& fresh, double worth) {
    const double saved = PolylineLength(old) - PolylineLength(fresh);
    if (saved <= 0.5) return false;
    for (std::size_t i = 1; i < fresh.size(); ++i)
      if (!floor_.Sees(fresh[i - 1], fresh[i])) return false;
    const int lost = swept_.Remove(old) - swept_.Add(fresh);
    if (Worthwhile(saved, lost, worth)) return true;
    swept_.Remove(fresh);
    swept_.Add(old);
    return false;
  }

  bool Cut(const Polyline& done, Polyline& todo, double worth) {
    Polyline old = {done.back()};
    for (std::size_t k = 0; k < kWindow && k < todo.size(); ++k) {
      old.push_back(todo[todo.size() - 1 - k]);
      if (k == 0) continue;
      if (Try(old, {old.front(), old.back()}, worth)) {
        todo.resize(todo.size() - k);
        return true;
      }
      if (k == 2 && DrawIn(old, todo, worth)) return true;
    }
    return false;
  }

  // old: a leg, a link and a leg back.
  bool DrawIn(const Polyline& old, Polyline& todo, double worth) {
    const Vec2 out = old[1] - old[0], back = old[3] - old[2];
    const double most = std::min(out.norm(), back.norm());
    if (most < 1 || out.dot(back) > -0.5 * out.norm() * back.norm()) return false;
    for (const double step : {2.0, 1.0, 0.5}) {
      const double by = step * floor_.tool_width;
      if (by >= most) continue;
      const Polyline fresh = {old[0], old[1] - by * out / out.norm(),
                              old[2] + by * back / back.norm(), old[3]};
      if (!Try(old, fresh, worth)) continue;
      todo[todo.size() - 1] = fresh[1];
      todo[todo.size() - 2] = fresh[2];
      return true;
    }
    return false;
  }

  const Floor& floor_;
  const PruneOptions& options_;
  Polyline& path_;
  Swept& swept_;
};

}  // namespace

void Prune(const Floor& floor, const PruneOptions& options, Polyline& path, Swept& swept) {
  if (path.size() < 2) return;
  Pruner pruner(floor, options, path, swept);
  for (const double part : {0.1, 0.4, 0.7, 1.0})
    for (int round = 0; round < 3 && pruner.Round(part * options.worth); ++round) {
    }
}

Polyline MergeStraight(const Polyline& path) {
  constexpr double kSame = 1e-6, kOff = 0.02;  // cells
  Polyline out;
  for (const Vec2& p : path) {
    if (!out.empty() && (p - out.back()).norm() < kSame) continue;
    while (out.size() >= 2 && DistanceToSegment(out[out.size() - 2], p, out.back()) < kOff)
      out.pop_back();
    out.push_back(p);
  }
  return out;
}

}  // namespace floorproof
