// SPDX-License-Identifier: Apache-2.0
// Netpbm's PGM and PPM, plain (P2, P3) and raw (P5, P6). A header is magic, width, height and
// maxval with white space and '#' comments between them; one white-space byte ends it.
#include "media/netpbm.h"

#include <cctype>
#include <string>

namespace floorproof {
namespace {

// Reads unsigned numbers between white space and comments.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  std::size_t at() const { return at_; }
  void Skip(std::size_t n) { at_ += n; }

  // The next number, at most `limit`; throws FormatError naming `what`.
  std::uint32_t Number(std::uint32_t limit, const char* what) {
    SkipSpace();
    if (at_ >= text_.size()) throw FormatError(std::string("truncated: it ends before ") + what);
    if (!IsDigit(text_[at_]))
      throw FormatError(std::string("no number where ") + what + " should be, at byte " +
                        std::to_string(at_));
    std::uint64_t value = 0;
    for (; at_ < text_.size() && IsDigit(text_[at_]); ++at_) {
      value = value * 10 + static_cast<std::uint64_t>(text_[at_] - '0');
      if (value > limit)
        throw FormatError(std::string(what) + " is more than " + std::to_string(limit) +
                          ", at byte " + std::to_string(at_));
    }
    return static_cast<std::uint32_t>(value);
  }

 private:
  static bool IsDigit(char c) { return c >= '0' && c <= '9'; }
  void SkipSpace() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
      } else if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
        ++at_;
      } else {
        return;
      }
    }
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

struct Header : ImageHeader {
  bool plain = false;
  int channels = 1;
  std::uint32_t maxval = 255;
  std::size_t data_at = 0;
  std::uint64_t samples() const {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) *
           static_cast<std::uint64_t>(channels);
  }
};

Header Parse(std::string_view start, std::uint64_t file_size) {
  Header h;
  h.plain = start[1] == '2' || start[1] == '3';
  h.channels = start[1] == '3' || start[1] == '6' ? 3 : 1;
  Reader reader(start);
  reader.Skip(2);
  constexpr std::uint32_t kSide = 1'000'000'000;  // so that the area fits 64 bits
  h.width = reader.Number(kSide, "the width");
  h.height = reader.Number(kSide, "the height");
  h.maxval = reader.Number(65535, "the largest value");
  if (h.maxval == 0) throw FormatError("the largest value must be > 0");
  if (reader.at() >= start.size()) throw FormatError("truncated: it ends after its header");
  h.data_at = reader.at() + 1;
  // A raw sample takes one or two bytes, a plain one at least a digit and a space.
  const std::uint64_t bytes = h.plain ? 2 * h.samples() - (h.samples() > 0 ? 1 : 0)
                                      : h.samples() * (h.maxval > 255 ? 2 : 1);
  if (file_size - h.data_at < bytes)
    throw FormatError("truncated: it claims " + std::to_string(h.width) + " x " +
                      std::to_string(h.height) + " pixels, more than its " +
                      std::to_string(file_size) + " bytes can hold");
  return h;
}

}  // namespace

bool IsNetpbm(std::string_view file) {
  return file.size() > 2 && file[0] == 'P' &&
         (file[1] == '2' || file[1] == '3' || file[1] == '5' || file[1] == '6');
}

ImageHeader ReadNetpbmHeader(std::string_view start, std::uint64_t file_size) {
  return Parse(start, file_size);
}

Image DecodeNetpbm(std::string_view file) {
  const Header h = Parse(file, file.size());
  Image image;
  image.width = static_cast<int>(h.width);
  image.height = static_cast<int>(h.height);
  image.channels = h.channels;
  image.sixteen_bit = h.maxval > 255;
  image.data.resize(h.samples());
  const auto scale = [&](std::uint32_t v) {
    return static_cast<std::uint8_t>((v * 255U + h.maxval / 2) / h.maxval);
  };
  if (h.plain) {
    Reader reader(file);
    reader.Skip(h.data_at);
    for (auto& sample : image.data) sample = scale(reader.Number(h.maxval, "a pixel's value"));
    return image;
  }
  const std::size_t size = h.maxval > 255 ? 2 : 1;
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < size; ++k)
      v = v << 8 | static_cast<unsigned char>(file[h.data_at + i * size + k]);
    if (v > h.maxval)
      throw FormatError("a pixel's value " + std::to_string(v) + " is more than the largest, " +
                        std::to_string(h.maxval));
    image.data[i] = scale(v);
  }
  return image;
}

}  // namespace floorproof
