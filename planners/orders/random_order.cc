// SPDX-License-Identifier: Apache-2.0
// The places behind the start, shuffled (Fisher & Yates): every order is as likely as any other.
//
// The sampling paper's random selection (section 6.2), which every method ought to beat.
// Not done: looking at the distances.
#include <utility>

#include "base/streams.h"
#include "planners/orders/visit_order.h"

namespace floorproof {
namespace {

class RandomOrder final : public VisitOrder {
 public:
  VisitSequence Order(const OrderRequest& request) const override {
    Stream random(request.seed, 0, "random_order");
    VisitSequence found;
    found.order = AsNumbered(request.distances.size());
    for (std::size_t left = found.order.size(); left > 2; --left)
      std::swap(found.order[left - 1], found.order[1 + random.Below(left - 1)]);
    found.length_m = TourLength(request.distances, found.order, request.closed);
    return found;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(VisitOrder, RandomOrder)

}  // namespace floorproof
