// SPDX-License-Identifier: Apache-2.0
// How likely a key of a scenario has which value: drawn from a stream, or found by its quantile.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/streams.h"

namespace floorproof {

class MapSchema;

struct Distribution {
  enum class Kind { kUniform, kNormal, kLognormal, kChoice };
  Kind kind = Kind::kUniform;
  double a = 0, b = 0;               // mean, deviation; median, deviation of the logarithm
  double min = -1e308, max = 1e308;  // draws outside are drawn again
  std::vector<std::pair<double, double>> spans;  // [low, high), ascending; each place as likely
  std::vector<ConfigNode> choices;               // each as likely

  ConfigNode Draw(Stream& stream) const;
  // The value below which a draw lies with this probability, in (0, 1): of choices, each as wide,
  // in the order written. Bounds hold.
  ConfigNode Quantile(double probability) const;
  // Whether two draws can differ.
  bool varies() const;
};

// Reads {uniform: [low, high]} and so on; keys in `also_allowed` belong to somebody else. `path`
// names it in messages. Throws InputError.
Distribution ReadDistribution(const ConfigNode& node, const std::string& path,
                              const std::vector<std::string>& also_allowed = {});
// `others`: the keys that belong to somebody else.
ConfigNode DistributionSchema(const MapSchema& others);

}  // namespace floorproof
