// SPDX-License-Identifier: Apache-2.0
// The codec module's table of functions. Built as a library of its own because the codecs bring
// some 200 shared libraries, which only those who need a film or a BMP pay for.
#include "media/bmp_file.h"
#include "media/codec_api.h"
#include "media/h264_file.h"
#include "media/module_call.h"

namespace floorproof {
namespace {

int DecodeBmpFile(const std::uint8_t* file, std::size_t size, int* width, int* height,
                  int* channels, const std::uint8_t** pixels, void** handle, char* error) {
  return Guarded(error, [&] {
    auto decoded = DecodeBmp(file, size);
    *width = decoded->cols;
    *height = decoded->rows;
    *channels = decoded->channels();
    *pixels = decoded->data;
    *handle = decoded.release();
  });
}
void ReleaseBmp(void* handle) { delete static_cast<cv::Mat*>(handle); }

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

constexpr CodecApi kApi = {.version = CodecApi::kVersion,
                           .decode_bmp = DecodeBmpFile,
                           .release_bmp = ReleaseBmp,
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
