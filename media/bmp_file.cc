// SPDX-License-Identifier: Apache-2.0
#include "media/bmp_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace floorproof {
namespace {

// OpenCV says on std::cerr, past its own logger, what is wrong with a header.
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

std::unique_ptr<cv::Mat> DecodeBmp(const std::uint8_t* file, std::size_t size) {
  const cv::Mat raw(1, static_cast<int>(size), CV_8U, const_cast<std::uint8_t*>(file));
  cv::Mat decoded;
  {
    const QuietStderr quiet;
    decoded = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  }
  if (decoded.empty()) throw std::runtime_error("its data are damaged or truncated");
  if (decoded.depth() != CV_8U) throw std::runtime_error("not 8 bits a channel");
  auto pixels = std::make_unique<cv::Mat>();
  switch (decoded.channels()) {
    case 1:
      *pixels = decoded;
      break;
    case 3:
      cv::cvtColor(decoded, *pixels, cv::COLOR_BGR2RGB);
      break;
    case 4:
      cv::cvtColor(decoded, *pixels, cv::COLOR_BGRA2RGBA);
      break;
    default:
      throw std::runtime_error("an unknown number of channels");
  }
  if (!pixels->isContinuous()) *pixels = pixels->clone();
  return pixels;
}

void SilenceImageLibrary() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace floorproof
