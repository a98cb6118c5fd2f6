// SPDX-License-Identifier: Apache-2.0
// Letters are drawn in a font of the system: ASCII by itself, runs of other letters with the blanks
// between their words. Where no font is installed ASCII is OpenCV's stroke font, drawn three times
// too large and averaged down, so that strokes as thin as a pixel come out even.
#include "render/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/lettering.h"

namespace floorproof {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kCapUnits = 22;  // cap height of that font at scale 1, px
constexpr int kOver = 3;

// Bytes of the letter that begins there; 0: none does.
std::size_t LetterBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t n = byte(0) < 0x80                       ? 1
                        : byte(0) >= 0xC2 && byte(0) < 0xE0  ? 2
                        : (byte(0) & 0xF0) == 0xE0           ? 3
                        : byte(0) >= 0xF0 && byte(0) <= 0xF4 ? 4
                                                             : 0;
  if (n == 0 || n > text.size()) return 0;
  for (std::size_t i = 1; i < n; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  return n;
}

bool IsControl(std::string_view letter) {  // C0, DEL, C1
  const auto first = static_cast<unsigned char>(letter[0]);
  return first < 32 || first == 127 ||
         (first == 0xC2 && static_cast<unsigned char>(letter[1]) < 0xA0);
}

std::string Escaped(std::string_view letters) {
  std::string out;
  while (!letters.empty()) {
    const std::size_t n = LetterBytes(letters);
    unsigned code = static_cast<unsigned char>(letters[0]);
    if (n == 1) {
      out += letters[0];
    } else {
      code &= 0xFFu >> (n + 1);
      for (std::size_t i = 1; i < n; ++i)
        code = code << 6 | (static_cast<unsigned char>(letters[i]) & 0x3F);
      char text[12];
      std::snprintf(text, sizeof text, code > 0xFFFF ? "\\U%08x" : "\\u%04x", code);
      out += text;
    }
    letters.remove_prefix(n);
  }
  return out;
}

// Printable text, cut where ASCII changes to other letters and back.
struct Run {
  std::string text;
  bool ascii = true;
};
std::vector<Run> Runs(std::string_view text) {
  std::vector<Run> runs;
  while (!text.empty()) {
    const std::size_t n = LetterBytes(text);
    std::string letter = n == 0 || IsControl(text) ? "?" : std::string(text.substr(0, n));
    text.remove_prefix(std::max<std::size_t>(1, n));
    const bool ascii = letter.size() == 1;
    // A blank between words of other letters belongs to them: words follow in their direction.
    const bool joins = letter == " " && !runs.empty() && !runs.back().ascii && !text.empty() &&
                       LetterBytes(text) > 1;
    if (runs.empty() || (runs.back().ascii != ascii && !joins)) runs.push_back({"", ascii});
    runs.back().text += letter;
  }
  return runs;
}

struct Strokes {
  std::string text;
  double scale;
  int thickness;
  cv::Size size;  // px, kOver times too large
  int below;      // of letters that reach below the base line, px
};
Strokes LayOut(std::string text, const TextStyle& style) {
  Strokes l;
  l.text = std::move(text);
  l.scale = kOver * style.cap_px / kCapUnits;
  l.thickness = std::max(
      1, static_cast<int>(std::lround(kOver * style.cap_px * (style.bold ? 0.135 : 0.085))));
  l.size = cv::getTextSize(l.text, kFont, l.scale, l.thickness, &l.below);
  l.below += l.thickness;
  return l;
}

// A run that is drawn: its coverage, and where its begin on the base line is in it.
struct Drawn {
  Image coverage;
  int left = 0, base = 0;
};
Drawn Draw(const Strokes& l) {
  const int pad = kOver * 2;
  const auto whole = [](int v) { return (v + kOver - 1) / kOver * kOver; };
  cv::Mat large(whole(l.size.height + l.below + 2 * pad), whole(l.size.width + 2 * pad), CV_8U,
                cv::Scalar(0));
  const int above = whole(l.size.height + pad);
  cv::putText(large, l.text, {pad, above}, kFont, l.scale, cv::Scalar(255), l.thickness,
              cv::LINE_AA);
  cv::Mat mask;
  cv::resize(large, mask, {large.cols / kOver, large.rows / kOver}, 0, 0, cv::INTER_AREA);
  Drawn out;
  out.coverage.width = mask.cols;
  out.coverage.height = mask.rows;
  out.coverage.channels = 1;
  out.coverage.data.assign(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>());
  out.left = pad / kOver;
  out.base = above / kOver;
  return out;
}

std::uint8_t Mix(std::uint8_t under, std::uint8_t over, int alpha_255) {
  return static_cast<std::uint8_t>((under * (255 - alpha_255) + over * alpha_255 + 127) / 255);
}

void Paint(Image& image, int left, int top, const Image& mask, const Rgb& colour) {
  for (int r = std::max(0, -top); r < std::min(mask.height, image.height - top); ++r) {
    const std::uint8_t* alpha =
        mask.data.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(mask.width);
    std::uint8_t* row =
        image.data.data() + static_cast<std::size_t>(top + r) * image.width * image.channels;
    for (int c = std::max(0, -left); c < std::min(mask.width, image.width - left); ++c) {
      if (alpha[c] == 0) continue;
      std::uint8_t* pixel = row + static_cast<std::ptrdiff_t>(left + c) * image.channels;
      for (int k = 0; k < 3; ++k) pixel[k] = Mix(pixel[k], colour[k], alpha[c]);
    }
  }
}

// Calls visit(x, strokes, lettering) for each run, one of the two empty, and returns the width of
// all. Words that no one font has together are drawn each in its own.
template <class Visit>
double ForEachRun(std::string_view text, const TextStyle& style, const Visit& visit) {
  double width_px = 0;
  const auto letter = [&](const std::string& words) {
    const std::optional<Lettering> letters = DrawLettering(words, style.cap_px, style.bold);
    if (!letters) return false;
    visit(width_px, Strokes{}, *letters);
    width_px += letters->advance_px;
    return true;
  };
  const auto plain = [&](std::string ascii) {
    if (letter(ascii)) return;
    const Strokes strokes = LayOut(std::move(ascii), style);
    visit(width_px, strokes, Lettering{});
    width_px += static_cast<double>(strokes.size.width) / kOver;
  };
  for (const Run& run : Runs(text)) {
    if (run.ascii) {
      plain(run.text);
    } else if (!letter(run.text)) {
      for (std::size_t from = 0; from < run.text.size();) {
        const std::size_t blank = std::min(run.text.find(' ', from), run.text.size());
        const std::string word = run.text.substr(from, blank - from);
        if (!word.empty() && !letter(word)) plain(Escaped(word));
        if (blank < run.text.size()) plain(" ");
        from = blank + 1;
      }
    }
  }
  return width_px;
}

}  // namespace

