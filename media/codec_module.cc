// SPDX-License-Identifier: Apache-2.0
// The codec module's table of functions. Built as a library of its own because the codecs bring
// some 200 shared libraries, which only those who need a picture pay for.
#include <cstdio>
#include <exception>

#include "media/codec_api.h"
#include "media/h264_file.h"
#include "media/letters.h"
#include "media/opencv_images.h"

namespace floorproof {
namespace {

// Runs `body` so that nothing is thrown through C frames.
template <class Body>
int Guarded(char* error, const Body& body) noexcept {
  const auto say = [&](const char* why) { std::snprintf(error, kCodecErrorSize, "%s", why); };
  try {
    body();
    return 0;
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("unknown exception");
  }
  return 1;
}

int Decode(const std::uint8_t* file, std::size_t size, CodecImage* image, void** handle,
           char* error) {
  return Guarded(error, [&] {
    auto buffer = DecodeImage(file, size);
    *image = {buffer->pixels.cols, buffer->pixels.rows, buffer->pixels.channels(),
              buffer->pixels.depth() == CV_8U ? 8 : 16, buffer->pixels.data};
    *handle = buffer.release();
  });
}

int EncodePng(const CodecImage* image, const std::uint8_t** file, std::size_t* size, void** handle,
              char* error) {
  return Guarded(error, [&] {
    auto buffer = EncodeImage(*image);
    *file = buffer->file.data();
    *size = buffer->file.size();
    *handle = buffer.release();
  });
}

void Release(void* handle) { delete static_cast<ImageBuffer*>(handle); }

int DrawText(const char* utf8, double cap_px, int bold, CodecText* text, void** handle,
             char* error) {
  return Guarded(error, [&] {
    auto drawn = DrawLetters(utf8, cap_px, bold != 0);
    if (!drawn) {
      *handle = nullptr;
      return;
    }
    *text = {{drawn->coverage.cols, drawn->coverage.rows, 1, 8, drawn->coverage.data},
             drawn->base,
             drawn->advance_px};
    *handle = drawn.release();
  });
}

void ReleaseText(void* handle) { delete static_cast<DrawnLetters*>(handle); }

int OpenVideoFile(const char* path, int width, int height, double fps, void** video, char* error) {
  return Guarded(error, [&] { *video = new H264File(path, width, height, fps); });
}
int AddFrame(void* video, const std::uint8_t* rgb, char* error) {
  return Guarded(error, [&] { static_cast<H264File*>(video)->Add(rgb); });
}
int FinishVideo(void* video, char* error) {
  return Guarded(error, [&] { static_cast<H264File*>(video)->Finish(); });
}
void FreeVideo(void* video) { delete static_cast<H264File*>(video); }

constexpr CodecApi kApi = {.version = kCodecApiVersion,
                           .decode = Decode,
                           .encode_png = EncodePng,
                           .release = Release,
                           .draw_text = DrawText,
                           .release_text = ReleaseText,
                           .open_video = OpenVideoFile,
                           .add_frame = AddFrame,
                           .finish_video = FinishVideo,
                           .free_video = FreeVideo};

}  // namespace
}  // namespace floorproof

extern "C" __attribute__((visibility("default"))) const floorproof::CodecApi* FloorproofCodecs() {
  floorproof::SilenceImageLibrary();
  floorproof::SilenceVideoLibrary();
  return &floorproof::kApi;
}
