// SPDX-License-Identifier: Apache-2.0
// Poses that the robot may have, each with its weight: the filter behind `mcl`.
//
// Adaptive Monte Carlo localisation as in Thrun, Burgard & Fox, "Probabilistic Robotics", 2005. The
// motion comes from odometry, with noise (5.4); the weights from the scan's likelihood field (6.4);
// the number of particles from KLD sampling (8.3.7). Random particles are added when the scans fit
// much worse than before: augmented MCL (8.3.5), with a threshold as in Gutmann & Fox, "An
// experimental comparison of localization methods continued", 2002. Without the threshold, noise
// alone brings random particles, and one of them may fit by chance.
#pragma once

#include <cstdint>
#include <vector>

#include "base/streams.h"
#include "controllers/likelihood_field.h"
#include "env/core/observation.h"

namespace floorproof {

struct FilterParams {
  BeamModel beams;
  int least = 100, most = 500;  // particles
  // Noise of the motion: of the way per way, of the turn per turn and per way.
  double way_per_way = 0.1, turn_per_turn = 0.1, turn_per_m = 0.1;
  double way_m = 0.01, turn_rad = 0.005;  // and of every use of a scan: keeps the particles apart
  double scan_weight = 0.25;              // of a beam: neighbouring ones meet the same thing
  double least_ends = 1.0 / 15;  // a scan of which a smaller share came back says too little
  double recover_slow = 0.02, recover_fast = 0.3;  // rates of the two averages; 0: no recovery
  double recover_below =
      0.7;  // random particles when the fast average is below this share of the slow
};

class ParticleFilter {
 public:
  // `map`: on whose free cells particles may lie.
  ParticleFilter(const FilterParams& params, const HazardMap& map, const Stream& draws);

  // Around a pose, with these standard deviations; those that fall into a wall are drawn again.
  void StartAround(const Pose2& X_WB, double sd_m, double sd_rad);
  // Anywhere on the free floor.
  void StartAnywhere();

  // The robot moved by X_BB' as odometry tells it.
  void Move(const Pose2& motion_B);
  // Weighs the particles by a scan and draws them anew; not by one that says too little (false).
  // While the particles lie far apart, beams may end farther from what they met. Otherwise the few
  // particles near the truth would all seem wrong.
  bool Weigh(const LikelihoodField& field, const LidarScan& scan);
  // Scatters them a little: between passes over one scan.
  void Jitter(double sd_m, double sd_rad);

  // The middle of the heaviest group, and how far the particles lie around it (rms).
  Pose2 Best() const { return best_; }
  double position_std_m() const { return position_std_m_; }
  std::size_t size() const { return particles_.size(); }

 private:
  struct Particle {
    Pose2 X_WB;
    double weight = 1;
  };
  struct Bin {
    std::uint64_t key = 0;
    double weight = 0;
    Vec2 sum = Vec2::Zero();
    Vec2 heading = Vec2::Zero();
    std::uint32_t turn = 0;  // of use: older entries are empty
  };

  Pose2 Anywhere();
  bool IsFree(const Pose2& X_WB) const;
  double LogFit(const LikelihoodField& field, const LikelihoodField::Table& table,
                const Pose2& X_WB) const;
  Bin& BinOf(const Pose2& X_WB);
  void Resample(double inject);
  void FindBest();

  FilterParams params_;
  LikelihoodField::Table narrow_, wide_;
  const HazardMap& map_;
  Stream draws_;
  std::vector<Particle> particles_, next_;
  std::vector<double> cumulative_;
  std::vector<Vec2> ends_;  // of a scan's beams, body frame
  std::vector<Bin> bins_;   // a hash table of fixed size
  std::uint32_t turn_ = 0;
  double slow_ = 0, fast_ = 0;  // averages of how well scans fit
  Pose2 best_;
  double position_std_m_ = 0;
};

}  // namespace floorproof
