// SPDX-License-Identifier: Apache-2.0
// BMP by OpenCV; part of the codec module.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

namespace floorproof {

// A whole BMP file, with palettes expanded: 8 bits each of grey | R G B | R G B A, continuous.
// Throws std::runtime_error or cv::Exception.
std::unique_ptr<cv::Mat> DecodeBmp(const std::uint8_t* file, std::size_t size);

// What is wrong with a file is said once, by the caller; OpenCV's own lines would come on top.
void SilenceImageLibrary();

}  // namespace floorproof
