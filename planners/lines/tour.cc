// SPDX-License-Identifier: Apache-2.0
// A travelling salesman's open tour over lines that are driven from end to end.
//
// Construction: greedy matching of near ends (no end twice, no cycle), then the pieces are strung
// together from the start. Local search (planners/search/local_search.h), by two moves that keep
// lines whole: 2-opt turns a part of the tour round, Or-opt moves a part of up to kMaxMoved lines
// elsewhere, either way round. A kick exchanges two neighbouring parts (a local double bridge).
// Assumed: going from an end to another costs the same both ways.
// Deterministic: chance comes from a stream of its own. Not optimal.
#include "planners/lines/tour.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/streams.h"
#include "planners/search/local_search.h"

namespace floorproof {
namespace {

constexpr int kMaxMoved = 150;
// There are more kicks where they are cheap: a long tour takes longer to settle.
constexpr int kKickReach = 30, kKicksOfLine = 30, kMaxKicks = 6000, kKickEffort = 1'000'000;
constexpr std::size_t kCandidates = 10;
constexpr int kTable = 700;  // lines whose distances fit in a table

class Tour {
 public:
  Tour(ShortestPaths& paths, const Vec2& start, const std::vector<Polyline>& lines)
      : paths_(paths), n_(static_cast<int>(lines.size()) + 1), queue_(2 * Z(n_)) {
    points_.push_back(start);  // line 0 is the start: both its ends
    points_.push_back(start);
    for (const Polyline& line : lines) {
      points_.push_back(line.front());
      points_.push_back(line.back());
    }
    if (n_ <= kTable) table_.assign(Z(2 * n_) * Z(2 * n_), -1.0f);
    FindCandidates();
  }

  std::vector<Stop> Solve(bool thorough) {
    Match();
    for (int p = 0; p < n_; ++p) Touch({p});
    Settle();
    if (thorough && n_ >= 5) {
      keep_journal_ = true;
      Perturb(*this);
    }
    std::vector<Stop> visits;
    for (int p = 1; p < n_; ++p)
      visits.push_back({static_cast<std::size_t>(in_[Z(p)] / 2 - 1), in_[Z(p)] % 2 == 1});
    return visits;
  }

  // For Perturb.
  bool MayKick() { return kicks_++ < std::min({kMaxKicks, kKicksOfLine * n_, kKickEffort / n_}); }
  bool Kick() {
    const int most = std::min(kKickReach, (n_ - 2) / 2);
    const int i = 1 + static_cast<int>(random_.Below(static_cast<std::uint64_t>(n_ - 2)));
    const int j = i + static_cast<int>(random_.Below(static_cast<std::uint64_t>(most)));
    const int k = j + 1 + static_cast<int>(random_.Below(static_cast<std::uint64_t>(most)));
    if (k >= n_) return false;
    before_kick_ = length_;
    journal_.clear();
    Move(i, j, k, false);
    return true;
  }
  void Settle() {
    floorproof::Settle(queue_, [this](int e) { return e > 0 && (TwoOpt(e) || OrOpt(e)); });
  }
  bool IsWorse() const { return length_ > before_kick_ - kLeast; }  // or as long
  void Undo() {
    for (auto it = journal_.rbegin(); it != journal_.rend(); ++it) {
      scratch_in_ = it->second;
      scratch_edge_.clear();
      for (std::size_t k = 0; k + 1 < scratch_in_.size(); ++k)
        scratch_edge_.push_back(D(Other(scratch_in_[k]), scratch_in_[k + 1]));
      const int next = it->first + static_cast<int>(scratch_in_.size());
      scratch_edge_.push_back(next < n_ ? D(Other(scratch_in_.back()), In(next)) : 0);
      Write(it->first);
    }
  }

 private:
  static int Other(int end) { return end ^ 1; }

