// SPDX-License-Identifier: Apache-2.0
// libpng reports an error by a jump back to setjmp, over whatever lies between. So functions that
// call setjmp hold nothing that would have to be destroyed, and what they work on belongs to their
// callers.
#include "media/png_file.h"

#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include "base/error.h"
#include "media/image_header.h"

namespace floorproof {
namespace {

// Where libpng says what is wrong; it would print it otherwise.
struct Complaint {
  char text[200] = "";
};

[[noreturn]] void Complain(png_structp png, png_const_charp why) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::snprintf(complaint->text, sizeof complaint->text, "%s", why);
  png_longjmp(png, 1);
}
void Ignore(png_structp, png_const_charp) {}

struct Reader {
  Complaint complaint;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, Complain, Ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  std::string_view rest;  // of the file
  int passes = 1;         // seven where it is interlaced

  explicit Reader(std::string_view file) : rest(file) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void Take(png_structp png, png_bytep to, std::size_t size) {
  std::string_view& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest;
  if (rest.size() < size) png_error(png, "it ends too early");
  std::memcpy(to, rest.data(), size);
  rest.remove_prefix(size);
}

// Up to the pixels. `sixteen_bit`: as in the file.
bool ReadHeader(Reader& reader, bool& sixteen_bit) {
  png_structp png = reader.png;
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &reader, Take);
  // Only what makes the pixels: neither texts and profiles, which can be packed a thousandfold, nor
  // what a screen would make of the values.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(png, reader.info);
  sixteen_bit = png_get_bit_depth(png, reader.info) == 16;
  png_set_expand(png);
  png_set_scale_16(png);
  reader.passes = png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
  return true;
}

void ReadRows(const Reader& reader, std::size_t row, Image& image) {
  for (int pass = 0; pass < reader.passes; ++pass)
    for (std::size_t at = 0; at < image.data.size(); at += row)
      png_read_row(reader.png, image.data.data() + at, nullptr);
  png_read_end(reader.png, nullptr);
}

bool ReadPixels(Reader& reader, Image& image) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  ReadRows(reader, png_get_rowbytes(reader.png, reader.info), image);
  return true;
}

struct Writer {
  Complaint complaint;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, Complain, Ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  std::string file;

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

void Give(png_structp png, png_bytep from, std::size_t size) {
  std::string& file = static_cast<Writer*>(png_get_io_ptr(png))->file;
  bool given = true;
  try {
    file.append(reinterpret_cast<const char*>(from), size);
  } catch (...) {
    given = false;  // nothing is thrown through libpng
  }
  if (!given) png_error(png, "out of memory");
}
void Flush(png_structp) {}

bool Write(Writer& writer, const Image& image) {
  png_structp png = writer.png;
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &writer, Give, Flush);
  const int colour = image.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : image.channels == 3 ? PNG_COLOR_TYPE_RGB
                                           : PNG_COLOR_TYPE_RGB_ALPHA;
  png_set_IHDR(png, writer.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, colour, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // For speed: pictures are mostly plain.
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_set_compression_level(png, Z_BEST_SPEED);
  png_set_compression_strategy(png, Z_RLE);
  png_write_info(png, writer.info);
  const std::size_t row = image.data.size() / static_cast<std::size_t>(image.height);
  for (std::size_t at = 0; at < image.data.size(); at += row)
    png_write_row(png, image.data.data() + at);
  png_write_end(png, writer.info);
  return true;
}

}  // namespace

Image DecodePng(std::string_view file) {
  Reader reader(file);
  if (reader.info == nullptr) throw std::bad_alloc();
  const auto damaged = [&] {
    return FormatError(std::string("cannot be decoded: ") + reader.complaint.text);
  };
  Image image;
  if (!ReadHeader(reader, image.sixteen_bit)) throw damaged();
  image.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  image.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  image.channels = png_get_channels(reader.png, reader.info);
  image.data.resize(png_get_rowbytes(reader.png, reader.info) *
                    static_cast<std::size_t>(image.height));
  if (!ReadPixels(reader, image)) throw damaged();
  return image;
}

std::string EncodePng(const Image& image) {
  Writer writer;
  if (writer.info == nullptr) throw std::bad_alloc();
  if (!Write(writer, image))
    throw InternalError(std::string("cannot encode PNG: ") + writer.complaint.text);
  return std::move(writer.file);
}

}  // namespace floorproof
