// SPDX-License-Identifier: Apache-2.0
// 3-opt (Lin 1965): for a costly link t1 - t2 two or three links are taken out and as many others
// put in, of which the first ones lead to near places (Bentley, "Fast Algorithms for Geometric
// Traveling Salesman Problems", 1992); then kicks (Martin, Otto & Felten 1991): two neighbouring
// stretches near a costly link change places, 3-opt settles what that touched, and the outcome
// stays when it is no worse. As good is taken too: on a floor most paths are as good as their
// neighbours. The path is an array, closed to a ring by one more place. Longer chains of exchanges
// (Lin & Kernighan 1973) were tried: many kicks found more. Deterministic; not optimal.
#include "planners/walk/path_search.h"

#include <algorithm>
#include <array>

#include "base/streams.h"
#include "planners/lines/index.h"

namespace floorproof {
namespace {

constexpr std::size_t kBreadth = 6;                    // of choices, the best
constexpr int kReach = 50;                             // of a kick, places
constexpr int kMaxTurned = 50'000, kMaxTried = 1'000;  // places turned round: for good, on trial
constexpr std::int64_t kFixed = std::int64_t{1} << 60;

class PathSearch {
 public:
  PathSearch(LinkCosts& costs, const NearLinks& near, const PathSearchOptions& options,
             std::vector<int>& path)
      : costs_(costs),
        near_(near),
        options_(options),
        first_(path.front()),
        last_(path.back()),
        closing_(static_cast<int>(path.size())),
        n_(closing_ + 1),
        ring_(path),
        place_(Z(n_)),
        waits_(Z(n_), 0) {
    ring_.push_back(closing_);
    for (int p = 0; p < n_; ++p) place_[Z(ring_[Z(p)])] = p;
    work_ = -costs.work;
  }

  std::vector<int> Solve() {
    for (const int v : ring_) Touch(v);
    Settle();
    if (n_ >= 5) Kick();
    if (Next(closing_) != first_) turned_ = !turned_;
    std::vector<int> path;
    for (int v = first_; v != closing_; v = Next(v)) path.push_back(v);
    return path;
  }

 private:
  std::int64_t ClosingCost(int v) const {
    if (v == first_ || (options_.fixed_end && v == last_)) return -kFixed;
    return options_.fixed_end ? kFixed : costs_.EndCost(v);
  }
  std::int64_t Cost(int a, int b, std::int64_t limit = LinkCosts::kUnlimited) {
    if (a == closing_) return ClosingCost(b);
    if (b == closing_) return ClosingCost(a);
    return costs_.Cost(a, b, limit);
  }
  bool Spent() const { return work_ + costs_.work >= options_.most_work; }

  int Next(int v) const { return Beside(v, !turned_); }
  int Prev(int v) const { return Beside(v, turned_); }
  int Beside(int v, bool up) const {
    int p = place_[Z(v)] + (up ? 1 : -1);
    if (p == n_) p = 0;
    if (p < 0) p = n_ - 1;
    return ring_[Z(p)];
  }
  int Ahead(int v, int count) const {
    const int p = place_[Z(v)] + (turned_ ? -count : count);
    return ring_[Z(p >= n_ ? p - n_ : p < 0 ? p + n_ : p)];
  }
  int Length(int a, int b) const {  // of the way from a to b, both included
    const int d = turned_ ? place_[Z(a)] - place_[Z(b)] : place_[Z(b)] - place_[Z(a)];
    return (d < 0 ? d + n_ : d) + 1;
  }

