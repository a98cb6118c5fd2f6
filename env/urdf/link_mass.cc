// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/link_mass.h"

#include <Eigen/Eigenvalues>
#include <limits>

#include "base/error.h"
#include "base/params.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

// Why no body has this inertia; empty: one can. A body's principal moments are positive, and none
// is larger than the two others together, up to what a file's digits lose.
std::string WhyNoBody(const StatedMass& stated) {
  constexpr double kDigits = 1e-3;
  if (std::isnan(stated.inertia(0, 0))) return "is not stated, or 0";
  const Vec3 moments =  // in ascending order
      Eigen::SelfAdjointEigenSolver<Mat3>(stated.inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] > 0)) return "is not positive";
  if (moments[2] > (moments[0] + moments[1]) * (1 + kDigits))
    return "has a principal moment of " + NumberText(moments[2]) +
           " kg m2, more than the two others together";
  return "";
}

Mat3 PointInertia(double mass_kg, const Vec3& away) {
  return mass_kg * (away.squaredNorm() * Mat3::Identity() - away * away.transpose());
}

}  // namespace

MassOf& MassOf::operator+=(const MassOf& other) {
  const double sum_kg = mass_kg + other.mass_kg;
  if (!(sum_kg > 0)) return *this;
  const Vec3 com = (mass_kg * com_M + other.mass_kg * other.com_M) / sum_kg;
  inertia_M += other.inertia_M + PointInertia(mass_kg, com_M - com) +
               PointInertia(other.mass_kg, other.com_M - com);
  mass_kg = sum_kg;
  com_M = com;
  return *this;
}

double BoxVolume(const UrdfShape& shape) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p_M : shape.Points()) {
    const Vec3 p = shape.R_M.transpose() * p_M;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).prod();
}

MassOf BoxMass(const std::vector<UrdfShape>& shapes, double mass_kg) {
  constexpr double kLeast_m = 0.01;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const UrdfShape& shape : shapes)
    for (const Vec3& p : shape.Points()) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  MassOf out;
  out.mass_kg = mass_kg;
  const bool any = !shapes.empty();
  if (any) out.com_M = (low + high) / 2;
  const Vec3 size = any ? (high - low).cwiseMax(kLeast_m).eval() : Vec3::Constant(kLeast_m);
  const Vec3 squares = size.cwiseProduct(size);
  out.inertia_M = (mass_kg / 12 * (Vec3::Constant(squares.sum()) - squares)).asDiagonal();
  return out;
}

void ReadMass(const StatedMass& stated, const Mat3& R_ML, const std::filesystem::path& file,
              UrdfLink& link, std::vector<std::string>& notes) {
  if (!(stated.mass_kg >= 0))
    throw InputError({file.string(), 0}, "mass of link " + link.name, FormatDouble(stated.mass_kg),
                     "must be 0 or more");
  if (stated.mass_kg == 0) {
    if (!link.shapes.empty()) notes.push_back("link " + link.name + " has no mass: taken for 0");
    return;
  }
  link.mass.mass_kg = stated.mass_kg;
  link.mass.com_M = link.p_M + R_ML * stated.com;
  const std::string why = WhyNoBody(stated);
  if (why.empty()) {
    const Mat3 axes_M = R_ML * stated.axes;
    link.mass.inertia_M = axes_M * stated.inertia * axes_M.transpose();
    return;
  }
  link.mass.inertia_M = BoxMass(link.shapes, stated.mass_kg).inertia_M;
  notes.push_back("the inertia of link " + link.name + " " + why +
                  ": taken from a box around its shapes");
}

}  // namespace floorproof
