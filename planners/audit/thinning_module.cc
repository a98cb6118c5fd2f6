// SPDX-License-Identifier: Apache-2.0
// The thinning module: OpenCV's ximgproc behind one C function.
#include <exception>
#include <opencv2/ximgproc.hpp>
#include <string>

#include "planners/audit/thinning_api.h"

extern "C" __attribute__((visibility("default"))) const char* FloorproofThin(std::uint8_t* pixels,
                                                                             int width,
                                                                             int height) {
  static thread_local std::string error;
  try {
    cv::Mat image(height, width, CV_8U, pixels), thin;
    cv::ximgproc::thinning(image, thin, cv::ximgproc::THINNING_ZHANGSUEN);
    thin.copyTo(image);
    return nullptr;
  } catch (const std::exception& e) {
    error = e.what();
    return error.c_str();
  }
}
