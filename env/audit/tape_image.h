// SPDX-License-Identifier: Apache-2.0
// A tape as the microscope sees it, before and after it was pressed on the floor.
#pragma once

#include <cstdint>
#include <span>

#include "base/params.h"
#include "env/audit/tape.h"
#include "env/geometry/grid.h"

namespace floorproof {

// 8 bit grey, row by row from the lowest, as all grids: pixel (ix, iy) spans a square of the tape,
// (0, 0) at the corner of its frame's least x and y. A PNG's first row is the last one here.
using TapeImage = Grid<std::uint8_t>;

// The audit paper's microscope lights its own field of view (section 3.1); it states no figures.
// These are assumptions: a plain 8 bit camera, in focus, its one lamp at a side.
struct MicroscopeParams {
  int pixels_per_mm = 20;  // the smallest particles are 10 pixels wide
  double tape_grey = 205;  // of a clean tape in the middle of the image
  // What the tape itself shows, the same in both images: standard deviation of its smooth mottle.
  double mottle_grey = 1.5;
  // Of the light, from the darker border to the brighter one, as a share; its direction is drawn
  // for each tape, since a tape sits in its holder as it comes. And how much darker corners are.
  double light_fall = 0.2, vignette = 0.1;
  double lamp = 0.01;     // from image to image, by up to this share brighter or darker
  double noise_grey = 1;  // the sensor's, standard deviation at each pixel
  double blur_px = 1;     // the lens: standard deviation, in steps of about half a pixel
  // Grey of a particle's middle under the tape's own light, and by how much either way: tea, dark
  // brown. The palest lets through less than half of what the tape does.
  double speck_grey = 60, speck_spread_grey = 25;
  // How far outlines are from a circle: 0 is a circle, 1 the largest that has no spikes.
  double ragged = 0.6;
  void Visit(ParamVisitor& v);
};

// Two images of one tape, with the same light and mottle, each with its own lamp and noise.
struct TapeImages {
  TapeImage before, after;
};

// `before` shows the clean tape, `after` the particles too; with no particles the two differ by
// lamp and noise only. Draws from Stream(seed, 0, "tape_...") alone: a seed stands for a tape. The
// same bytes on every machine. O(pixels).
TapeImages PhotographTape(std::span<const LiftedParticle> particles, const TapeParams& tape,
                          const MicroscopeParams& microscope, std::uint64_t seed);

}  // namespace floorproof
