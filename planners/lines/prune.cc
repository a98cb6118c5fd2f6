// SPDX-License-Identifier: Apache-2.0
// Two ways to shorten a path: a window of its points is replaced by the straight line between the
// window's ends, or the two corners of a detour are drawn in along its legs. Either is done where
// the floor allows it and the ground lost is little for the length saved. The path is gone through
// several times with rising tolerance, so that the cheapest losses come first.
// Not done: changing the order of what stays.
#include "planners/lines/prune.h"

#include <algorithm>
#include <array>

namespace floorproof {
namespace {

constexpr std::size_t kWindow = 8;    // points
constexpr double kLeastSaving = 0.5;  // cells

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
    return saved > kLeastSaving && lost <= worth * saved * floor_.tool_width &&
           (lost <= 0 || swept_.swept_cells() >= options_.goal_cells);
  }

  // Replaces the old part by `fresh` if that is worth it. `lost` cells became uncovered when the
  // old part was taken out.
  bool Accept(double old_length, int lost, const Polyline& fresh, double worth) {
    const double length = PolylineLength(fresh), saved = old_length - length;
    const double width = floor_.tool_width, most_back = (length + width) * width;
    if (saved <= kLeastSaving || lost - most_back > worth * saved * width) return false;
    for (std::size_t i = 1; i < fresh.size(); ++i)
      if (!floor_.Sees(fresh[i - 1], fresh[i])) return false;
    const int back = swept_.Add(fresh);
    if (Worthwhile(saved, lost - back, worth)) return true;
    swept_.Remove(fresh);
    return false;
  }

  // Looks at windows that begin at the last point done.
  bool Cut(const Polyline& done, Polyline& todo, double worth) {
    Polyline old = {done.back()};
    double length = 0;
    int lost = 0;
    for (std::size_t k = 0; k < kWindow && k < todo.size(); ++k) {
      old.push_back(todo[todo.size() - 1 - k]);
      length += (old[k + 1] - old[k]).norm();
      lost += swept_.Remove(old[k], old[k + 1]);
      if (k > 0 && Accept(length, lost, {old.front(), old.back()}, worth)) {
        todo.resize(todo.size() - k);
        return true;
      }
      if (k == 2 && DrawIn(old, length, lost, todo, worth)) return true;
      // What more could a longer window give back? Not all this ground.
      if (lost > (worth + 0.5) * (length + 4 * floor_.tool_width) * floor_.tool_width) break;
    }
    swept_.Add(old);
    return false;
  }

  // old: a leg, a link and a leg back.
  bool DrawIn(const Polyline& old, double length, int lost, Polyline& todo, double worth) {
    const Vec2 out = old[1] - old[0], back = old[3] - old[2];
    const double most = std::min(out.norm(), back.norm());
    if (most < 1 || out.dot(back) > -0.5 * out.norm() * back.norm()) return false;
    for (const double step : {2.0, 1.0, 0.5}) {
      const double by = step * floor_.tool_width;
      if (by >= most) continue;
      const Polyline fresh = {old[0], old[1] - by * out / out.norm(),
                              old[2] + by * back / back.norm(), old[3]};
      if (!Accept(length, lost, fresh, worth)) continue;
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
  for (int pass = 1; pass <= options.passes; ++pass)
    pruner.Round(options.worth * pass / options.passes);
}

}  // namespace floorproof
