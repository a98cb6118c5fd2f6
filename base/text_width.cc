// SPDX-License-Identifier: Apache-2.0
#include "base/text_width.h"

#include <locale.h>  // NOLINT: newlocale and uselocale are POSIX
#include <wchar.h>   // NOLINT: and so is wcwidth

#include <algorithm>
#include <cctype>

#include "base/utf8.h"

namespace floorproof {
namespace {

// The C library's table of widths, whatever locale the process is in. Where even C.UTF-8 is missing
// each character counts as one column.
class Widths {
 public:
  Widths() : before_(Utf8() == nullptr ? nullptr : uselocale(Utf8())) {}
  ~Widths() {
    if (before_ != nullptr) uselocale(before_);
  }
  Widths(const Widths&) = delete;
  Widths& operator=(const Widths&) = delete;

  int Of(std::uint32_t code) const {
    const int columns = before_ == nullptr ? 1 : wcwidth(static_cast<wchar_t>(code));
    return columns < 0 ? 1 : columns;
  }

 private:
  static locale_t Utf8() {
    static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return utf8;
  }

  locale_t before_;
};

// Takes the first character off a text; a byte that is no UTF-8 is one column.
struct Taken {
  std::string_view bytes;
  int columns = 0;
};
Taken Take(std::string_view& text, const Widths& widths) {
  const Character c = FirstCharacter(text);
  const std::string_view bytes = text.substr(0, std::max<std::size_t>(c.bytes, 1));
  text.remove_prefix(bytes.size());
  return {bytes, c.bytes == 0 ? 1 : widths.Of(c.code)};
}

// What a line is not broken within.
struct Piece {
  std::string text;
  int columns = 0;
  bool spaced = false;  // a space stands before it
};

std::vector<Piece> Pieces(std::string_view text) {
  const Widths widths;
  std::vector<Piece> pieces;
  bool open = false, spaced = false, wide = false;
  while (!text.empty()) {
    const Taken next = Take(text, widths);
    if (next.bytes == " ") {
      const auto is = [](int (*of)(int), char c) { return of(static_cast<unsigned char>(c)) != 0; };
      const bool unit = open && is(std::isdigit, pieces.back().text.back()) && !text.empty() &&
                        (is(std::isalpha, text.front()) || text.front() == '%');
      if (!unit) {
        open = false;
        spaced = true;
        continue;
      }
    }
    // A mark goes with the character that it stands on.
    const bool breaks = next.columns > 0 && (wide || next.columns > 1);
    if (!open || breaks) pieces.push_back({"", 0, !pieces.empty() && spaced});
    pieces.back().text += next.bytes;
    pieces.back().columns += next.columns;
    open = true;
    spaced = false;
    if (next.columns > 0) wide = next.columns > 1;
  }
  return pieces;
}

}  // namespace

int DisplayWidth(std::string_view text) {
  const Widths widths;
  int columns = 0;
  while (!text.empty()) columns += Take(text, widths).columns;
  return columns;
}

std::vector<std::string> WrapText(std::string_view text, int width) {
  std::vector<std::string> lines(1);
  int columns = 0;
  for (const Piece& piece : Pieces(text)) {
    const int space = piece.spaced ? 1 : 0;
    if (columns > 0 && columns + space + piece.columns > width) {
      lines.emplace_back();
      columns = 0;
    } else if (piece.spaced) {
      lines.back() += ' ';
      ++columns;
    }
    lines.back() += piece.text;
    columns += piece.columns;
  }
  return lines;
}

std::string CutText(std::string_view text, int width) {
  if (DisplayWidth(text) <= width) return std::string(text);
  const Widths widths;
  std::string cut;
  for (int columns = 1; !text.empty();) {
    const Taken next = Take(text, widths);
    columns += next.columns;
    if (columns > width) break;
    cut += next.bytes;
  }
  return cut + "…";
}

}  // namespace floorproof
