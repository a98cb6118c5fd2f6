// SPDX-License-Identifier: Apache-2.0
// 3-opt (Lin 1965): two or three edges are taken out of the tour and as many others put in, so that
// it costs less. A move begins at an edge t1 - t2 that costs something, and the first edges put in
// are candidates (planners/search/local_search.h). A kick exchanges two neighbouring parts of the
// tour near such an edge. Its outcome is kept when it is no worse, not only when it is better: on a
// floor most tours cost as much as their neighbours. With `heat`, worse ones are kept at times,
// too, as by simulated annealing (Martin, Otto & Felten 1991), and the best tour is what comes out.
//
// The open tour is closed by one more vertex between its end and its start. Edges to that vertex
// cost what it costs to end there; a fixed end's cost so little that they are never taken out.
// Longer chains of exchanges (Lin & Kernighan 1973) were tried: more kicks found more.
// Deterministic: chance comes from a stream of its own. Not optimal.
#include "planners/search/three_opt.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/streams.h"
#include "planners/search/array_tour.h"

namespace floorproof {
namespace {

constexpr std::size_t kBreadth = 6;  // choices that are tried at each level, the best ones
constexpr int kReach = 50;           // of a kick, places
// Places that a flip may turn: where the move is known to pay, and where it is only tried.
constexpr int kMaxTurned = 50'000, kMaxTried = 1'000;
constexpr std::int64_t kFixed = std::int64_t{1} << 60;

class ThreeOpt {
 public:
  ThreeOpt(EdgeCosts& costs, const CandidateEdges& candidates, const ThreeOptOptions& options,
           const std::vector<int>& tour)
      : costs_(costs),
        candidates_(candidates),
        options_(options),
        first_(tour.front()),
        last_(tour.back()),
        closing_(static_cast<int>(tour.size())),
        tour_(Closed(tour)),
        queue_(Z(tour_.size())),
        random_(0, 0, "path_search"),  // the name fixes the draws
        work_(-costs.work) {}

  std::vector<int> Solve() {
    for (const int v : tour_.order()) queue_.Push(v);
    Settle();
    if (options_.heat > 0) Warm();
    if (tour_.size() >= 5) Perturb(*this);
    if (best_ > value_) tour_ = ArrayTour(best_order_);
    if (tour_.Next(closing_) != first_) tour_.Mirror();
    std::vector<int> places;
    for (int v = first_; v != closing_; v = tour_.Next(v)) places.push_back(v);
    return places;
  }

  // For Perturb.
  bool MayKick() {
    if (Spent()) return false;
    if (kicks_++ < costly_.size()) return true;
    kicks_ = 1;
    costly_.clear();
    for (const int v : tour_.order())
      if (Cost(v, tour_.Next(v)) > 0) costly_.push_back(v);
    work_ += tour_.size() / 4;
    return !costly_.empty();
  }
  // Exchanges two parts of up to kReach places: a b..c d..e f -> a d..e b..c f.
  bool Kick() {
    const auto below = [this](int count) {
      return static_cast<int>(random_.Below(static_cast<std::uint64_t>(count)));
    };
    const int reach = std::min(kReach, (tour_.size() - 2) / 2);
    ++work_;
    const int v = costly_[random_.Below(costly_.size())];
    const int a = tour_.Ahead(v, -below(reach)), b = tour_.Next(a);
    const int c = tour_.Ahead(b, below(reach)), d = tour_.Next(c);
    const int e = tour_.Ahead(d, below(reach)), f = tour_.Next(e);
    const std::int64_t out = Cost(a, b) + Cost(c, d) + Cost(e, f);
    if (out < 0) return false;  // one of them is fixed
    const std::int64_t in = Cost(a, d) + Cost(e, b) + Cost(c, f);
    if (in >= kFixed / 2) return false;
    tour_.ForgetFlips();
    saved_ = out - in;
    tour_.Flip(b, e);
    tour_.Flip(e, d);
    tour_.Flip(c, b);
    for (const int t : {a, b, c, d, e, f}) queue_.Push(t);
    return true;
  }
  void Settle() {
    floorproof::Settle(queue_, [this](int v) { return !Spent() && Improve(v); });
  }
  // Unless it is kept although it is.
  bool IsWorse() {
    if (saved_ < 0 && !Bears(-saved_)) return true;
    value_ += saved_;
    if (options_.heat > 0 && value_ > best_) KeepAsBest();
    return false;
  }
  void Undo() { tour_.UndoTo(0); }