  // Turns the way from a to b round: before a..b after -> before b..a after.
  void Flip(int a, int b) {
    journal_.push_back(mirrored_ ? std::pair{b, a} : std::pair{a, b});
    DoFlip(a, b);
  }
  void DoFlip(int a, int b) {
    int count = Length(a, b);
    if (2 * count > n_) {  // the rest instead, and the ring is read from the other side
      const int after = Next(b);
      b = Prev(a), a = after, count = n_ - count;
      turned_ = !turned_;
      std::swap(a, b);
    }
    int i = place_[Z(turned_ ? b : a)], j = place_[Z(turned_ ? a : b)];
    work_ += 1 + count / 8;
    for (int k = count / 2; k > 0; --k) {
      std::swap(ring_[Z(i)], ring_[Z(j)]);
      place_[Z(ring_[Z(i)])] = i;
      place_[Z(ring_[Z(j)])] = j;
      if (++i == n_) i = 0;
      if (--j < 0) j = n_ - 1;
    }
  }
  void UndoTo(std::size_t size) {
    const bool mirrored = mirrored_;
    if (mirrored) Mirror();
    while (journal_.size() > size) {
      DoFlip(journal_.back().second, journal_.back().first);
      journal_.pop_back();
    }
    if (mirrored) Mirror();
  }
  void Mirror() {
    mirrored_ = !mirrored_;
    turned_ = !turned_;
  }

  void Touch(int v) {
    if (waits_[Z(v)]) return;
    waits_[Z(v)] = 1;
    queue_.push_back(v);
  }

  // Until no costly link of a place that waits can be replaced.
  void Settle() {
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      const int v = queue_[k];
      waits_[Z(v)] = 0;
      while (!Spent() && Improve(v)) {
      }
    }
    queue_.clear();
  }

  bool Improve(int t1) {
    bool better = false;
    for (int side = 0; side < 2 && !better; ++side) {
      const int t2 = Next(t1);
      const std::int64_t gain = Cost(t1, t2);
      better = gain > 0 && Exchange(t1, t2, gain, true);
      if (better) Touch(t1), Touch(t2);
      Mirror();
    }
    if (mirrored_) Mirror();
    return better;
  }

  // An exchange to try: the link to `near` goes in, the one from there to `out` goes out.
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

  // Calls visit(place, gain left) for links from v that leave a gain.
  template <class Visit>
  void ForNear(int v, std::int64_t gain, const Visit& visit) {
    if (v == closing_) return;
    if (!options_.fixed_end && v != first_ && gain > costs_.EndCost(v))
      visit(closing_, gain - costs_.EndCost(v));
    for (const Link& link : near_.Of(v)) {
      ++work_;
      if (gain <= link.cost) break;
      visit(link.to, gain - link.cost);
    }
  }

  // The link t1 - t2 = Next(t1) is out; `gain` is what is out less what is in. `first`: a second
  // exchange may follow.
  bool Exchange(int t1, int t2, std::int64_t gain, bool first) {
    Choices choices;
    ForNear(t2, gain, [&](int t3, std::int64_t g) {
      if (t3 == t1 || t3 == Next(t2)) return;
      choices.Add({g + Cost(Prev(t3), t3), t3, Prev(t3), false});
      if (first) choices.Add({g + Cost(t3, Next(t3)), t3, Next(t3), true});
    });
    for (const auto& [g, t3, t4, next] : choices.Best()) {
      if (next ? OverRing(t1, t2, t3, t4, g) : Straight(t1, t2, t4, g, first)) {
        Touch(t3), Touch(t4);
        return true;
      }
    }
    return false;
  }

  // t1 t2 .. t4 t3 -> t1 t4 .. t2 t3.
  bool Straight(int t1, int t2, int t4, std::int64_t gain, bool first) {
    const int length = Length(t2, t4), turned = std::min(length, n_ - length);
    if (turned > kMaxTurned) return false;
    const bool closes = Closes(t4, t1, gain);
    if (!closes && (!first || turned > kMaxTried)) return false;
    const std::size_t size = journal_.size();
    Flip(t2, t4);
    if (closes || Exchange(t1, t4, gain, false)) return true;
    UndoTo(size);
    return false;
  }

