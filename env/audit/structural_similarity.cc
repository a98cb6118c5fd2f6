// SPDX-License-Identifier: Apache-2.0
// Wang, Bovik, Sheikh & Simoncelli, "Image quality assessment: from error visibility to structural
// similarity", IEEE Trans. Image Processing 13(4), 2004: means, variances and the covariance under
// a window (14-16), a Gaussian of 11 x 11 pixels and standard deviation 1.5; SSIM (13) with C1 =
// (K1 L)^2, C2 = (K2 L)^2, K1 = 0.01, K2 = 0.03, L = 255; its mean over all windows (17).
//
// Only windows that lie wholly within the image count, as in the authors' code. Images are compared
// as they are, not scaled down first. In loops of our own rather than OpenCV's filters: those take
// what instructions the machine has, and the last bits of a score with them.
#include "env/audit/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace floorproof {
namespace {

constexpr int kWindow = 11;
using Kernel = std::array<double, kWindow>;

Kernel Bell() {
  Kernel kernel;
  double sum = 0;
  for (int i = 0; i < kWindow; ++i) {
    const double x = (i - kWindow / 2) / 1.5;
    kernel[static_cast<std::size_t>(i)] = std::exp(-x * x / 2);
    sum += kernel[static_cast<std::size_t>(i)];
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

// The weighted means under all windows that lie within the image.
class WindowMeans {
 public:
  WindowMeans(int width, int height)
      : width_(width), height_(height), along_rows_(width - kWindow + 1, height) {}

  template <class Value>
  Grid<double> Of(const Value& value) {
    std::vector<double> row(static_cast<std::size_t>(width_));
    Grid<double> means(along_rows_.width, height_ - kWindow + 1);
    const auto n = static_cast<std::size_t>(along_rows_.width);
    for (int iy = 0; iy < height_; ++iy) {
      for (std::size_t ix = 0; ix < row.size(); ++ix)
        row[ix] = value(static_cast<std::size_t>(iy) * row.size() + ix);
      double* out = &along_rows_(0, iy);
      std::fill_n(out, n, 0.0);
      for (std::size_t k = 0; k < kWindow; ++k)
        for (std::size_t ix = 0; ix < n; ++ix) out[ix] += kernel_[k] * row[ix + k];
    }
    for (int iy = 0; iy < means.height; ++iy) {
      double* out = &means(0, iy);
      for (int k = 0; k < kWindow; ++k) {
        const double* in = &along_rows_(0, iy + k);
        for (std::size_t ix = 0; ix < n; ++ix)
          out[ix] += kernel_[static_cast<std::size_t>(k)] * in[ix];
      }
    }
    return means;
  }

 private:
  Kernel kernel_ = Bell();
  int width_, height_;
  Grid<double> along_rows_;
};

}  // namespace

double StructuralSimilarity(const TapeImage& a, const TapeImage& b) {
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  WindowMeans means(a.width, a.height);
  const auto x = [&a](std::size_t i) { return static_cast<double>(a.cells[i]); };
  const auto y = [&b](std::size_t i) { return static_cast<double>(b.cells[i]); };
  const Grid<double> mean_x = means.Of(x), mean_y = means.Of(y);
  const Grid<double> squares = means.Of([&](std::size_t i) { return x(i) * x(i) + y(i) * y(i); });
  const Grid<double> products = means.Of([&](std::size_t i) { return x(i) * y(i); });
  double sum = 0;
  for (std::size_t i = 0; i < products.cells.size(); ++i) {
    const double mx = mean_x.cells[i], my = mean_y.cells[i];
    // Of the variances only the sum is needed.
    const double variances = squares.cells[i] - (mx * mx + my * my);
    const double covariance = products.cells[i] - mx * my;
    sum += (2 * mx * my + kC1) * (2 * covariance + kC2) /
           ((mx * mx + my * my + kC1) * (variances + kC2));
  }
  return sum / static_cast<double>(products.cells.size());
}

}  // namespace floorproof