 private:
  static std::vector<int> Closed(std::vector<int> tour) {
    tour.push_back(static_cast<int>(tour.size()));
    return tour;
  }
  std::int64_t ClosingCost(int v) const {
    if (v == first_ || (options_.fixed_end && v == last_)) return -kFixed;
    return options_.fixed_end ? kFixed : costs_.EndCost(v);
  }
  std::int64_t Cost(int a, int b, std::int64_t limit = EdgeCosts::kUnlimited) {
    if (a == closing_) return ClosingCost(b);
    if (b == closing_) return ClosingCost(a);
    return costs_.Cost(a, b, limit);
  }
  std::int64_t Work() const { return work_ + tour_.work() + costs_.work; }
  bool Spent() const { return Work() >= options_.max_work; }

  // Metropolis' rule: worse by `more` with the probability exp(-more / temperature).
  bool Bears(std::int64_t more) {
    if (heat_ <= 0) return false;
    const double left = 1 - static_cast<double>(Work()) / static_cast<double>(options_.max_work);
    return static_cast<double>(more) < -heat_ * left * std::log(1 - random_.Uniform());
  }
  void Warm() {
    double sum = 0;
    for (const int v : tour_.order())
      if (const std::int64_t cost = Cost(v, tour_.Next(v)); cost < kFixed / 2 && cost > 0)
        sum += static_cast<double>(cost);
    heat_ = options_.heat * sum / tour_.size();
    KeepAsBest();
  }
  void KeepAsBest() {
    best_ = value_;
    best_order_ = tour_.order();
    work_ += tour_.size() / 8;
  }

  // Replaces an edge of t1, on either side, if that pays.
  bool Improve(int t1) {
    bool better = false;
    for (int side = 0; side < 2 && !better; ++side) {
      const int t2 = tour_.Next(t1);
      const std::int64_t gain = Cost(t1, t2);
      better = gain > 0 && Exchange(t1, t2, gain, true);
      if (better) queue_.Push(t1), queue_.Push(t2);
      tour_.Mirror();
    }
    if (tour_.mirrored()) tour_.Mirror();
    return better;
  }

  // An exchange to try: the edge to `near` goes in, the one from there to `out` goes out.
  struct Choice {
    std::int64_t gain;
    int near, out;
    bool next;  // `out` is Next(near), not Prev(near)
  };
  struct Choices {
    std::array<Choice, 32> all;
    std::size_t count = 0;

    void Add(const Choice& choice) {
      if (choice.gain > 0 && count < all.size()) all[count++] = choice;
    }
    // The best first.
    std::span<const Choice> Best() {
      const std::size_t most = std::min(kBreadth, count);
      for (std::size_t i = 0; i < most; ++i)  // few: no sort is quicker, nor as stable
        for (std::size_t j = count - 1; j > i; --j)
          if (all[j].gain > all[j - 1].gain) std::swap(all[j], all[j - 1]);
      return {all.data(), most};
    }
  };

  // Calls visit(place, gain left) for edges from v that leave a gain.
  template <class Visit>
  void ForCandidates(int v, std::int64_t gain, const Visit& visit) {
    if (v == closing_) return;
    if (!options_.fixed_end && v != first_ && gain > costs_.EndCost(v))
      visit(closing_, gain - costs_.EndCost(v));
    for (const CandidateEdge& edge : candidates_.Of(v)) {
      ++work_;
      if (gain <= edge.cost) break;
      visit(edge.to, gain - edge.cost);
    }
  }