  static std::uint64_t Key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
           static_cast<std::uint32_t>(std::max(a, b));
  }
  double D(int a, int b) {
    if (table_.empty()) {
      const auto [it, fresh] = known_.try_emplace(Key(a, b), 0.0f);
      if (fresh) it->second = static_cast<float>(paths_.Distance(points_[Z(a)], points_[Z(b)]));
      return static_cast<double>(it->second);
    }
    float& known = Entry(a, b);
    if (known < 0) known = static_cast<float>(paths_.Distance(points_[Z(a)], points_[Z(b)]));
    return static_cast<double>(known);
  }
  float& Entry(int a, int b) { return table_[Z(std::min(a, b)) * Z(2 * n_) + Z(std::max(a, b))]; }
  // What the candidates' search says, where nothing is known yet.
  double Known(int a, int b, double distance) {
    const auto d = static_cast<float>(distance);
    if (table_.empty()) return static_cast<double>(known_.try_emplace(Key(a, b), d).first->second);
    if (Entry(a, b) < 0) Entry(a, b) = d;
    return static_cast<double>(Entry(a, b));
  }

  double AtLeast(int a, int b) const { return (points_[Z(a)] - points_[Z(b)]).norm(); }

  bool Within(int a, int b, double distance) const {
    return distance > 0 && (points_[Z(a)] - points_[Z(b)]).squaredNorm() < distance * distance;
  }

  void FindCandidates() {
    paths_.IndexPlaces(points_);
    candidates_.Close();  // of the start's first end, at which nothing ends
    for (int e = 1; e < 2 * n_; ++e) {
      std::vector<std::pair<double, int>> found;
      for (const auto& [distance, f] : paths_.NearestPlaces(e, kCandidates + 2)) {
        if (f / 2 == e / 2 || f < 2) continue;
        found.push_back({Known(e, f, distance), f});
      }
      std::sort(found.begin(), found.end());
      if (found.size() > kCandidates) found.resize(kCandidates);
      for (const auto& [d, f] : found) candidates_.Add(f);
      candidates_.Close();
    }
  }

  void Match() {
    const int ends = 2 * n_;
    std::vector<int> mate(Z(ends), -1), chain(Z(n_));
    std::iota(chain.begin(), chain.end(), 0);
    const auto root = [&chain](int a) {
      while (chain[Z(a)] != a) a = chain[Z(a)] = chain[Z(chain[Z(a)])];
      return a;
    };
    const auto join = [&](int a, int b) {
      mate[Z(a)] = b, mate[Z(b)] = a;
      chain[Z(root(a / 2))] = root(b / 2);
    };
    std::vector<std::tuple<double, int, int>> pairs;
    for (int e = 1; e < ends; ++e)
      for (const int f : candidates_.Of(e))
        pairs.push_back({D(e, f), std::min(e, f), std::max(e, f)});
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [d, a, b] : pairs)
      if (mate[Z(a)] < 0 && mate[Z(b)] < 0 && root(a / 2) != root(b / 2)) join(a, b);
    // String the chains together: from the current end to the nearest chain's nearer end.
    std::vector<std::uint8_t> done(Z(n_), 0);
    in_.clear();
    int end = 1;  // out of the start
    in_.push_back(0);
    done[0] = 1;
    for (;;) {
      int next = mate[Z(end)];
      if (next < 0) {
        double best = std::numeric_limits<double>::infinity();
        for (int e = 2; e < ends; ++e) {
          if (done[Z(e / 2)] || mate[Z(e)] >= 0) continue;
          const double straight = (points_[Z(e)] - points_[Z(end)]).norm();
          if (straight >= best) continue;
          const double d = D(end, e);
          if (d < best || next < 0) best = d, next = e;
        }
        if (next < 0) break;
      }
      done[Z(next / 2)] = 1;
      in_.push_back(next);
      end = Other(next);
    }
    place_.resize(Z(n_));
    for (int p = 0; p < n_; ++p) place_[Z(in_[Z(p)] / 2)] = p;
    edge_.resize(Z(n_));
    for (int p = 0; p + 1 < n_; ++p) length_ += edge_[Z(p)] = D(Out(p), In(p + 1));
  }

