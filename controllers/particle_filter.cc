// SPDX-License-Identifier: Apache-2.0
#include "controllers/particle_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floorproof {
namespace {

constexpr double kBin_m = 0.25, kBin_rad = 15 * kPi / 180;
constexpr int kNearBins = 3;  // that a group reaches around its heaviest
constexpr double kKldError = 0.05, kKldQuantile = 2.3263;  // of the normal distribution, at 99 %
constexpr double kApart_m = 0.3;  // a standard deviation from which on the wide likelihood is used
constexpr double kWide_m = 0.3;   // at least its standard deviation
constexpr int kTriesAnywhere = 10000;  // of a map, little of which may be floor
constexpr int kTries = 100;            // to find a free place

// Particles that k filled bins ask for.
int KldSize(int k) {
  if (k < 2) return 1;
  const double a = 2.0 / (9.0 * (k - 1));
  const double b = 1 - a + std::sqrt(a) * kKldQuantile;
  return static_cast<int>(std::ceil((k - 1) / (2 * kKldError) * b * b * b));
}

}  // namespace

ParticleFilter::ParticleFilter(const FilterParams& params, const HazardMap& map,
                               const Stream& draws)
    : params_(params), map_(map), draws_(draws) {
  BeamModel beams = params.beams;
  narrow_ = LogLikelihoods(beams);
  beams.hit_sd_m = std::max(beams.hit_sd_m, kWide_m);
  wide_ = LogLikelihoods(beams);
  const auto most = static_cast<std::size_t>(params.most);
  for (auto* particles : {&particles_, &next_}) particles->reserve(most);
  cumulative_.reserve(most);
  std::size_t table = 1;
  while (table < 4 * most) table *= 2;
  bins_.resize(table);
}

bool ParticleFilter::IsFree(const Pose2& X_WB) const {
  return !map_.IsWall(map_.frame.ToCell(X_WB.p()));
}

// Drawn again until it is free: a list of all free cells would take as much memory as the map.
Pose2 ParticleFilter::Anywhere() {
  const Vec2 size = map_.frame.cell_m * Vec2(map_.frame.width, map_.frame.height);
  for (int k = 0; k < kTriesAnywhere; ++k) {
    const double x_m = draws_.Uniform() * size.x(), y_m = draws_.Uniform() * size.y();
    const Vec2 p_W = map_.frame.X_WG * Vec2(x_m, y_m);
    const Pose2 pose{p_W.x(), p_W.y(), draws_.Uniform(-kPi, kPi)};
    if (IsFree(pose)) return pose;
  }
  return best_;
}

void ParticleFilter::StartAround(const Pose2& X_WB, double sd_m, double sd_rad) {
  particles_.clear();
  for (int i = 0; i < params_.most; ++i) {
    Pose2 pose = X_WB;
    for (int k = 0; k < kTries; ++k) {
      pose = {X_WB.x_m + sd_m * draws_.Normal(), X_WB.y_m + sd_m * draws_.Normal(),
              WrapAngle(X_WB.yaw_rad + sd_rad * draws_.Normal())};
      if (IsFree(pose)) break;
    }
    particles_.push_back({pose, 1.0 / params_.most});
  }
  FindBest();
}

void ParticleFilter::StartAnywhere() {
  particles_.clear();
  for (int i = 0; i < params_.most; ++i) particles_.push_back({Anywhere(), 1.0 / params_.most});
  FindBest();
}

void ParticleFilter::Move(const Pose2& motion_B) {
  const double way_m = motion_B.p().norm(), turn_rad = std::abs(motion_B.yaw_rad);
  const double way_sd = params_.way_m + params_.way_per_way * way_m;
  const double turn_sd =
      params_.turn_rad + params_.turn_per_turn * turn_rad + params_.turn_per_m * way_m;
  for (Particle& particle : particles_) {
    const Pose2 noisy{motion_B.x_m + way_sd * draws_.Normal(),
                      motion_B.y_m + way_sd * draws_.Normal(),
                      motion_B.yaw_rad + turn_sd * draws_.Normal()};
    particle.X_WB = particle.X_WB * noisy;
  }
  best_ = best_ * motion_B;
}

void ParticleFilter::Jitter(double sd_m, double sd_rad) {
  for (Particle& particle : particles_) {
    particle.X_WB.x_m += sd_m * draws_.Normal();
    particle.X_WB.y_m += sd_m * draws_.Normal();
    particle.X_WB.yaw_rad = WrapAngle(particle.X_WB.yaw_rad + sd_rad * draws_.Normal());
  }
}

// Of the scan from this pose: the sum over its beams.
double ParticleFilter::LogFit(const LikelihoodField& field, const LikelihoodField::Table& table,
                              const Pose2& X) const {
  if (!IsFree(X)) return static_cast<double>(ends_.size()) * static_cast<double>(table.back());
  const double c = std::cos(X.yaw_rad), s = std::sin(X.yaw_rad);
  double sum = 0;
  for (const Vec2& end : ends_)
    sum += static_cast<double>(table[field.StepsAway(
        {X.x_m + c * end.x() - s * end.y(), X.y_m + s * end.x() + c * end.y()})]);
  return sum;
}

