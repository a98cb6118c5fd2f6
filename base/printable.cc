// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "base/utf8.h"

namespace floorproof {
namespace {

bool IsControl(std::uint32_t c) {
  return (c < 0x20 && c != '\n' && c != '\t') || (c >= 0x7f && c <= 0x9f) || c == 0x2028 ||
         c == 0x2029;
}

// Unicode's Bidi_Control.
bool TurnsDirection(std::uint32_t c) {
  return c == 0x061c || c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) ||
         (c >= 0x2066 && c <= 0x2069);
}

constexpr std::string_view kDots = "...";

// The bytes that the first characters take; a byte that is not UTF-8 counts as one.
std::size_t BytesOf(std::string_view text, std::size_t characters) {
  std::size_t at = 0;
  for (; characters > 0 && at < text.size(); --characters)
    at += std::max<std::size_t>(FirstCharacter(text.substr(at)).bytes, 1);
  return at;
}

// Stops counting at `most`.
std::size_t CountCharacters(std::string_view text, std::size_t most) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size() && count < most; ++count)
    at += BytesOf(text.substr(at), 1);
  return count;
}

}  // namespace

bool IsUtf8Text(std::string_view text) {
  while (!text.empty()) {
    const Character c = FirstCharacter(text);
    if (c.bytes == 0 || (c.code < 0x20 && c.code != '\n' && c.code != '\r' && c.code != '\t'))
      return false;
    text.remove_prefix(c.bytes);
  }
  return true;
}

std::string WhyUnprintable(std::string_view text) {
  while (!text.empty()) {
    const Character c = FirstCharacter(text);
    if (c.bytes == 0) return "is not UTF-8";
    if (IsControl(c.code)) return "holds a control character";
    if (TurnsDirection(c.code)) return "holds a mark of writing direction";
    text.remove_prefix(c.bytes);
  }
  return "";
}

std::string Printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = FirstCharacter(text);
    const bool shown = c.bytes > 0 && !IsControl(c.code) && !TurnsDirection(c.code);
    out += shown ? text.substr(0, c.bytes) : "?";
    text.remove_prefix(shown || c.bytes > 0 ? c.bytes : 1);
  }
  return out;
}

std::string PrintableLine(std::string_view text) {
  std::string line(text);
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return Printable(line);
}

std::string CutEnd(std::string_view text, std::size_t most) {
  if (CountCharacters(text, most + 1) <= most) return std::string(text);
  return std::string(text.substr(0, BytesOf(text, most - kDots.size()))) + std::string(kDots);
}

std::string CutMiddle(std::string_view text, std::size_t most) {
  const std::size_t count = CountCharacters(text, text.size());
  if (count <= most) return std::string(text);
  const std::size_t head = (most - kDots.size()) / 2, tail = most - kDots.size() - head;
  return std::string(text.substr(0, BytesOf(text, head))) + std::string(kDots) +
         std::string(text.substr(BytesOf(text, count - tail)));
}

std::string CsvField(const std::string& raw) {
  // A spreadsheet runs what begins like a formula; a number is none.
  double number = 0;
  const auto [end, error] = std::from_chars(raw.data(), raw.data() + raw.size(), number);
  const bool is_number = error == std::errc() && end == raw.data() + raw.size();
  const bool formula = !raw.empty() && !is_number &&
                       std::string_view("=+-@\t\r").find(raw.front()) != std::string_view::npos;
  const std::string text = (formula ? "'" : "") + Printable(raw);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace floorproof
