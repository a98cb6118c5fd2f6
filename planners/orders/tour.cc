// SPDX-License-Identifier: Apache-2.0
// A short way through all places, and how short any can be.
//
// (1) Up to a dozen places are solved exactly (exact_order.h). (2) Else the shortest of three first
// orders (nearest neighbours, shortest edges first, rows) is improved by a local search with kicks
// (planners/search/three_opt.h) as long as the budget lasts. (3) A bound comes from 1-trees
// (one_tree_bound.h). So the way is never longer than the default zig-zag, and what it may be
// longer than the shortest one is known. The budget is counted in elementary steps: the same
// request gives the same way. It takes no notice of the seed. Not optimal beyond a dozen places.
#include <algorithm>
#include <cmath>

#include "planners/orders/constructions.h"
#include "planners/orders/exact_order.h"
#include "planners/orders/one_tree_bound.h"
#include "planners/orders/rows.h"
#include "planners/search/three_opt.h"

namespace floorproof {
namespace {

constexpr std::size_t kCandidates = 8;
constexpr int kUnitBits = 40;     // of the greatest distance: a sum of 2^20 of them fits
constexpr int kMaxGreedy = 3000;  // places: more have too many edges to sort
constexpr double kNoLength_m = 1e-200;
constexpr double kRow_m = 0.05;  // as the zig-zag has it
constexpr double kStepsPerPlace = 100'000;
// Of 0, 0.1, 0.3, 0.6 and 1 the one that came nearest to the shortest ways known of 200 places.
constexpr double kHeat = 0.6;

// Distances as whole numbers.
class TableCosts final : public EdgeCosts {
 public:
  TableCosts(const PlaceDistances& distances, bool closed)
      : size_(distances.size()), cost_(Z(size_) * Z(size_)), closed_(closed) {
    const double greatest_m = distances.Greatest();
    const double units_per_m =
        greatest_m > kNoLength_m ? std::exp2(kUnitBits - std::ilogb(greatest_m)) : 1;
    for (int a = 0; a < size_; ++a)
      for (int b = 0; b < size_; ++b)
        cost_[Z(a) * Z(size_) + Z(b)] = std::llround(distances(a, b) * units_per_m);
  }
  std::int64_t Cost(int a, int b, std::int64_t) override { return At(a, b); }
  std::int64_t AtLeast(int a, int b) override { return At(a, b); }
  std::int64_t EndCost(int a) const override { return closed_ ? At(a, 0) : 0; }

  CandidateEdges Candidates() const {
    CandidateEdges all;
    std::vector<CandidateEdge> edges;
    const auto less = [](const CandidateEdge& a, const CandidateEdge& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.to < b.to;
    };
    for (int a = 0; a < size_; ++a, all.Close()) {
      edges.clear();
      for (int b = 0; b < size_; ++b)
        if (b != a) edges.push_back({At(a, b), b});
      const auto count = static_cast<std::ptrdiff_t>(std::min(kCandidates, edges.size()));
      std::partial_sort(edges.begin(), edges.begin() + count, edges.end(), less);
      for (auto edge = edges.begin(); edge != edges.begin() + count; ++edge) all.Add(*edge);
    }
    return all;
  }

 private:
  std::int64_t At(int a, int b) const { return cost_[Z(a) * Z(size_) + Z(b)]; }

  int size_;
  std::vector<std::int64_t> cost_;  // row by row
  bool closed_;
};

class Tour final : public VisitOrder {
 public:
  void Visit(ParamVisitor& v) override {
    v("effort", effort_, Between(0, 1e6), "factor on the work of the local search");
    v("bound_iterations", bound_iterations_, Between(0, 1e6),
      "spanning trees made for the bound; 0: no bound but of a dozen places");
  }

  VisitSequence Order(const OrderRequest& request) const override {
    const PlaceDistances& distances = request.distances;
    VisitSequence found;
    const bool exact = distances.size() <= kMaxExactPlaces;
    found.order = exact ? ExactOrder(distances, request.closed) : Improved(request);
    found.length_m = TourLength(distances, found.order, request.closed);
    if (exact)
      found.bound_m = found.length_m * (1 - 1e-12);
    else if (bound_iterations_ > 0)
      found.bound_m = OneTreeBound(distances, request.closed, found.length_m, bound_iterations_);
    return found;
  }

 private:
  std::vector<int> Improved(const OrderRequest& request) const {
    const auto length_m = [&](const std::vector<int>& order) {
      return TourLength(request.distances, order, request.closed);
    };
    std::vector<std::vector<int>> first = {NearestNeighbourOrder(request.distances),
                                           OrderByRows(request, kRow_m)};
    if (request.distances.size() <= kMaxGreedy) first.push_back(GreedyOrder(request.distances));
    std::vector<int> order = *std::ranges::min_element(first, {}, length_m);
    TableCosts costs(request.distances, request.closed);
    ThreeOptOptions options;
    options.max_work = std::llround(effort_ * kStepsPerPlace * request.distances.size());
    options.heat = kHeat;
    const std::vector<int> start = order;
    ImproveTour(costs, costs.Candidates(), options, order);
    return length_m(order) < length_m(start) ? order : start;  // not for a rounding's sake
  }

  double effort_ = 1;
  int bound_iterations_ = 1000;
};

}  // namespace

FP_DEFINE_PLUGIN(VisitOrder, Tour)

}  // namespace floorproof
