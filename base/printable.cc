// SPDX-License-Identifier: Apache-2.0
#include "base/printable.h"

#include <charconv>
#include <cstdint>

namespace floorproof {
namespace {

// The character at the text's beginning and how many bytes it takes; 0: no UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;
};

Character First(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || code > 0x10ffff || surrogate) return {};
  return {code, bytes};
}

bool IsControl(std::uint32_t c) {
  return (c < 0x20 && c != '\n' && c != '\t') || (c >= 0x7f && c <= 0x9f) || c == 0x2028 ||
         c == 0x2029;
}

// Unicode's Bidi_Control.
bool TurnsDirection(std::uint32_t c) {
  return c == 0x061c || c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) ||
         (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

bool IsUtf8Text(std::string_view text) {
  while (!text.empty()) {
    const Character c = First(text);
    if (c.bytes == 0 || (c.code < 0x20 && c.code != '\n' && c.code != '\r' && c.code != '\t'))
      return false;
    text.remove_prefix(c.bytes);
  }
  return true;
}

std::string WhyUnprintable(std::string_view text) {
  while (!text.empty()) {
    const Character c = First(text);
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
    const Character c = First(text);
    const bool shown = c.bytes > 0 && !IsControl(c.code) && !TurnsDirection(c.code);
    out += shown ? text.substr(0, c.bytes) : "?";
    text.remove_prefix(shown || c.bytes > 0 ? c.bytes : 1);
  }
  return out;
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
