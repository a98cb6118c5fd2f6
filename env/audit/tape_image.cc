// SPDX-License-Identifier: Apache-2.0
// The tape's reflectance is drawn first: a smooth mottle, and particles painted over it one after
// another. The lens blurs it; light and lamp multiply it; the sensor adds noise and rounds.
//
// Only sums, products, quotients and square roots of doubles, in a fixed order, which IEEE 754
// defines to the last bit: no sine, no exponential. An outline is a circle with a second, a third
// and a fifth harmonic; the multiples of an angle are powers of a complex number of length 1. Noise
// is the number of ones in 32 random bits, which is normal but for its steps.
// Assumptions: particles lie flat and are opaque to a share; no shadows, no glints, no depth of
// field. The blur's binomial kernels add up to the standard deviation to within 0.25 px.
#include "env/audit/tape_image.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "base/streams.h"

namespace floorproof {
namespace {

using Unit = std::complex<double>;  // of length 1: a direction

Unit DrawUnit(Stream& random) {
  for (;;) {
    const double x = random.Uniform(-1, 1), y = random.Uniform(-1, 1), n = x * x + y * y;
    if (n > 0.01 && n <= 1) return Unit(x, y) / std::sqrt(n);
  }
}

Unit Times(Unit a, Unit b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// Bends from one standard normal value at every 16th pixel to the next, evenly.
void AddMottle(double sd_grey, Stream& random, Grid<double>& grey) {
  constexpr int kApart = 16;
  Grid<double> knots(grey.width / kApart + 2, grey.height / kApart + 2);
  // Even between +-sqrt(3): standard deviation 1.
  for (double& k : knots.cells) k = random.Uniform(-1, 1) * std::sqrt(3.0) * sd_grey;
  for (int iy = 0; iy < grey.height; ++iy)
    for (int ix = 0; ix < grey.width; ++ix) {
      const int kx = ix / kApart, ky = iy / kApart;
      const double u = (ix % kApart + 0.5) / kApart, v = (iy % kApart + 0.5) / kApart;
      grey(ix, iy) += (1 - v) * ((1 - u) * knots(kx, ky) + u * knots(kx + 1, ky)) +
                      v * ((1 - u) * knots(kx, ky + 1) + u * knots(kx + 1, ky + 1));
    }
}

// Paints a particle; `p` and `radius` in pixels, pixel (0, 0) spans [0, 1] x [0, 1].
void PaintSpeck(const Vec2& p, double radius, double ragged, double speck_grey, Stream& random,
                Grid<double>& grey) {
  const double second = 0.3 * ragged * random.Uniform(), third = 0.2 * ragged * random.Uniform(),
               fifth = 0.1 * ragged * random.Uniform();
  const Unit turn2 = DrawUnit(random), turn3 = DrawUnit(random), turn5 = DrawUnit(random);
  // The same area as a circle, whatever the harmonics.
  const double mean = radius / std::sqrt(1 + (second * second + third * third + fifth * fifth) / 2);
  const double farthest = mean * (1 + second + third + fifth) + 1;
  const auto pixel = [](double at, int limit) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, limit - 1.0));
  };
  const int x1 = pixel(p.x() + farthest, grey.width), y1 = pixel(p.y() + farthest, grey.height);
  for (int iy = pixel(p.y() - farthest, grey.height); iy <= y1; ++iy)
    for (int ix = pixel(p.x() - farthest, grey.width); ix <= x1; ++ix) {
      const double dx = ix + 0.5 - p.x(), dy = iy + 0.5 - p.y();
      const double d = std::sqrt(dx * dx + dy * dy);
      const Unit u = d > 0 ? Unit(dx / d, dy / d) : Unit(1, 0);
      const Unit u2 = Times(u, u), u3 = Times(u2, u), u5 = Times(u2, u3);
      const double border =
          mean * (1 + second * Times(u2, turn2).real() + third * Times(u3, turn3).real() +
                  fifth * Times(u5, turn5).real());
      const double covered = std::clamp(border - d + 0.5, 0.0, 1.0);
      grey(ix, iy) += covered * (speck_grey - grey(ix, iy));
    }
}

// Kernels of 1/4, 1/2, 1/4, one after another: variance 1/2 each. Border pixels stand for what is
// beyond them.
void Blur(double sd_px, Grid<double>& grey) {
  const auto w = static_cast<std::size_t>(grey.width);
  std::vector<double> above(w), row(w);  // as they were
  for (int times = static_cast<int>(std::lround(2 * sd_px * sd_px)); times > 0; --times) {
    std::copy_n(grey.cells.begin(), w, above.begin());
    for (int iy = 0; iy < grey.height; ++iy) {
      double* at = &grey(0, iy);
      const double* below = &grey(0, std::min(iy + 1, grey.height - 1));
      std::copy_n(at, w, row.begin());
      for (std::size_t i = 0; i < w; ++i) at[i] = (above[i] + 2 * row[i] + below[i]) / 4;
      std::swap(above, row);
      std::copy_n(at, w, row.begin());
      for (std::size_t i = 1; i + 1 < w; ++i) at[i] = (row[i - 1] + 2 * row[i] + row[i + 1]) / 4;
      at[0] = (3 * row[0] + row[std::min<std::size_t>(1, w - 1)]) / 4;
      at[w - 1] = (row[w > 1 ? w - 2 : 0] + 3 * row[w - 1]) / 4;
    }
  }
}