bool ParticleFilter::Weigh(const LikelihoodField& field, const LidarScan& scan) {
  ends_.clear();
  scan.ForEachEnd([&](const Vec2& p_L) { ends_.push_back(scan.X_BL * p_L); });
  if (ends_.empty() || static_cast<double>(ends_.size()) <
                           params_.least_ends * static_cast<double>(scan.range_m.size())) {
    FindBest();
    return false;
  }
  const auto beams = static_cast<double>(ends_.size());
  const bool apart = position_std_m_ > kApart_m;
  double fit = 0, highest = -std::numeric_limits<double>::infinity();
  // Logarithms first, so that many beams do not underflow; `weight` holds them meanwhile.
  for (Particle& particle : particles_) {
    const double log_narrow = LogFit(field, narrow_, particle.X_WB);
    const double log_fit = apart ? LogFit(field, wide_, particle.X_WB) : log_narrow;
    fit += particle.weight * std::exp(log_narrow / beams);
    particle.weight = std::log(particle.weight) + params_.scan_weight * log_fit;
    highest = std::max(highest, particle.weight);
  }
  double total = 0;
  for (Particle& particle : particles_)
    total += particle.weight = std::exp(particle.weight - highest);
  for (Particle& particle : particles_) particle.weight /= total;
  slow_ = slow_ > 0 ? slow_ + params_.recover_slow * (fit - slow_) : fit;
  fast_ = fast_ > 0 ? fast_ + params_.recover_fast * (fit - fast_) : fit;
  FindBest();
  Resample(params_.recover_slow > 0 ? std::max(0.0, 1 - fast_ / (params_.recover_below * slow_))
                                    : 0);
  return true;
}

ParticleFilter::Bin& ParticleFilter::BinOf(const Pose2& X_WB) {
  const auto part = [](double value, double size, unsigned bits) {
    const auto whole = static_cast<std::int64_t>(std::floor(value / size));
    return static_cast<std::uint64_t>(whole) & ((1ULL << bits) - 1);
  };
  const std::uint64_t key = part(X_WB.x_m, kBin_m, 26) << 38 | part(X_WB.y_m, kBin_m, 26) << 12 |
                            part(X_WB.yaw_rad + kPi, kBin_rad, 12);
  std::uint64_t place = key * 0x9e3779b97f4a7c15ULL >> 32;
  for (;; ++place) {
    Bin& bin = bins_[place & (bins_.size() - 1)];
    if (bin.turn != turn_) {
      bin = {key, 0, Vec2::Zero(), Vec2::Zero(), turn_};
      return bin;
    }
    if (bin.key == key) return bin;
  }
}

// Draws until the bins that are filled ask for no more.
void ParticleFilter::Resample(double inject) {
  cumulative_.clear();
  double sum = 0;
  for (const Particle& particle : particles_) cumulative_.push_back(sum += particle.weight);
  next_.clear();
  ++turn_;
  int filled = 0, wanted = params_.least;
  while (static_cast<int>(next_.size()) < std::min(wanted, params_.most)) {
    Pose2 pose;
    if (inject > 0 && draws_.Uniform() < inject) {
      pose = Anywhere();
    } else {
      const auto drawn = std::ranges::upper_bound(cumulative_, draws_.Uniform() * sum);
      const auto i =
          std::min(static_cast<std::size_t>(drawn - cumulative_.begin()), particles_.size() - 1);
      pose = particles_[i].X_WB;
    }
    next_.push_back({pose, 1});
    Bin& bin = BinOf(pose);
    if (bin.weight == 0) wanted = std::max(params_.least, KldSize(++filled));
    bin.weight += 1;
  }
  for (Particle& particle : next_) particle.weight = 1.0 / static_cast<double>(next_.size());
  std::swap(particles_, next_);
}

void ParticleFilter::FindBest() {
  ++turn_;
  const Bin* heaviest = nullptr;
  double most = 0;
  for (const Particle& particle : particles_) {
    Bin& bin = BinOf(particle.X_WB);
    bin.weight += particle.weight;
    bin.sum += particle.weight * particle.X_WB.p();
    bin.heading +=
        particle.weight * Vec2(std::cos(particle.X_WB.yaw_rad), std::sin(particle.X_WB.yaw_rad));
    if (bin.weight > most) {
      most = bin.weight;
      heaviest = &bin;
    }
  }
  if (heaviest == nullptr || !(most > 0)) return;
  const Vec2 middle = heaviest->sum / heaviest->weight;
  const double yaw_rad = std::atan2(heaviest->heading.y(), heaviest->heading.x());
  // The group around it, which bins may have cut in parts.
  double weight = 0, all = 0, square = 0;
  Vec2 sum = Vec2::Zero(), heading = Vec2::Zero();
  for (const Particle& particle : particles_) {
    const Pose2& X = particle.X_WB;
    if ((X.p() - middle).norm() > kNearBins * kBin_m ||
        std::abs(WrapAngle(X.yaw_rad - yaw_rad)) > kNearBins * kBin_rad)
      continue;
    weight += particle.weight;
    sum += particle.weight * X.p();
    heading += particle.weight * Vec2(std::cos(X.yaw_rad), std::sin(X.yaw_rad));
  }
  const Vec2 p = sum / weight;
  best_ = {p.x(), p.y(), std::atan2(heading.y(), heading.x())};
  for (const Particle& particle : particles_) {
    all += particle.weight;
    square += particle.weight * (particle.X_WB.p() - p).squaredNorm();
  }
  position_std_m_ = std::sqrt(square / all);
}

}  // namespace floorproof
