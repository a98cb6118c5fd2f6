// SPDX-License-Identifier: Apache-2.0
// What is read from a tape's images: how many specks, where, and how clean it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "env/audit/tape_image.h"

namespace floorproof {

enum class ImageStatus {
  kSuccess,
  kEmpty,        // no pixels; for a score, fewer than 11 x 11
  kOneColour,    // all pixels are alike: no camera's image
  kTooDark,      // the tape itself is nearly black, so no speck would show
  kSizesDiffer,  // of two images
};
std::string_view Name(ImageStatus status);

struct CountParams {
  // A pixel is dirt where it is darker than the tape around it by this share. Noise and mottle make
  // one in a hundred, light that varies within a window a few more; the palest particles are darker
  // by more than a half. It stands below halfway so that neighbouring particles of any grey count.
  double darker = 0.25;
  double window_m = 0.005;  // the tape around: many particles wide, narrow against the light's fall
  // Smaller specks are none: half the diameter of the smallest particle.
  double least_diameter_m = 0.00025;
  void Visit(ParamVisitor& v);
};

struct DirtCount {
  ImageStatus status = ImageStatus::kEmpty;
  std::string message;  // why, unless it is a success
  int count = 0;        // particles that touch one another count as one: see dirt_count.cc
  // Of each speck, in the tape's frame T, mm; by rows from the lowest.
  std::vector<Vec2> centroids_mm;
};

// Counts as the audit paper does (section 6.1): threshold, contours, centroids. `pixels_per_mm` is
// the microscope's. O(pixels).
DirtCount CountDirt(const TapeImage& image, int pixels_per_mm, const CountParams& params = {});

struct SampleScore {
  ImageStatus status = ImageStatus::kEmpty;
  std::string message;
  // The structural similarity of the two images, not scaled: 1 as if nothing had been lifted, less
  // the dirtier. Noise keeps a clean tape somewhat below 1.
  double score = 0;
};

// The sample audit's score (section 3.1) of a tape before and after it was pressed on the floor.
SampleScore ScoreSample(const TapeImage& before, const TapeImage& after);

}  // namespace floorproof
