// SPDX-License-Identifier: Apache-2.0
// Images by OpenCV; part of the codec module.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "media/codec_api.h"

namespace floorproof {

struct ImageBuffer {
  cv::Mat pixels;           // continuous; channels in the order of CodecImage
  std::vector<uchar> file;  // what was encoded
};

// Both throw std::runtime_error or cv::Exception.
std::unique_ptr<ImageBuffer> DecodeImage(const std::uint8_t* file, std::size_t size);
std::unique_ptr<ImageBuffer> EncodeImage(const CodecImage& image);

// What is wrong with a file is said once, by the caller; OpenCV's own lines would come on top.
void SilenceImageLibrary();

}  // namespace floorproof
