// SPDX-License-Identifier: Apache-2.0
// The audit paper, section 6.1: the image is made binary by a threshold, contours find connected
// pixels, the centroid of each blob is a particle's place, and their number is the dirt count. The
// paper does not say which threshold. Here it is a share of the tape's own grey at that place, as
// one grey for all fails under uneven light. The tape's grey is the median over a window, on a
// smaller image: particles, which cover less than half of it, do not move a median.
//
// Particles that touch count as one. Two of n are that near with the chance q = pi E[(r1 + r2 +
// g)^2] / (tape's area): 0.0058 for diameters of 0.5 to 1 mm on 4 cm2 and gaps g of 2 pixels, which
// the lens closes. So about n (n - 1) / 2 q are lost, and somewhat less where many lie. Measured
// over 300 tapes each: 0.28 of 10, 2.4 of 30, 9.4 of 60. Nothing is split: the paper does not, and
// with diameters from d to 2 d a blob's area does not tell two particles from one.
#include "env/audit/dirt_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "env/audit/structural_similarity.h"

namespace floorproof {
namespace {

constexpr int kDarkest = 16;   // grey of a tape on which specks still show
constexpr int kSmallest = 11;  // pixels: the window of the structural similarity

cv::Mat1b View(const TapeImage& image) {
  // OpenCV reads it only.
  return cv::Mat1b(image.height, image.width, const_cast<std::uint8_t*>(image.cells.data()));
}

struct Fault {
  ImageStatus status = ImageStatus::kSuccess;
  std::string message;
};

Fault FaultOf(const TapeImage& image, int least_side) {
  if (image.width < least_side || image.height < least_side)
    return {ImageStatus::kEmpty, "the image has " + std::to_string(image.width) + " x " +
                                     std::to_string(image.height) + " pixels"};
  const auto [low, high] = std::ranges::minmax(image.cells);
  if (low == high)
    return {ImageStatus::kOneColour, "all pixels of the image are " + std::to_string(low)};
  return {};
}

// The clean tape's grey at each pixel.
cv::Mat1b TapeGrey(const cv::Mat1b& image, double window_px) {
  constexpr int kShrink = 5;
  const cv::Size small((image.cols + kShrink - 1) / kShrink, (image.rows + kShrink - 1) / kShrink);
  cv::Mat1b grey;
  cv::resize(image, grey, small, 0, 0, cv::INTER_AREA);
  const int window = std::clamp(static_cast<int>(window_px / kShrink), 3, 253) | 1;
  cv::medianBlur(grey, grey, window);
  cv::resize(grey, grey, image.size(), 0, 0, cv::INTER_LINEAR);
  return grey;
}

cv::Mat1b DirtMask(const cv::Mat1b& image, const cv::Mat1b& tape, double darker) {
  cv::Mat1b mask(image.size());
  for (int iy = 0; iy < image.rows; ++iy)
    for (int ix = 0; ix < image.cols; ++ix)
      mask(iy, ix) = image(iy, ix) < (1 - darker) * tape(iy, ix) ? 255 : 0;
  return mask;
}

}  // namespace

std::string_view Name(ImageStatus status) {
  constexpr std::array<std::string_view, 5> kNames = {"success", "empty", "one_colour", "too_dark",
                                                      "sizes_differ"};
  return kNames[static_cast<std::size_t>(status)];
}

void CountParams::Visit(ParamVisitor& v) {
  v("darker", darker, {0, 1, true}, "share by which dirt is darker than the tape around it");
  v("window_m", window_m, {0, 0.1, true}, "side of the window that says how bright the tape is");
  v("least_diameter_m", least_diameter_m, Between(0, 0.01), "smaller specks are none");
}

DirtCount CountDirt(const TapeImage& image, int pixels_per_mm, const CountParams& params) {
  DirtCount dirt;
  if (const Fault fault = FaultOf(image, 1); fault.status != ImageStatus::kSuccess) {
    dirt.status = fault.status, dirt.message = fault.message;
    return dirt;
  }
  const cv::Mat1b pixels = View(image);
  const cv::Mat1b tape = TapeGrey(pixels, params.window_m * 1000 * pixels_per_mm);
  if (const double grey = cv::mean(tape)[0]; grey < kDarkest) {
    dirt.status = ImageStatus::kTooDark;
    dirt.message = "the tape's mean grey is " + std::to_string(std::lround(grey)) + " of 255";
    return dirt;
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(DirtMask(pixels, tape, params.darker), contours, cv::RETR_EXTERNAL,
                   cv::CHAIN_APPROX_NONE);
  const double least_px = params.least_diameter_m * 1000 * pixels_per_mm;
  for (const std::vector<cv::Point>& contour : contours) {
    // A contour runs through its pixels' middles. Its pixels, those on it included, by Pick.
    const double around = static_cast<double>(contour.size());
    if (cv::contourArea(contour) + around / 2 + 1 < kPi / 4 * least_px * least_px) continue;
    const cv::Moments m = cv::moments(contour);
    // A blob of one pixel's width has no area within its contour.
    Vec2 middle(contour[0].x, contour[0].y);
    if (m.m00 > 0) middle = Vec2(m.m10 / m.m00, m.m01 / m.m00);
    dirt.centroids_mm.push_back((middle + Vec2(0.5 - image.width / 2.0, 0.5 - image.height / 2.0)) /
                                pixels_per_mm);
  }
  std::ranges::sort(dirt.centroids_mm, [](const Vec2& a, const Vec2& b) {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  });
  dirt.count = static_cast<int>(dirt.centroids_mm.size());
  dirt.status = ImageStatus::kSuccess;
  return dirt;
}

SampleScore ScoreSample(const TapeImage& before, const TapeImage& after) {
  SampleScore sample;
  for (const TapeImage* image : {&before, &after})
    if (const Fault fault = FaultOf(*image, kSmallest); fault.status != ImageStatus::kSuccess) {
      sample.status = fault.status, sample.message = fault.message;
      return sample;
    }
  if (before.width != after.width || before.height != after.height) {
    sample.status = ImageStatus::kSizesDiffer;
    sample.message = "the images have " + std::to_string(before.width) + " x " +
                     std::to_string(before.height) + " and " + std::to_string(after.width) + " x " +
                     std::to_string(after.height) + " pixels";
    return sample;
  }
  sample.score = StructuralSimilarity(before, after);
  sample.status = ImageStatus::kSuccess;
  return sample;
}

}  // namespace floorproof
