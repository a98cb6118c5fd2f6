// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include "planners/orders/visit_order.h"

namespace floorproof {

#define FP_VISIT_ORDER(Class, name, help) std::unique_ptr<VisitOrder> Make##Class();
#include "planners/orders/list.inc"
#undef FP_VISIT_ORDER

std::span<const PluginEntry<VisitOrder>> VisitOrders() {
  static constexpr PluginEntry<VisitOrder> kTable[] = {
#define FP_VISIT_ORDER(Class, name, help) {name, help, &Make##Class},
#include "planners/orders/list.inc"
#undef FP_VISIT_ORDER
  };
  return kTable;
}

double TourLength(const PlaceDistances& distances, std::span<const int> order, bool closed) {
  double sum_m = 0;
  for (std::size_t k = 1; k < order.size(); ++k) sum_m += distances(order[k - 1], order[k]);
  if (closed && order.size() > 1) sum_m += distances(order.back(), order.front());
  return sum_m;
}

std::vector<int> AsNumbered(int places) {
  std::vector<int> order(Z(places));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace floorproof
