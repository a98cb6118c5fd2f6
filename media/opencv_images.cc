// SPDX-License-Identifier: Apache-2.0
#include "media/opencv_images.h"

#include <fcntl.h>
#include <unistd.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace floorproof {
namespace {

// libpng prints its complaints on stderr, and OpenCV offers no way to stop it.
class QuietStderr {
 public:
  QuietStderr() : saved_(dup(STDERR_FILENO)) {
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_ >= 0 && null >= 0) dup2(null, STDERR_FILENO);
    if (null >= 0) close(null);
  }
  ~QuietStderr() {
    if (saved_ < 0) return;
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int saved_;
};

}  // namespace

std::unique_ptr<ImageBuffer> DecodeImage(const std::uint8_t* file, std::size_t size) {
  auto buffer = std::make_unique<ImageBuffer>();
  const cv::Mat raw(1, static_cast<int>(size), CV_8U, const_cast<std::uint8_t*>(file));
  cv::Mat decoded;
  {
    const QuietStderr quiet;
    decoded = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  }
  if (decoded.empty()) throw std::runtime_error("its data are damaged or truncated");
  if (decoded.depth() != CV_8U && decoded.depth() != CV_16U)
    throw std::runtime_error("neither 8 nor 16 bits a channel");
  switch (decoded.channels()) {
    case 1:
      buffer->pixels = decoded;
      break;
    case 3:
      cv::cvtColor(decoded, buffer->pixels, cv::COLOR_BGR2RGB);
      break;
    case 4:
      cv::cvtColor(decoded, buffer->pixels, cv::COLOR_BGRA2RGBA);
      break;
    default:
      throw std::runtime_error("an unknown number of channels");
  }
  if (!buffer->pixels.isContinuous()) buffer->pixels = buffer->pixels.clone();
  return buffer;
}

std::unique_ptr<ImageBuffer> EncodeImage(const CodecImage& image) {
  auto buffer = std::make_unique<ImageBuffer>();
  const cv::Mat given(image.height, image.width, CV_8UC(image.channels),
                      const_cast<void*>(image.data));
  cv::Mat stored;  // never `given` itself, which is the caller's
  if (image.channels == 1) stored = given;
  if (image.channels == 3) cv::cvtColor(given, stored, cv::COLOR_RGB2BGR);
  if (image.channels == 4) cv::cvtColor(given, stored, cv::COLOR_RGBA2BGRA);
  if (!cv::imencode(".png", stored, buffer->file)) throw std::runtime_error("the encoder failed");
  return buffer;
}

void SilenceImageLibrary() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace floorproof
