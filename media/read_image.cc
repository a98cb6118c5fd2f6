// SPDX-License-Identifier: Apache-2.0
// Image files: the header is read and checked first, then the whole file, then it is decoded (PGM
// and PPM here, PNG and BMP by the codec module).
#include <string>

#include "base/error.h"
#include "media/codecs.h"
#include "media/image_header.h"
#include "media/media.h"
#include "media/netpbm.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStartBytes = 64 * 1024;  // room for a header with long comments

ImageHeader ReadHeader(std::string_view start, std::uint64_t file_size) {
  if (IsNetpbm(start)) return ReadNetpbmHeader(start, file_size);
  if (IsPng(start)) return ReadPngHeader(start);
  if (IsBmp(start)) return ReadBmpHeader(start, file_size);
  if (start.empty()) throw FormatError("is empty");
  throw FormatError("is not an image that can be read (PNG, PGM, PPM or BMP)");
}

// What the module gave, brought to 8 bits and to the channels stored in the file.
Image ToImage(const CodecImage& decoded, const PngHeader* png) {
  Image image;
  image.width = decoded.width;
  image.height = decoded.height;
  image.sixteen_bit = decoded.depth_bits == 16;
  const bool grey_alpha = png != nullptr && decoded.channels == 4 && png->color_type == 4;
  const bool grey_key = png != nullptr && decoded.channels == 1 && png->transparent_grey;
  image.channels = grey_alpha || grey_key ? 2 : decoded.channels;
  const std::size_t pixels =
      static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height);
  const auto in_channels = static_cast<std::size_t>(decoded.channels);
  image.data.reserve(pixels * static_cast<std::size_t>(image.channels));

  const auto sample = [&](std::size_t i) -> unsigned {
    return image.sixteen_bit ? static_cast<const std::uint16_t*>(decoded.data)[i]
                             : static_cast<const std::uint8_t*>(decoded.data)[i];
  };
  const auto eight = [&](unsigned v) {
    return static_cast<std::uint8_t>(image.sixteen_bit ? (v + 128) / 257 : v);
  };
  unsigned key = 0;
  if (grey_key) {
    const unsigned top = (1U << png->bit_depth) - 1;
    key = static_cast<unsigned>(*png->transparent_grey) & top;
    if (png->bit_depth < 8) key = key * 255 / top;  // as the decoder spreads grey levels
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = i * in_channels;
    if (grey_key) {
      image.data.push_back(eight(sample(at)));
      image.data.push_back(sample(at) == key ? 0 : 255);
    } else if (grey_alpha) {
      image.data.push_back(eight(sample(at)));
      image.data.push_back(eight(sample(at + 3)));
    } else {
      for (std::size_t k = 0; k < in_channels; ++k) image.data.push_back(eight(sample(at + k)));
    }
  }
  return image;
}

Image DecodeWithModule(std::string_view file, const ImageHeader& header, const PngHeader* png) {
  char error[kCodecErrorSize] = "";
  CodecImage decoded{};
  void* raw = nullptr;
  const CodecApi& codecs = Codecs();
  if (codecs.decode(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), &decoded, &raw,
                    error) != 0)
    throw FormatError(std::string("cannot be decoded: ") + error);
  const CodecHandle handle(raw, codecs.release);
  if (decoded.width != header.width || decoded.height != header.height)
    throw FormatError("decodes to another size than its header claims");
  return ToImage(decoded, png);
}

Image Decode(const fs::path& path, std::int64_t max_pixels, const InputFiles& files) {
  const std::string start = files.ReadStart(path, kStartBytes, kMaxImageBytes);
  CheckSize(ReadHeader(start, files.Size(path)), max_pixels);

  const std::string& file = files.Read(path, kMaxImageBytes);
  const ImageHeader header = ReadHeader(file, file.size());  // of what is decoded
  CheckSize(header, max_pixels);
  if (IsNetpbm(file)) return DecodeNetpbm(file);
  if (!IsPng(file)) return DecodeWithModule(file, header, nullptr);
  const PngHeader png = CheckPng(file);
  return DecodeWithModule(file, header, &png);
}

}  // namespace

Image ReadImage(const fs::path& path, std::int64_t max_pixels, const InputFiles& files) {
  try {
    return Decode(path, max_pixels, files);
  } catch (const FormatError& e) {
    throw InputError({path.string(), 0}, "", "", e.what());
  }
}

}  // namespace floorproof
