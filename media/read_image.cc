// SPDX-License-Identifier: Apache-2.0
// Image files: the header is read and checked first, then the whole file, then it is decoded.
#include <string>

#include "base/error.h"
#include "media/codecs.h"
#include "media/image_header.h"
#include "media/media.h"
#include "media/module_call.h"
#include "media/netpbm.h"
#include "media/png_file.h"

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

Image DecodeBmpByModule(std::string_view file) {
  char error[kModuleErrorSize] = "";
  Image image;
  const std::uint8_t* pixels = nullptr;
  void* raw = nullptr;
  const CodecApi& codecs = Codecs();
  if (codecs.decode_bmp(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(),
                        &image.width, &image.height, &image.channels, &pixels, &raw, error) != 0)
    throw FormatError(std::string("cannot be decoded: ") + error);
  const ModuleHandle handle(raw, codecs.release_bmp);
  image.data.assign(pixels, pixels + static_cast<std::size_t>(image.width) *
                                         static_cast<std::size_t>(image.height) *
                                         static_cast<std::size_t>(image.channels));
  return image;
}

Image Decode(const fs::path& path, std::int64_t max_pixels, const InputFiles& files) {
  const std::string start = files.ReadStart(path, kStartBytes, kMaxImageBytes);
  CheckSize(ReadHeader(start, files.Size(path)), max_pixels);

  const std::string& file = files.Read(path, kMaxImageBytes);
  const ImageHeader header = ReadHeader(file, file.size());  // of what is decoded
  CheckSize(header, max_pixels);
  if (IsNetpbm(file)) return DecodeNetpbm(file);
  if (IsPng(file)) CheckPng(file);
  Image image = IsPng(file) ? DecodePng(file) : DecodeBmpByModule(file);
  if (image.width != header.width || image.height != header.height)
    throw FormatError("decodes to another size than its header claims");
  return image;
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
