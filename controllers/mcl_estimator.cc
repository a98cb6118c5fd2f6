// SPDX-License-Identifier: Apache-2.0
// Monte Carlo localisation: where on the known map the lidar's scans fit, with odometry between
// them (particle_filter.h). It starts around a guess, or anywhere.
//
// A scan is used when the robot has moved or turned a little since the last one. If it stands
// still, the same scan again would look like new evidence. The first scan is used several times,
// with the particles scattered a little in between, because the guess may be half a metre off.
// Assumes that the robot stands level on the floor; knows nothing of slip but its noise.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "controllers/estimator.h"
#include "controllers/odometry.h"
#include "controllers/particle_filter.h"
#include "controllers/start_error.h"
#include "env/core/coverage.h"

namespace floorproof {
namespace {

constexpr int kFirstPasses = 12;
constexpr double kMoved_m = 0.05, kTurned_rad = 0.05;  // since the last scan that was used

class MclEstimator final : public Estimator {
 public:
  void Visit(ParamVisitor& v) override {
    v("least_particles", filter_.least, Between(10, 1e6), "fewest particles");
    v("particles", filter_.most, Between(10, 1e6), "most particles");
    v("prior_m", prior_m_, Between(0, 1000), "standard deviation of the first guess, each way (m)");
    v("prior_deg", prior_deg_, Between(0, 180), "the same of its heading (deg)");
    v("global", global_, "start anywhere on the free floor instead");
    v("hit_sd_m", filter_.beams.hit_sd_m, Between(0.01, 5),
      "how far a beam ends from what it met (m)");
    v("random_share", filter_.beams.random_share, Between(0.001, 0.999),
      "share of beams that end on what the map does not know");
    v("way_noise", filter_.way_per_way, Between(0, 10), "of odometry, m per m");
    v("turn_noise", filter_.turn_per_turn, Between(0, 10), "of odometry, rad per rad");
    v("turn_noise_per_m", filter_.turn_per_m, Between(0, 10), "of odometry, rad per m");
    v("recovery", recovery_, "draw random particles when scans fit worse than they used to");
    error_.Visit(v);
  }
  std::vector<Reading> Needs() const override {
    return {Reading::kScan, Reading::kWheels, Reading::kImu};
  }

  // Scans are compared with the map by cells of 5 cm at most. Measured in five drives on such
  // cells: 21 to 26 mm at 95 %, 51 mm at most.
  double error_m(const HazardMap& known, double) const override {
    return FineFrame(known.frame).cell_m / 2;
  }

  void Start(const EstimatorContext& context) override {
    known_ = &context.known;
    const auto may_stand = [&](CellState cell) {
      return cell == CellState::kFree || (cell == CellState::kUnknown && !known_->unknown_is_wall);
    };
    if (std::ranges::count_if(known_->occupancy.cells, may_stand) < 2)
      throw InputError({}, "estimator", "mcl", "needs a map of more than one free cell");
    odometry_.Start(context.robot);
    FilterParams params = filter_;
    if (params.least == FilterParams{}.least) params.least = std::min(params.least, params.most);
    if (params.least > params.most)
      throw InputError({}, "estimator.least_particles", std::to_string(params.least),
                       "must be at most particles, " + std::to_string(params.most));
    if (!recovery_) params.recover_slow = params.recover_fast = 0;
    particles_.emplace(params, context.known, context.draws);
    if (global_)
      particles_->StartAnywhere();
    else
      particles_->StartAround(error_.Of(context.start), prior_m_, prior_deg_ * kPi / 180);
    since_ = {};
    field_.reset();
    first_ = true;
    X_WB_ = particles_->Best();
  }

  void Exclude(std::span<const char> wheels) override { odometry_.Exclude(wheels); }

  Estimate Update(const Observation& sensed, double dt_s) override {
    const BodyTwist twist = odometry_.Update(sensed, dt_s);
    X_WB_ = Moved(X_WB_, twist, dt_s);
    since_ = Moved(since_, twist, dt_s);
    if (sensed.scan.fresh) Use(sensed.scan);
    return {X_WB_, twist, sensed.hinges, particles_->position_std_m()};
  }

 private:
  void Use(const LidarScan& scan) {
    if (!field_) field_.emplace(*known_, scan.height_m);
    if (!first_ && since_.p().norm() < kMoved_m && std::abs(since_.yaw_rad) < kTurned_rad) return;
    particles_->Move(since_);
    since_ = {};
    const bool used = particles_->Weigh(*field_, scan);
    for (int pass = 1; used && first_ && pass < kFirstPasses; ++pass) {
      particles_->Jitter(0.05, 0.03);
      particles_->Weigh(*field_, scan);
    }
    if (used) first_ = false;
    X_WB_ = particles_->Best();
  }

  FilterParams filter_;
  StartError error_;
  double prior_m_ = 0.5, prior_deg_ = 20;
  bool global_ = false, recovery_ = true;
  bool first_ = true;  // no scan was used yet

  const HazardMap* known_ = nullptr;
  Odometry odometry_;
  std::optional<ParticleFilter> particles_;
  std::optional<LikelihoodField> field_;
  Pose2 X_WB_, since_;  // since_: moved since the last scan that was used
};

}  // namespace

FP_DEFINE_PLUGIN(Estimator, MclEstimator)

}  // namespace floorproof
