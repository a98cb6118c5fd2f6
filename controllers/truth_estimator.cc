// SPDX-License-Identifier: Apache-2.0
// The estimate is the truth: what a plan is worth when the robot always knows where it is.
#include "controllers/estimator.h"
#include "controllers/start_error.h"

namespace floorproof {
namespace {

class TruthEstimator final : public Estimator {
 public:
  // It takes no heed of them: a campaign may draw them for all the estimators of its variants.
  void Visit(ParamVisitor& v) override { ignored_.Visit(v); }
  void Start(const EstimatorContext&) override {}
  Estimate Update(const Observation&, const Sample& truth, double) override {
    return {truth.X_WB(), truth.V_WB_B, truth.hinges};
  }

 private:
  StartError ignored_;
};

}  // namespace

FP_DEFINE_PLUGIN(Estimator, TruthEstimator)

}  // namespace floorproof
