// SPDX-License-Identifier: Apache-2.0
// Odometry alone: the motion of the wheels and the turn of the gyro, added up from the start. It
// never finds out where it really is, so slip, a wheel of another size and the gyro's bias add up
// for ever.
#include "controllers/estimator.h"
#include "controllers/odometry.h"
#include "controllers/start_error.h"

namespace floorproof {
namespace {

class OdometryEstimator final : public Estimator {
 public:
  void Visit(ParamVisitor& v) override { error_.Visit(v); }
  bool draws() const override { return false; }
  std::vector<Reading> Needs() const override { return {Reading::kWheels, Reading::kImu}; }
  // Measured in six drives from an exact start: 1 to 53 mm a metre.
  double error_m(const HazardMap&, double way_m) const override { return 0.05 * way_m; }

  void Start(const EstimatorContext& context) override {
    odometry_.Start(context.robot);
    X_WB_ = error_.Of(context.start);
  }

  void Exclude(std::span<const char> wheels) override { odometry_.Exclude(wheels); }

  Estimate Update(const Observation& sensed, double dt_s) override {
    const BodyTwist twist = odometry_.Update(sensed, dt_s);
    X_WB_ = Moved(X_WB_, twist, dt_s);
    return {X_WB_, twist, sensed.hinges};
  }

 private:
  StartError error_;
  Odometry odometry_;
  Pose2 X_WB_;
};

}  // namespace

FP_DEFINE_PLUGIN(Estimator, OdometryEstimator)

}  // namespace floorproof
