// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"

#include <algorithm>
#include <vector>

#include "base/printable.h"

namespace floorproof {
namespace {

// A message is one line of bounded length, whatever a file holds or is called.
constexpr std::size_t kMaxOfAValue = 80, kMaxOfARule = 500;

std::string OneLine(std::string_view text, std::size_t most = std::string_view::npos) {
  std::size_t end = std::min(text.size(), most);
  // Not in the middle of a UTF-8 character.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end;
  std::string out(text.substr(0, end));
  for (char& c : out) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x20 || u == 0x7f) c = ' ';
  }
  out = Printable(out);
  if (end < text.size()) out += "...";
  return out;
}

std::string Compose(const SourceMark& mark, std::string_view key, std::string_view value,
                    std::string_view rule) {
  std::string out = OneLine(mark.file);
  if (mark.line > 0) out += ":" + std::to_string(mark.line);
  if (!out.empty()) out += ": ";
  out += OneLine(key, kMaxOfAValue);
  if (!value.empty()) out += (key.empty() ? "" : " = ") + OneLine(value, kMaxOfAValue);
  if (!key.empty() || !value.empty()) out += ": ";
  return out + OneLine(rule, kMaxOfARule);
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

InputError::InputError(const std::string& message) : std::runtime_error(OneLine(message)) {}

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