std::string_view WithoutLastLetter(std::string_view text) {
  std::size_t n = text.size();
  while (n > 0 && (static_cast<unsigned char>(text[n - 1]) & 0xC0) == 0x80) --n;
  return text.substr(0, n > 0 ? n - 1 : 0);
}

double TextWidth(std::string_view text, const TextStyle& style) {
  return ForEachRun(text, style, [](double, const Strokes&, const Lettering&) {});
}

void DrawText(Image& image, double x_px, double y_px, std::string_view text,
              const TextStyle& style) {
  const double share = style.anchor == Anchor::kLeft     ? 0
                       : style.anchor == Anchor::kCentre ? 0.5
                                                         : 1;
  const double shift = share > 0 ? share * TextWidth(text, style) : 0;
  const int row = static_cast<int>(std::lround(y_px));
  ForEachRun(text, style, [&](double at_px, const Strokes& strokes, const Lettering& letters) {
    const int column = static_cast<int>(std::lround(x_px - shift + at_px));
    if (letters.coverage.width > 0) {
      Paint(image, column, row - letters.base, letters.coverage, style.colour);
    } else if (!strokes.text.empty()) {
      const Drawn drawn = Draw(strokes);
      Paint(image, column - drawn.left, row - drawn.base, drawn.coverage, style.colour);
    }
  });
}

void FillRectangle(Image& image, int x0, int y0, int x1, int y1, const Rgb& colour, double alpha) {
  x0 = std::max(x0, 0);
  y0 = std::max(y0, 0);
  x1 = std::min(x1, image.width);
  y1 = std::min(y1, image.height);
  const int a = static_cast<int>(std::lround(255 * std::clamp(alpha, 0.0, 1.0)));
  for (int y = y0; y < y1; ++y) {
    std::uint8_t* pixel =
        image.data.data() + (static_cast<std::size_t>(y) * image.width + x0) * image.channels;
    for (int x = x0; x < x1; ++x, pixel += image.channels) {
      for (int k = 0; k < 3; ++k) pixel[k] = Mix(pixel[k], colour[k], a);
    }
  }
}

}  // namespace floorproof
