// SPDX-License-Identifier: Apache-2.0
// The contract of orders of visit: in which order a robot goes to places of which the distances
// between them are known. A new order is one file in this folder and one line in list.inc.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/geometry/geometry.h"
#include "planners/search/index.h"

namespace floorproof {

// Metres between places 0, 1, ..., the same both ways, finite and not below 0. Place 0 is the
// start. Ways round walls are longer than straight lines: nothing else is assumed of them.
class PlaceDistances {
 public:
  explicit PlaceDistances(int places) : size_(places), m_(Z(places) * Z(places), 0.0) {}

  int size() const { return size_; }
  double operator()(int a, int b) const { return m_[Z(a) * Z(size_) + Z(b)]; }
  void Set(int a, int b, double distance_m) {
    m_[Z(a) * Z(size_) + Z(b)] = m_[Z(b) * Z(size_) + Z(a)] = distance_m;
  }
  // To every place from a, by place.
  std::span<const double> From(int a) const {
    return std::span(m_).subspan(Z(a) * Z(size_), Z(size_));
  }
  double Greatest() const { return m_.empty() ? 0 : *std::ranges::max_element(m_); }

 private:
  int size_;
  std::vector<double> m_;  // row by row
};

struct OrderRequest {
  const PlaceDistances& distances;
  std::span<const Vec2> places;  // p_W (m), as many as `distances` has; places[0] is the start
  bool closed = false;           // the way back to the start counts, too
  std::uint64_t seed = 0;
};

struct VisitSequence {
  std::vector<int> order;           // each place once, 0 first
  double length_m = 0;              // TourLength of `order`
  std::vector<double> convergence;  // best length after each iteration (m); empty: it has none
  std::optional<double> bound_m;    // no order is shorter; none: it proves nothing
};

class VisitOrder : public Configurable {
 public:
  // The same request gives the same sequence. No place, no order.
  virtual VisitSequence Order(const OrderRequest& request) const = 0;
};

std::span<const PluginEntry<VisitOrder>> VisitOrders();

// The sum of the distances from each place of `order` to the next one, in that order; where
// `closed`, and back to the first.
double TourLength(const PlaceDistances& distances, std::span<const int> order, bool closed);

// 0, 1, ..., n - 1.
std::vector<int> AsNumbered(int places);

}  // namespace floorproof
