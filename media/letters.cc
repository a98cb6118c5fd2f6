// SPDX-License-Identifier: Apache-2.0
// Fontconfig says which installed font has the letters; OpenCV's module `freetype` shapes them with
// HarfBuzz (joined, stacked, from right to left as their script wants) and draws them.
#include "media/letters.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

namespace floorproof {
namespace {

constexpr double kCapOfEm = 0.72;  // capital letters of most fonts, as a share of the nominal size
constexpr int kMargin_px = 3;

template <class T, void (*Free)(T*)>
struct Freed {
  void operator()(T* p) const { Free(p); }
};
using Pattern = std::unique_ptr<FcPattern, Freed<FcPattern, FcPatternDestroy>>;
using CharSet = std::unique_ptr<FcCharSet, Freed<FcCharSet, FcCharSetDestroy>>;
using FontSet = std::unique_ptr<FcFontSet, Freed<FcFontSet, FcFontSetDestroy>>;

struct Font {
  std::string file;  // empty: none has all letters
  int index = 0;
  bool operator<(const Font& other) const {
    return std::pair(file, index) < std::pair(other.file, other.index);
  }
};

CharSet LettersOf(const std::string& utf8) {
  CharSet letters(FcCharSetCreate());
  const auto* at = reinterpret_cast<const FcChar8*>(utf8.data());
  for (int left = static_cast<int>(utf8.size()); left > 0;) {
    FcChar32 letter = 0;
    const int bytes = FcUtf8ToUcs4(at, &letter, left);
    if (bytes <= 0) throw std::runtime_error("is no UTF-8");
    FcCharSetAddChar(letters.get(), letter);
    at += bytes;
    left -= bytes;
  }
  return letters;
}

// The first of those that the system prefers for text without serifs.
Font FindFont(const std::string& utf8, bool bold) {
  if (!FcInit()) return {};
  const CharSet letters = LettersOf(utf8);
  const Pattern wanted(FcPatternCreate());
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  FcPatternAddInteger(wanted.get(), FC_WEIGHT, bold ? FC_WEIGHT_BOLD : FC_WEIGHT_REGULAR);
  FcPatternAddBool(wanted.get(), FC_OUTLINE, FcTrue);
  FcPatternAddCharSet(wanted.get(), FC_CHARSET, letters.get());
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const FontSet fonts(FcFontSort(nullptr, wanted.get(), FcFalse, nullptr, &result));
  for (int i = 0; fonts && i < fonts->nfont; ++i) {
    FcCharSet* has = nullptr;
    FcChar8* file = nullptr;
    FcBool outline = FcFalse;
    int index = 0;
    if (FcPatternGetCharSet(fonts->fonts[i], FC_CHARSET, 0, &has) != FcResultMatch ||
        FcPatternGetString(fonts->fonts[i], FC_FILE, 0, &file) != FcResultMatch ||
        FcPatternGetBool(fonts->fonts[i], FC_OUTLINE, 0, &outline) != FcResultMatch || !outline ||
        !FcCharSetIsSubset(letters.get(), has))
      continue;
    FcPatternGetInteger(fonts->fonts[i], FC_INDEX, 0, &index);
    return {reinterpret_cast<const char*>(file), index & 0xFFFF};
  }
  return {};
}

}  // namespace

std::unique_ptr<DrawnLetters> DrawLetters(const std::string& utf8, double cap_px, bool bold) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, bool>, Font> known;
  static std::map<Font, cv::Ptr<cv::freetype::FreeType2>> loaded;
  const std::scoped_lock lock(mutex);
  // One font for all ASCII: numbers change from picture to picture, and to look for it takes longer
  // than to draw with it.
  const bool ascii = std::ranges::all_of(utf8, [](char c) { return c >= ' ' && c <= '~'; });
  const std::pair letters(ascii ? std::string("Az09%") : utf8, bold);
  auto found = known.find(letters);
  if (found == known.end()) found = known.emplace(letters, FindFont(letters.first, bold)).first;
  if (found->second.file.empty()) return nullptr;
  cv::Ptr<cv::freetype::FreeType2>& font = loaded[found->second];
  if (!font) {
    font = cv::freetype::createFreeType2();
    font->loadFontData(found->second.file, found->second.index);
  }
  const int size_px = std::max(1, static_cast<int>(std::lround(cap_px / kCapOfEm)));
  int below = 0;
  const cv::Size box = font->getTextSize(utf8, size_px, -1, &below);
  auto drawn = std::make_unique<DrawnLetters>();
  drawn->advance_px = box.width;
  drawn->base = 2 * size_px;
  cv::Mat colour(3 * size_px, box.width + 2 * kMargin_px, CV_8UC3, cv::Scalar::all(0));
  font->putText(colour, utf8, {kMargin_px, drawn->base}, size_px, cv::Scalar::all(255), -1,
                cv::LINE_AA, true);
  cv::extractChannel(colour, drawn->coverage, 0);
  // Cut to the margin on the left alone: letters begin at column 0.
  drawn->coverage = drawn->coverage.colRange(kMargin_px, drawn->coverage.cols).clone();
  return drawn;
}

}  // namespace floorproof
