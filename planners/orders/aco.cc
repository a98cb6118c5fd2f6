// SPDX-License-Identifier: Apache-2.0
// Ant colony: each iteration, every ant walks from the start through all places. It chooses the
// next one with a probability that grows with the trace on the way there and with its nearness.
// Traces evaporate, and each ant adds to those on its way, the more the shorter it was.
//
// The sampling paper's section 5.2. It gives numbers but no rules, so they are those of the plain
// ant system (Dorigo, Birattari & Stuetzle, "Ant Colony Optimization", IEEE Computational
// Intelligence Magazine 1(4), 2006, equations 1 to 3):
//   p(i -> j) ~ trace_ij^traces * (1 / d_ij)^sight       over the places j that are left
//   trace_ij = (1 - evaporation) trace_ij + the sum over ants that went i - j of Q / length
// Chosen here: Q is the length L of the nearest-neighbour walk, and traces begin at `ants` * Q / L,
// as much as an iteration of such ants lays down (Dorigo & Stuetzle, "Ant Colony Optimization",
// 2004, box 3.1 has the same start). No elite. Distances below a thousandth of their mean count as
// that much, as ways of no length would be seen from anywhere.
// With the paper's exponents, traces win: in some twenty iterations the colony settles on one way,
// and the others find nothing shorter. Elite ants, the best ant alone, ranks and max-min bounds
// were tried with these exponents: all settled sooner, on longer ways. Not done: local search; a
// bound.
#include <algorithm>
#include <cmath>

#include "base/streams.h"
#include "planners/orders/constructions.h"

namespace floorproof {
namespace {

constexpr double kLeastSight = 1e-3;   // of the mean distance
constexpr double kLeastTrace = 1e-12;  // of the greatest trace: its power must not vanish
constexpr int kDraws = 8;              // over all places, before those left are added up

struct AntRules {
  int ants = 100, iterations = 1000;
  double evaporation = 0.15, sight = 1, traces = 4;
};

class Colony {
 public:
  Colony(const OrderRequest& request, const AntRules& rules)
      : request_(request),
        rules_(rules),
        size_(request.distances.size()),
        random_(request.seed, 0, "aco"),
        sight_(Z(size_) * Z(size_), 0.0),
        trace_(sight_.size(), rules.ants),
        laid_(sight_.size()),
        weight_(sight_.size()),
        sum_(sight_.size()),
        visited_(Z(size_)),
        deposit_m_(TourLength(request.distances, NearestNeighbourOrder(request.distances),
                              request.closed)) {
    Look();
  }

  VisitSequence Run() {
    VisitSequence found;
    std::vector<int> order;
    for (int iteration = 0; iteration < rules_.iterations; ++iteration) {
      Weigh();
      std::ranges::fill(laid_, 0.0);
      for (int ant = 0; ant < rules_.ants; ++ant) {
        Walk(order);
        const double length_m = TourLength(request_.distances, order, request_.closed);
        LayTrace(order, length_m);
        if (!found.order.empty() && length_m >= found.length_m) continue;
        found.order = order;
        found.length_m = length_m;
      }
      for (std::size_t i = 0; i < trace_.size(); ++i)
        trace_[i] = (1 - rules_.evaporation) * trace_[i] + laid_[i];
      found.convergence.push_back(found.length_m);
    }
    return found;
  }

 private:
  std::size_t At(int a, int b) const { return Z(a) * Z(size_) + Z(b); }

  void Look() {
    double mean_m = 0;
    for (int a = 0; a < size_; ++a)
      for (const double m : request_.distances.From(a)) mean_m += m;
    mean_m /= std::max(1, size_ * (size_ - 1));
    for (int a = 0; a < size_; ++a)
      for (int b = 0; b < size_; ++b) {
        const double near = std::max(request_.distances(a, b), kLeastSight * mean_m);
        if (a != b) sight_[At(a, b)] = near > 0 ? std::pow(mean_m / near, rules_.sight) : 1;
      }
  }

  // What an ant goes by in this iteration; the sums are over each row up to and with a place.
  void Weigh() {
    const double most = trace_.empty() ? 1 : *std::ranges::max_element(trace_);
    for (int a = 0; a < size_; ++a) {
      double sum = 0;
      for (int b = 0; b < size_; ++b) {
        const double trace = std::max(trace_[At(a, b)] / most, kLeastTrace);
        weight_[At(a, b)] = std::pow(trace, rules_.traces) * sight_[At(a, b)];
        sum_[At(a, b)] = sum += weight_[At(a, b)];
      }
    }
  }

  void Walk(std::vector<int>& order) {
    std::ranges::fill(visited_, 0);
    order.assign(size_ > 0 ? 1 : 0, 0);
    while (static_cast<int>(order.size()) < size_) {
      visited_[Z(order.back())] = 1;
      order.push_back(Next(order.back()));
    }
  }

  // A draw among all places that hits one that is left is a fair draw among those left. Only where
  // that fails a few times are their weights added up.
  int Next(int at) {
    const auto sums = std::span(sum_).subspan(At(at, 0), Z(size_));
    for (int draw = 0; draw < kDraws; ++draw) {
      const auto hit = std::ranges::upper_bound(sums, random_.Uniform() * sums.back());
      const int place = static_cast<int>(hit - sums.begin());
      if (place < size_ && !visited_[Z(place)]) return place;
    }
    double left = 0;
    for (int b = 0; b < size_; ++b)
      if (!visited_[Z(b)]) left += weight_[At(at, b)];
    left *= random_.Uniform();
    int last = -1;
    for (int b = 0; b < size_ && (last < 0 || left >= 0); ++b) {
      if (visited_[Z(b)]) continue;
      last = b;
      left -= weight_[At(at, b)];
    }
    return last;
  }

  void LayTrace(const std::vector<int>& order, double length_m) {
    const double unit_m = deposit_m_ > 0 ? deposit_m_ : 1;
    const double amount = unit_m / std::max(length_m, 1e-9 * unit_m);
    const auto lay = [&](int a, int b) {
      laid_[At(a, b)] += amount;
      laid_[At(b, a)] += amount;
    };
    for (std::size_t k = 1; k < order.size(); ++k) lay(order[k - 1], order[k]);
    if (request_.closed && order.size() > 2) lay(order.back(), order.front());
  }

  const OrderRequest& request_;
  const AntRules& rules_;
  int size_;
  Stream random_;
  std::vector<double> sight_, trace_, laid_, weight_, sum_;  // from place to place, row by row
  std::vector<std::uint8_t> visited_;
  double deposit_m_;  // Q
};

class AntColony final : public VisitOrder {
 public:
  void Visit(ParamVisitor& v) override {
    v("ants", rules_.ants, Between(1, 1e4), "walks in each iteration");
    v("iterations", rules_.iterations, Between(1, 1e6), "how often all ants walk");
    v("evaporation", rules_.evaporation, Between(0, 1), "share of a trace that an iteration takes");
    v("sight", rules_.sight, Between(0, 20), "exponent of 1 / distance (beta)");
    v("traces", rules_.traces, Between(0, 20), "exponent of the trace (alpha)");
  }

  VisitSequence Order(const OrderRequest& request) const override {
    return Colony(request, rules_).Run();
  }

 private:
  AntRules rules_;
};

}  // namespace

FP_DEFINE_PLUGIN(VisitOrder, AntColony)

}  // namespace floorproof
