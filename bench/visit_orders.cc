// SPDX-License-Identifier: Apache-2.0
// How long the ways of all orders of visit are, and what they cost: places drawn in a square, each
// order's length over the tour's proven bound (1: none is shorter), open and closed, and seconds of
// one core. Swarms do not take part where there are very many places.
//   bench_visit_orders [SEEDS]
#include <fmt/core.h>

#include <cmath>
#include <iostream>
#include <map>

#include "base/streams.h"
#include "bench/cpu_time.h"
#include "planners/orders/visit_order.h"

namespace floorproof {
namespace {

std::vector<Vec2> Draw(int count, std::uint64_t seed) {
  Stream random(seed, 0, "places");
  std::vector<Vec2> places;
  for (int i = 0; i < count; ++i) {
    const double x_m = random.Uniform(0, 30), y_m = random.Uniform(0, 30);
    places.push_back({x_m, y_m});
  }
  return places;
}

struct Sums {
  double ratio = 0, seconds = 0;
};

void Compare(int count, bool closed, std::uint64_t seeds) {
  std::map<std::string_view, Sums> sums;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const std::vector<Vec2> places = Draw(count, seed);
    PlaceDistances distances(count);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < a; ++b) distances.Set(a, b, (places[Z(a)] - places[Z(b)]).norm());
    double bound_m = 0;
    for (const auto& entry : VisitOrders()) {  // the first one has the bound
      const auto dut = entry.make();
      ConfigNode params = ConfigNode::Map();
      WriteParams(*dut, params);
      if (count >= 1000 && params.Find("iterations")) continue;
      const double begin = CpuSeconds();
      const VisitSequence found = dut->Order({distances, places, closed, seed});
      sums[entry.name].seconds += CpuSeconds() - begin;
      if (found.bound_m) bound_m = *found.bound_m;
      sums[entry.name].ratio += found.length_m / bound_m;
    }
  }
  for (const auto& [name, sum] : sums)
    fmt::print("{:6} {:6} {:14} {:12.4f} {:8.2f}\n", count, closed ? "closed" : "open", name,
               sum.ratio / static_cast<double>(seeds), sum.seconds / static_cast<double>(seeds));
  std::cout.flush();
}

int Main(int argc, char** argv) {
  const std::uint64_t seeds = argc > 1 ? std::stoull(argv[1]) : 3;
  fmt::print("{:>6} {:6} {:14} {:>12} {:>8}\n", "places", "", "order", "length/bound", "s");
  for (const int count : {30, 60, 200, 1000})
    for (const bool closed : {false, true}) Compare(count, closed, seeds);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
