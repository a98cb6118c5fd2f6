// SPDX-License-Identifier: Apache-2.0
// The estimate is the truth: what a plan is worth when the robot always knows where it is.
#include "controllers/estimator.h"
#include "controllers/start_error.h"
#include "env/core/blocks.h"

namespace floorproof {
namespace {

class TruthEstimator final : public Estimator {
 public:
  // It takes no heed of them: a campaign may draw them for all the estimators of its variants.
  void Visit(ParamVisitor& v) override { ignored_.Visit(v); }
  bool draws() const override { return false; }
  std::vector<Reading> Needs() const override { return {Reading::kTruth}; }
  void Start(const EstimatorContext& context) override {
    estimate_ = {};
    estimate_.X_WB = context.start;
    estimate_.hinges = StartState(context.robot);
  }
  // Where the sensor is silent it stays with what it knew last.
  Estimate Update(const Observation& sensed, double) override {
    if (sensed.truth) estimate_ = {sensed.truth->X_WB, sensed.truth->V_WB_B, sensed.truth->hinges};
    return estimate_;
  }

 private:
  Estimate estimate_;
  StartError ignored_;
};

}  // namespace

FP_DEFINE_PLUGIN(Estimator, TruthEstimator)

}  // namespace floorproof