  // Without t3 - t4 = Next(t3), t2 .. t3 is a ring; a link from t4 into it opens it at t5 - t6.
  bool OverRing(int t1, int t2, int t3, int t4, std::int64_t gain) {
    const int length = Length(t2, t3);
    if (std::min(length, n_ - length) > kMaxTurned) return false;
    Choices choices;
    ForNear(t4, gain, [&](int t5, std::int64_t g) {
      if (t5 == t3 || Length(t2, t5) > length) return;
      choices.Add({g + Cost(t5, Next(t5)), t5, Next(t5), true});
      if (t5 != t2) choices.Add({g + Cost(Prev(t5), t5), t5, Prev(t5), false});
    });
    for (const auto& [g, t5, t6, next] : choices.Best()) {
      if (!Closes(t6, t1, g)) continue;
      if (next) {  // t1 t2..t5 t6..t3 t4 -> t1 t6..t3 t2..t5 t4
        Flip(t2, t3);
        Flip(t3, t6);
        Flip(t5, t2);
      } else {  // t1 t2..t6 t5..t3 t4 -> t1 t6..t2 t3..t5 t4
        Flip(t2, t6);
        Flip(t5, t3);
      }
      Touch(t5), Touch(t6);
      return true;
    }
    return false;
  }

  // Whether the link a - b, put in for `gain`, leaves something.
  bool Closes(int a, int b, std::int64_t gain) {
    if (a != closing_ && b != closing_ && costs_.AtLeast(a, b) >= gain) return false;
    const std::int64_t cost = Cost(a, b, gain);
    if (cost >= gain) return false;
    saved_ += gain - cost;
    return true;
  }

  // Two stretches of up to kReach places change places: a b..c d..e f -> a d..e b..c f.
  void Kick() {
    Stream random(0, 0, "path_search");
    const auto below = [&random](int count) {
      return static_cast<int>(random.Below(static_cast<std::uint64_t>(count)));
    };
    const int reach = std::min(kReach, (n_ - 2) / 2);
    std::vector<int> costly;
    for (std::size_t tried = 0; !Spent(); ++tried) {
      if (tried >= costly.size()) {
        tried = 0;
        costly.clear();
        for (const int v : ring_)
          if (Cost(v, Next(v)) > 0) costly.push_back(v);
        work_ += n_ / 4;
        if (costly.empty()) return;
      }
      ++work_;
      const int v = costly[random.Below(costly.size())];
      const int a = Ahead(v, -below(reach)), b = Next(a);
      const int c = Ahead(b, below(reach)), d = Next(c);
      const int e = Ahead(d, below(reach)), f = Next(e);
      const std::int64_t out = Cost(a, b) + Cost(c, d) + Cost(e, f);
      if (out < 0) continue;  // one that is fixed
      const std::int64_t in = Cost(a, d) + Cost(e, b) + Cost(c, f);
      if (in >= kFixed / 2) continue;
      journal_.clear();
      saved_ = out - in;
      Flip(b, e);
      Flip(e, d);
      Flip(c, b);
      for (const int t : {a, b, c, d, e, f}) Touch(t);
      Settle();
      if (saved_ < 0) UndoTo(0);
    }
  }

  LinkCosts& costs_;
  const NearLinks& near_;
  PathSearchOptions options_;
  int first_, last_, closing_;  // places; the closing one is ours
  int n_;
  std::vector<int> ring_, place_;
  bool turned_ = false;    // the ring is read from the array's end to its front
  bool mirrored_ = false;  // and the search looks the other way
  std::vector<std::uint8_t> waits_;
  std::vector<int> queue_;
  std::vector<std::pair<int, int>> journal_;  // of flips, as seen unmirrored
  std::int64_t saved_ = 0;                    // since the last kick
  std::int64_t work_ = 0;
};

}  // namespace

void ShortenPath(LinkCosts& costs, const NearLinks& near, const PathSearchOptions& options,
                 std::vector<int>& path) {
  if (path.size() > 2) path = PathSearch(costs, near, options, path).Solve();
}

}  // namespace floorproof