// How many ones there are in the lower and in the upper 32 bits: of fair ones, mean 16 and standard
// deviation the root of 8.
std::uint64_t OnesInHalves(std::uint64_t x) {
  x -= (x >> 1) & 0x5555555555555555ULL;
  x = (x & 0x3333333333333333ULL) + ((x >> 2) & 0x3333333333333333ULL);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  x += x >> 8;
  x += x >> 16;
  return x & 0x000000ff000000ffULL;
}

// One image of what the lens shows, under a light that comes from a side and is darker towards the
// corners; 1 in the middle.
TapeImage Expose(const Grid<double>& grey, Unit from, const MicroscopeParams& params,
                 Stream random) {
  const double lamp = 1 + params.lamp * random.Uniform(-1, 1);
  const double step = params.noise_grey / std::sqrt(8.0);
  std::vector<double> across;  // -1 to 1, along a side
  for (int i = 0; i < grey.width; ++i) across.push_back((2 * i + 1.0) / grey.width - 1);
  TapeImage image(grey.width, grey.height);
  std::uint64_t ones = 0;
  for (std::size_t i = 0, iy = 0; iy < across.size(); ++iy)
    for (std::size_t ix = 0; ix < across.size(); ++ix, ++i) {
      const double u = across[ix], v = across[iy];
      const double light = 1 + params.light_fall / 2 * (from.real() * u + from.imag() * v) -
                           params.vignette / 2 * (u * u + v * v);
      ones = i % 2 == 0 ? OnesInHalves(random.Next()) : ones >> 32;
      const double noise = step * (static_cast<double>(ones & 0xff) - 16);
      // Half a grey more, to round and not to cut.
      const double value = std::clamp(lamp * light * grey.cells[i] + noise + 0.5, 0.0, 255.0);
      image.cells[i] = static_cast<std::uint8_t>(value);
    }
  return image;
}

}  // namespace

void MicroscopeParams::Visit(ParamVisitor& v) {
  v("pixels_per_mm", pixels_per_mm, Between(1, 100), "scale of the image");
  v("tape_grey", tape_grey, Between(0, 255), "a clean tape in the middle of the image");
  v("mottle_grey", mottle_grey, Between(0, 50), "what a clean tape varies by, standard deviation");
  v("light_fall", light_fall, Between(0, 1), "share that the light falls by across the image");
  v("vignette", vignette, Between(0, 0.5), "share that the light falls by towards the corners");
  v("lamp", lamp, Between(0, 0.5), "share that the lamp varies by, from image to image");
  v("noise_grey", noise_grey, Between(0, 50), "the sensor's noise, standard deviation");
  v("blur_px", blur_px, Between(0, 5), "the lens, standard deviation in pixels");
  v("speck_grey", speck_grey, Between(0, 255), "a particle in the middle of the image");
  v("speck_spread_grey", speck_spread_grey, Between(0, 100), "by how much more or less, at most");
  v("ragged", ragged, Between(0, 1), "how far particles are from circles");
}

TapeImages PhotographTape(std::span<const LiftedParticle> particles, const TapeParams& tape,
                          const MicroscopeParams& microscope, std::uint64_t seed) {
  const double per_m = 1000.0 * microscope.pixels_per_mm;
  const int side = std::max(1, static_cast<int>(std::lround(tape.side_m * per_m)));
  Grid<double> clean(side, side, microscope.tape_grey);
  Stream of_tape(seed, 0, "tape_mottle"), of_specks(seed, 0, "tape_specks");
  const Unit from = DrawUnit(of_tape);
  AddMottle(microscope.mottle_grey, of_tape, clean);
  Grid<double> dirty = clean;
  for (const LiftedParticle& particle : particles) {
    const Vec2 p = (particle.p_T + Vec2(tape.side_m / 2, tape.side_m / 2)) * per_m;
    const double grey =
        microscope.speck_grey + microscope.speck_spread_grey * of_specks.Uniform(-1, 1);
    PaintSpeck(p, particle.diameter_m / 2 * per_m, microscope.ragged, grey, of_specks, dirty);
  }
  Blur(microscope.blur_px, clean);
  Blur(microscope.blur_px, dirty);
  return {Expose(clean, from, microscope, Stream(seed, 0, "tape_before")),
          Expose(dirty, from, microscope, Stream(seed, 0, "tape_after"))};
}

}  // namespace floorproof