  int In(int p) const { return in_[Z(p)]; }
  int Out(int p) const { return Other(in_[Z(p)]); }
  double Edge(int p) const { return edge_[Z(p)]; }  // behind place p

  // A part of the tour, as it stands or turned round, with the edges inside it.
  struct Piece {
    int from, to;
    bool reversed;
  };

  // Puts the pieces, which together hold the places from .. from + their length - 1, in this order.
  void Rearrange(int from, std::initializer_list<Piece> pieces) {
    scratch_in_.clear();
    scratch_edge_.clear();
    for (const Piece& piece : pieces) {
      if (piece.to < piece.from) continue;
      if (!scratch_in_.empty())
        scratch_edge_.push_back(
            D(Other(scratch_in_.back()), piece.reversed ? Out(piece.to) : In(piece.from)));
      if (piece.reversed) {
        for (int p = piece.to; p >= piece.from; --p) {
          scratch_in_.push_back(Out(p));
          if (p > piece.from) scratch_edge_.push_back(edge_[Z(p - 1)]);
        }
      } else {
        for (int p = piece.from; p <= piece.to; ++p) {
          scratch_in_.push_back(In(p));
          if (p < piece.to) scratch_edge_.push_back(edge_[Z(p)]);
        }
      }
    }
    const int to = from + static_cast<int>(scratch_in_.size()) - 1;
    scratch_edge_.push_back(to + 1 < n_ ? D(Other(scratch_in_.back()), In(to + 1)) : 0);
    if (keep_journal_) {
      journal_.push_back({from, {in_.begin() + from, in_.begin() + to + 1}});
    }
    Write(from);
  }

  // Writes the scratch to the places from `from` on.
  void Write(int from) {
    for (std::size_t k = 0; k < scratch_in_.size(); ++k) {
      const std::size_t p = Z(from) + k;
      length_ += scratch_edge_[k] - edge_[p];
      in_[p] = scratch_in_[k];
      edge_[p] = scratch_edge_[k];
      place_[Z(scratch_in_[k] / 2)] = static_cast<int>(p);
    }
    length_ -= edge_[Z(from - 1)];
    edge_[Z(from - 1)] = D(Out(from - 1), In(from));
    length_ += edge_[Z(from - 1)];
  }

  void Reverse(int i, int j) {
    Touch({i - 1, i, j, j + 1});
    Rearrange(i, {{i, j, true}});
  }
  // Moves places i..j to behind place k (outside of them).
  void Move(int i, int j, int k, bool reversed) {
    Touch({i - 1, i, j, j + 1, k, k + 1});
    if (k > j) {
      Rearrange(i, {{j + 1, k, false}, {i, j, reversed}});
    } else {
      Rearrange(k + 1, {{i, j, reversed}, {k + 1, i - 1, false}});
    }
  }

  // The ends at these places are to be looked at again.
  void Touch(std::initializer_list<int> places) {
    for (const int p : places)
      if (p >= 0 && p < n_) queue_.Push(In(p)), queue_.Push(Out(p));
  }