  // The edge t1 - t2 = Next(t1) is out; `gain` is what is out less what is in. `first`: a second
  // exchange may follow.
  bool Exchange(int t1, int t2, std::int64_t gain, bool first) {
    Choices choices;
    ForCandidates(t2, gain, [&](int t3, std::int64_t g) {
      if (t3 == t1 || t3 == tour_.Next(t2)) return;
      choices.Add({g + Cost(tour_.Prev(t3), t3), t3, tour_.Prev(t3), false});
      if (first) choices.Add({g + Cost(t3, tour_.Next(t3)), t3, tour_.Next(t3), true});
    });
    for (const auto& [g, t3, t4, next] : choices.Best()) {
      if (next ? OverCycle(t1, t2, t3, t4, g) : Straight(t1, t2, t4, g, first)) {
        queue_.Push(t3), queue_.Push(t4);
        return true;
      }
    }
    return false;
  }

  // t1 t2 .. t4 t3 -> t1 t4 .. t2 t3.
  bool Straight(int t1, int t2, int t4, std::int64_t gain, bool first) {
    const int length = tour_.Length(t2, t4), turned = std::min(length, tour_.size() - length);
    if (turned > kMaxTurned) return false;
    const bool closes = Closes(t4, t1, gain);
    if (!closes && (!first || turned > kMaxTried)) return false;
    const std::size_t flips = tour_.flips();
    tour_.Flip(t2, t4);
    if (closes || Exchange(t1, t4, gain, false)) return true;
    tour_.UndoTo(flips);
    return false;
  }

  // Without t3 - t4 = Next(t3), t2 .. t3 is a cycle of its own. An edge from t4 into it opens it
  // at t5 - t6.
  bool OverCycle(int t1, int t2, int t3, int t4, std::int64_t gain) {
    const int length = tour_.Length(t2, t3);
    if (std::min(length, tour_.size() - length) > kMaxTurned) return false;
    Choices choices;
    ForCandidates(t4, gain, [&](int t5, std::int64_t g) {
      if (t5 == t3 || tour_.Length(t2, t5) > length) return;
      choices.Add({g + Cost(t5, tour_.Next(t5)), t5, tour_.Next(t5), true});
      if (t5 != t2) choices.Add({g + Cost(tour_.Prev(t5), t5), t5, tour_.Prev(t5), false});
    });
    for (const auto& [g, t5, t6, next] : choices.Best()) {
      if (!Closes(t6, t1, g)) continue;
      if (next) {  // t1 t2..t5 t6..t3 t4 -> t1 t6..t3 t2..t5 t4
        tour_.Flip(t2, t3);
        tour_.Flip(t3, t6);
        tour_.Flip(t5, t2);
      } else {  // t1 t2..t6 t5..t3 t4 -> t1 t6..t2 t3..t5 t4
        tour_.Flip(t2, t6);
        tour_.Flip(t5, t3);
      }
      queue_.Push(t5), queue_.Push(t6);
      return true;
    }
    return false;
  }

  // Whether the edge a - b, put in at last, costs less than the gain so far.
  bool Closes(int a, int b, std::int64_t gain) {
    if (a != closing_ && b != closing_ && costs_.AtLeast(a, b) >= gain) return false;
    const std::int64_t cost = Cost(a, b, gain);
    if (cost >= gain) return false;
    saved_ += gain - cost;
    return true;
  }

  EdgeCosts& costs_;
  const CandidateEdges& candidates_;
  ThreeOptOptions options_;
  int first_, last_, closing_;  // closing_: the vertex between the end and the start
  ArrayTour tour_;
  LookQueue queue_;
  Stream random_;
  std::vector<int> costly_;            // places whose next edge costs something, found now and then
  std::size_t kicks_ = 0;              // since they were found
  std::int64_t saved_ = 0;             // since the last kick began
  std::int64_t value_ = 0, best_ = 0;  // saved by kicks: of the tour, and at most
  std::vector<int> best_order_;        // with `heat`: the tour that saved `best_`
  double heat_ = 0;                    // the temperature at first, in costs
  std::int64_t work_;
};

}  // namespace

void ImproveTour(EdgeCosts& costs, const CandidateEdges& candidates, const ThreeOptOptions& options,
                 std::vector<int>& tour) {
  if (tour.size() > 2) tour = ThreeOpt(costs, candidates, options, tour).Solve();
}

}  // namespace floorproof
