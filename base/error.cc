// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <algorithm>
#include <vector>

#include "base/printable.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxValue = 60, kMaxName = 200, kMaxRule = 500;

std::string Compose(const SourceMark& mark, std::string_view key, std::string_view value,
                    std::string_view rule) {
  std::string out = CutMiddle(PrintableLine(mark.file), kMaxName);
  if (mark.line > 0) out += ":" + std::to_string(mark.line);
  if (!out.empty()) out += ": ";
  out += CutMiddle(PrintableLine(key), kMaxValue);
  if (!value.empty()) out += (key.empty() ? "" : " = ") + CutEnd(PrintableLine(value), kMaxValue);
  if (!key.empty() || !value.empty()) out += ": ";
  return out + CutEnd(ErrorLine(rule), kMaxRule);
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

std::string ErrorLine(std::string_view text) {
  const std::string line = PrintableLine(text);
  std::string out;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t space = std::min(line.find(' ', at), line.size());
    out += CutMiddle(std::string_view(line).substr(at, space - at), kMaxName);
    if (space < line.size()) out += ' ';
    at = space + 1;
  }
  return CutEnd(out, kMaxErrorLine);
}

InputError::InputError(const SourceMark& mark, std::string_view key, std::string_view value,
                       std::string_view rule)
    : std::runtime_error(Compose(mark, key, value, rule)) {}

InputError::InputError(const std::string& message) : std::runtime_error(ErrorLine(message)) {}

InternalError::InternalError(const std::string& message) : std::runtime_error(ErrorLine(message)) {}

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

std::string DidYouMean(std::string_view word, std::span<const std::string> candidates) {
  const std::string near = Nearest(word, candidates);
  return near.empty() ? near : "; did you mean " + near + "?";
}

std::string DidYouMeanOneOf(std::string_view word, std::span<const std::string> candidates) {
  std::string text = DidYouMean(word, candidates) + " (known:";
  for (const std::string& name : candidates) text += " " + name;
  return text + ")";
}

}  // namespace floorproof
