// SPDX-License-Identifier: Apache-2.0
// Writes PNG and video into a file beside the target. The file takes the target's name only once it
// is whole, so a reader never meets half a picture, and a failed run leaves the old one.
#include <string>

#include "base/error.h"
#include "base/file_output.h"
#include "base/interrupt.h"
#include "media/codecs.h"
#include "media/media.h"
#include "media/module_call.h"
#include "media/png_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

InputError CannotWrite(const fs::path& path, const std::string& why) {
  return InputError({path.string(), 0}, "", "", "cannot be written: " + why);
}

void MoveInPlace(const fs::path& part, const fs::path& path) {
  std::error_code error;
  fs::rename(part, path, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  RefuseToWrite(path, error, "cannot be written: " + error.message());
}

class CodecVideo : public VideoWriter {
 public:
  CodecVideo(const fs::path& path, int width, int height, double fps)
      : path_(path), part_(MakePartFile(path)), width_(width), height_(height) {
    char error[kModuleErrorSize] = "";
    if (Codecs().open_video(part_.c_str(), width, height, fps, &video_, error) != 0) {
      Discard();
      throw CannotWrite(path, error);
    }
  }
  CodecVideo(const CodecVideo&) = delete;
  CodecVideo& operator=(const CodecVideo&) = delete;
  ~CodecVideo() override {
    if (video_ != nullptr) Discard();
  }

  void Add(const Image& rgb) override {
    if (video_ == nullptr) throw InternalError("a frame for a closed video");
    if (rgb.width != width_ || rgb.height != height_ || rgb.channels != 3)
      throw InternalError("a frame of another size than its video's");
    char error[kModuleErrorSize] = "";
    if (Codecs().add_frame(video_, rgb.data.data(), error) != 0) {
      Discard();
      throw CannotWrite(path_, error);
    }
  }

  void Close() override {
    if (video_ == nullptr) return;
    char error[kModuleErrorSize] = "";
    if (Codecs().finish_video(video_, error) != 0) {
      Discard();
      throw CannotWrite(path_, error);
    }
    Codecs().free_video(video_);
    video_ = nullptr;
    MoveInPlace(part_, path_);
  }

 private:
  void Discard() {
    if (video_ != nullptr) Codecs().free_video(video_);
    video_ = nullptr;
    std::error_code ignored;
    fs::remove(part_, ignored);
  }
  HoldInterrupts until_closed_;  // the part file is ours to remove
  fs::path path_, part_;
  int width_, height_;
  void* video_ = nullptr;
};

}  // namespace

void WritePng(const fs::path& path, const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      (image.channels != 1 && image.channels != 3 && image.channels != 4) ||
      image.data.size() != static_cast<std::size_t>(image.width) *
                               static_cast<std::size_t>(image.height) *
                               static_cast<std::size_t>(image.channels))
    throw InternalError("an image whose data do not match its size");
  WriteFileWhole(path, EncodePng(image));
}

std::unique_ptr<VideoWriter> OpenVideo(const fs::path& path, int width, int height, double fps) {
  if (width < 2 || height < 2 || width % 2 != 0 || height % 2 != 0 || width > 8192 || height > 8192)
    throw InputError({path.string(), 0}, "size",
                     std::to_string(width) + " x " + std::to_string(height),
                     "must be even (H.264 in yuv420p) and at most 8192 each way");
  if (!(fps > 0) || !(fps <= 1000))
    throw InputError({path.string(), 0}, "fps", std::to_string(fps), "must be in (0, 1000]");
  return std::make_unique<CodecVideo>(path, width, height, fps);
}

}  // namespace floorproof