  // Tries to give the end `e` a nearer neighbour by turning a part round.
  bool TwoOpt(int e) {
    const int p = place_[Z(e / 2)];
    const bool is_out = Out(p) == e;
    if (is_out ? p + 1 >= n_ : p == 0) return false;
    const double old = is_out ? Edge(p) : Edge(p - 1);
    for (const int f : candidates_.Of(e)) {
      if (D(e, f) >= old - kLeast) break;
      const int q = place_[Z(f / 2)];
      if ((Out(q) == f) != is_out) continue;
      // Two ends of the same kind: reverse what lies between their edges.
      const int i = (is_out ? std::min(p, q) + 1 : std::min(p, q));
      const int j = (is_out ? std::max(p, q) : std::max(p, q) - 1);
      if (i < 1 || j < i) continue;
      const double before = Edge(i - 1) + Edge(j);
      const double least =
          AtLeast(Out(i - 1), Out(j)) + (j + 1 < n_ ? AtLeast(In(i), In(j + 1)) : 0);
      if (least >= before - kLeast) continue;
      const double after = D(Out(i - 1), Out(j)) + (j + 1 < n_ ? D(In(i), In(j + 1)) : 0);
      if (after < before - kLeast) {
        Reverse(i, j);
        return true;
      }
    }
    return false;
  }

  // Tries to move a part that begins (or ends) with the end `e` next to a near end.
  bool OrOpt(int e) {
    const int p = place_[Z(e / 2)];
    if (p == 0) return false;
    const bool is_in = In(p) == e;  // the part goes on from e to higher places
    if (!is_in && p + 1 >= n_) return false;
    const double old = is_in ? Edge(p - 1) : Edge(p);
    for (const int f : candidates_.Of(e)) {
      const double first = D(e, f);
      if (first >= old - kLeast) break;
      const int q = place_[Z(f / 2)];
      const bool f_out = Out(q) == f;
      const int k = f_out ? q : q - 1;  // insert behind place k
      if (k < 0) continue;
      for (int length = 1; length <= kMaxMoved; ++length) {
        const int i = is_in ? p : p - length + 1, j = is_in ? p + length - 1 : p;
        if (i < 1 || j >= n_) break;
        if (k >= i - 1 && k <= j) break;
        const int far = is_in ? Out(j) : In(i);
        const double removed = Edge(i - 1) + Edge(j) + Edge(k);
        // Straight lines are looked at first: they are never longer than the way.
        double most = removed - kLeast - first;
        if (j + 1 < n_ && !Within(Out(i - 1), In(j + 1), most)) continue;
        if (f_out ? k + 1 < n_ : true) {
          if (j + 1 < n_) most -= AtLeast(Out(i - 1), In(j + 1));
          if (!Within(far, f_out ? In(k + 1) : Out(k), most)) continue;
        }
        double added = first;
        if (j + 1 < n_) added += D(Out(i - 1), In(j + 1));
        if (f_out ? k + 1 < n_ : true) added += D(far, f_out ? In(k + 1) : Out(k));
        if (added < removed - kLeast) {
          // e stands next to f: unreversed when an entry follows an exit.
          Move(i, j, k, is_in != f_out);
          return true;
        }
      }
    }
    return false;
  }

  static constexpr double kLeast = 1e-3;  // cells
  ShortestPaths& paths_;
  int n_;
  std::vector<Vec2> points_;        // ends: line e / 2, its front (even) or back (odd)
  CandidateLists<int> candidates_;  // by end: other lines' ends
  std::vector<float> table_;  // of few lines: by two ends, the lower first; below 0: not known
  std::unordered_map<std::uint64_t, float> known_;  // of many
  std::vector<int> in_;       // by place: the end by which the line there is entered
  std::vector<int> place_;    // by line
  std::vector<double> edge_;  // by place: the way on to the next line
  double length_ = 0;         // of all edges
  LookQueue queue_;           // of ends
  Stream random_{0, 0, "tour"};
  int kicks_ = 0;
  double before_kick_ = 0;
  bool keep_journal_ = false;
  std::vector<std::pair<int, std::vector<int>>> journal_;  // first place, what stood there
  std::vector<int> scratch_in_;
  std::vector<double> scratch_edge_;
};

}  // namespace

std::vector<Stop> OrderLines(ShortestPaths& paths, const Vec2& start,
                             const std::vector<Polyline>& lines, bool thorough) {
  if (lines.empty()) return {};
  return Tour(paths, start, lines).Solve(thorough);
}

}  // namespace floorproof
