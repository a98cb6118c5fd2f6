// SPDX-License-Identifier: Apache-2.0
#include "planners/risk/risk_map.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace floorproof {
namespace {

// How many steps of RF there are to 1: a power of ten, so that a step is some 1e-14 of what all
// hazards in one place would sum to.
double StepsToOne(double sum) {
  return sum > 0 ? std::pow(10, 14 - std::floor(std::log10(sum))) : 1;
}

// The convolution of the sources with the kernel 2 / (20 + scale * distance). It is circular, and
// large enough that nothing comes round to the other side.
cv::Mat1d Convolved(const cv::Mat1d& sources, double scale) {
  const int rows = cv::getOptimalDFTSize(2 * sources.rows - 1);
  const int cols = cv::getOptimalDFTSize(2 * sources.cols - 1);
  cv::Mat1d kernel(rows, cols), padded(rows, cols, 0.0);
  for (int y = 0; y < rows; ++y) {
    double* row = kernel[y];
    const double dy = std::min(y, rows - y);
    for (int x = 0; x < cols; ++x) {
      const double dx = std::min(x, cols - x);
      row[x] = 2 / (20 + scale * std::sqrt(dx * dx + dy * dy));
    }
  }
  sources.copyTo(padded(cv::Rect(0, 0, sources.cols, sources.rows)));
  cv::dft(padded, padded, 0, sources.rows);
  cv::dft(kernel, kernel);
  cv::mulSpectrums(padded, kernel, padded, 0);
  cv::dft(padded, padded, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT, sources.rows);
  return padded(cv::Rect(0, 0, sources.cols, sources.rows));
}

}  // namespace

void RiskParams::Visit(ParamVisitor& visit) {
  visit("cell_m", cell_m, Between(0.05, 10), "width of a cell; none: the robot's");
  visit("distance_scale", distance_scale, NonNegative(),
        "what a cell of distance counts in Eq. 1; the paper's is 1");
  visit("walls_are_hazards", walls_are_hazards, "outer walls count as blind objects");
}

RiskMap ComputeRisk(const HazardMap& map, const RobotSpec& robot, const FmeaTables& tables,
                    const RiskParams& params) {
  RiskMap risk{MakeRiskGrid(map, robot, tables, params.cell_m), {}};
  const int width = risk.grid.frame.width, height = risk.grid.frame.height;
  // A ring of cells around the map may hold walls.
  cv::Mat1d sources(height + 2, width + 2, 0.0);
  const double wall = params.walls_are_hazards ? tables.Weight(HazardClass::kBlindObject) : 0;
  for (int iy = -1; iy <= height; ++iy)
    for (int ix = -1; ix <= width; ++ix) {
      double& source = sources(iy + 1, ix + 1);
      if (!risk.grid.contents.Inside(ix, iy)) {
        source = risk.grid.walled_all_round ? 0 : wall;
        continue;
      }
      const RiskCell& cell = risk.grid.contents(ix, iy);
      const bool in_ring = ix == 0 || iy == 0 || ix == width - 1 || iy == height - 1;
      if (cell.hazard) source = tables.Weight(*cell.hazard);
      if (cell.outer_wall() && in_ring && risk.grid.walled_all_round) source = wall;
    }
  const double steps = StepsToOne(cv::sum(sources)[0]);
  const cv::Mat1d sum = Convolved(sources, params.distance_scale);
  risk.rf = Grid<double>(width, height);
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix)
      risk.rf(ix, iy) = std::round(sum(iy + 1, ix + 1) * steps) / steps;
  return risk;
}

}  // namespace floorproof
