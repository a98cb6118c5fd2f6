// SPDX-License-Identifier: Apache-2.0
// Short paths through all of a set of places of which only the costs between them are known.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace floorproof {

// Symmetric costs >= 0 between places 0, 1, ... Integers, so that sums are exact.
class LinkCosts {
 public:
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  virtual ~LinkCosts() = default;
  // What the link a - b costs; where that is not below `limit`, anything that is not either.
  virtual std::int64_t Cost(int a, int b, std::int64_t limit = kUnlimited) = 0;
  // At most Cost(a, b), in no time.
  virtual std::int64_t AtLeast(int a, int b) = 0;
  // What ending at a costs.
  virtual std::int64_t EndCost(int a) const = 0;

  std::int64_t work = 0;  // elementary steps taken to find costs
};

struct Link {
  std::int64_t cost = 0;
  int to = 0;
};

// Of each place the links worth making, the cheapest first.
struct NearLinks {
  std::vector<Link> links;
  std::vector<std::size_t> first = {0};  // by place, and the end

  std::span<const Link> Of(int a) const {
    const auto i = static_cast<std::size_t>(a);
    return {links.data() + first[i], first[i + 1] - first[i]};
  }
};

struct PathSearchOptions {
  bool fixed_end = false;      // the last place stays the last, as the first stays the first
  std::int64_t most_work = 0;  // elementary steps (a link looked at, eight places turned round)
};

// Shortens `path`, which holds each place once.
void ShortenPath(LinkCosts& costs, const NearLinks& near, const PathSearchOptions& options,
                 std::vector<int>& path);

}  // namespace floorproof
