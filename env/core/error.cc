// SPDX-License-Identifier: Apache-2.0
#include "env/core/error.h"

#include <algorithm>
#include <vector>

namespace floorproof {
namespace {

// A message is one line of bounded length, whatever a file holds.
std::string OneLine(std::string_view text) {
  constexpr std::size_t kMost = 80;
  std::string out;
  for (const char c : text.substr(0, kMost)) {
    const auto u = static_cast<unsigned char>(c);
    out += u < 0x20 || u == 0x7f ? ' ' : c;
  }
  if (text.size() > kMost) out += "...";
  return out;
}

std::string Compose(const SourceMark& mark, std::string_view key, std::string_view value,
                    std::string_view rule) {
  std::string out = mark.file;
  if (mark.line > 0) out += ":" + std::to_string(mark.line);
  if (!out.empty()) out += ": ";
  out += key;
  if (!value.empty()) out += (key.empty() ? "" : " = ") + OneLine(value);
  if (!key.empty() || !value.empty()) out += ": ";
  return out + std::string(rule);
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substitute, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

InputError::InputError(const SourceMark& mark, std::string_view key, std::string_view value,
                       std::string_view rule)
    : std::runtime_error(Compose(mark, key, value, rule)) {}

std::string Nearest(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  // Beyond half the word's length a suggestion is noise.
  std::size_t best_distance = std::min<std::size_t>(word.size(), 64) / 2 + 1;
  if (word.size() > 64) return best;
  for (const auto& candidate : candidates) {
    // A word left unfinished (`y` for `y_m`) is near, however short.
    const bool begun = !word.empty() && candidate.starts_with(word);
    const std::size_t d = begun ? 0 : EditDistance(word, candidate);
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace floorproof
