// SPDX-License-Identifier: Apache-2.0
#include "env/core/sample_place.h"

namespace floorproof {

std::vector<std::string_view> Names(const SampleKinds& kinds) {
  std::vector<std::string_view> names;
  if (kinds.given) names.push_back("given");
  if (kinds.corner) names.push_back("corner");
  if (kinds.boundary) names.push_back("boundary");
  if (kinds.random) names.push_back("random");
  return names;
}

}  // namespace floorproof
