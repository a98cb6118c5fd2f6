// SPDX-License-Identifier: Apache-2.0
#include "measure/like_kinds.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "measure/constant_rate.h"
#include "measure/hazard_classes.h"
#include "measure/penalised_rates.h"
#include "planners/risk/rate_evaluator.h"

namespace floorproof {
namespace {

Eigen::VectorXd EtasOf(const std::vector<RateRow>& rows, const LikeKinds& like) {
  const RateFeatures features(like.axes, like.any.blocks);
  const auto coefficients = Eigen::Map<const Eigen::VectorXd>(
      like.any.coefficients.data(), static_cast<Eigen::Index>(like.any.coefficients.size()));
  Eigen::VectorXd values(coefficients.size()), etas(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    features.At(rows[i].x, {values.data(), features.size()});
    etas[static_cast<Eigen::Index>(i)] = coefficients.dot(values);
  }
  return etas;
}

// Whether a kind is of what stands where it is passed, or of what could be driven over; none: it is
// like no other, as a ramp, which rises all along.
std::optional<bool> StandsBeside(const ByKind::key_type& kind,
                                 const std::map<std::string, HazardClass>& classes) {
  const auto of = classes.find(kind.first);
  if (kind.second != Passage::kBeside || of == classes.end() || kind.first == "ramp")
    return std::nullopt;
  return of->second == HazardClass::kBlindObject || of->second == HazardClass::kGlass;
}

}  // namespace

std::map<ByKind::key_type, std::shared_ptr<const LikeKinds>> FitLikeKinds(
    const ByKind& by_kind, const RateFitOptions& options) {
  constexpr int kOften = 100, kLeastFailures = 20;
  const std::map<std::string, HazardClass> classes = ClassOfType();
  std::map<ByKind::key_type, std::shared_ptr<const LikeKinds>> like;
  for (const bool stands : {false, true}) {
    std::vector<ByKind::key_type> kinds;
    Meetings met;
    int all = 0;
    for (const auto& [kind, of] : by_kind) {
      if (StandsBeside(kind, classes) != stands) continue;
      ++all;
      met.insert(met.end(), of.begin(), of.end());
      if (FailuresOf(of) < kOften) kinds.push_back(kind);
    }
    const auto failures = FailuresOf(met);
    if (kinds.empty() || all < 2 || failures < kLeastFailures ||
        static_cast<int>(met.size()) - failures < kLeastEvents)
      continue;
    auto of = std::make_shared<LikeKinds>();
    const std::vector<std::string> sizes = {std::string(kRise)};
    of->axes = AxesOf(met, stands ? std::vector<std::string>() : sizes, Manner::kAny, options);
    of->any =
        FitPredictor(RowsOf(met, of->axes, options.mirrored), false,
                     stands ? "risk_model.standing beside" : "risk_model.lying beside", of->axes);
    for (const ByKind::key_type& kind : kinds) like[kind] = of;
  }
  return like;
}

void SetLike(const std::vector<RateRow>& rows, const LikeKinds& like, const std::string& name,
             LinearPredictor& any) {
  const Eigen::VectorXd etas = EtasOf(rows, like);
  const auto expected = [&](double shift) {
    double sum = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      sum += -std::expm1(-rows[i].way_m * RateOf(etas[static_cast<Eigen::Index>(i)] + shift));
    return sum;
  };
  SetShifted(like.any, expected, name, any);
}

}  // namespace floorproof
