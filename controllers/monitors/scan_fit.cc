// SPDX-License-Identifier: Apache-2.0
// How well scans fit the map where the robot thinks it stands: the share of beams that end near
// what the map knows. It falls where the robot was carried, or has lost its way. Held against its
// own mean since the start, as on every floor some things are on no map.
#include <cmath>
#include <optional>

#include "controllers/likelihood_field.h"
#include "controllers/monitors/lean_angle.h"

namespace floorproof {
namespace {

class ScanFit final : public Monitor {
 public:
  ScanFit() : Monitor({.hold_s = 0.5, .clear_s = 1}) {}
  bool by_estimate() const override { return true; }
  MonitorKind kind() const override { return MonitorKind::kTrend; }
  std::vector<Reading> Needs() const override { return {Reading::kScan}; }

  void Update(const MonitorReadings& now) override {
    const LidarScan& scan = now.scan;
    if (lean_.Update(now) > most_lean_deg_ * kPi / 180) return;
    if (scan.fresh) Measure(scan, now.estimate.X_WB);
    if (scans_ < kFirst) return;
    const double limit = fall_ * usual_;
    const bool bad = now_share_ < limit;
    alarm().Update(now.t_s, now.dt_s, bad, !bad && scan.fresh, now_share_, limit);
  }

 private:
  static constexpr int kFirst = 10;  // scans, before it knows what is usual

  void VisitOwn(ParamVisitor& v) override {
    v("fall", fall_, Between(0, 1), "least share of the usual fit");
    v("most_lean_deg", most_lean_deg_, Between(0, 90),
      "of a robot that leans more by its IMU, as on an edge, the scans say nothing (deg)");
    v("fit_m", fit_m_, Between(0.01, 1), "a beam fits that ends within this of what is known (m)");
  }
  void StartOwn(const MonitorContext& context) override {
    known_ = &context.known;
    field_.reset();
    scans_ = 0;
    lean_.Reset();
    usual_ = now_share_ = 0;
  }

  // The first scan allocates: only then the height of its plane is known.
  void Measure(const LidarScan& scan, const Pose2& X_WB) {
    if (!field_) field_.emplace(*known_, scan.height_m);
    const Pose2 X_WL = X_WB * scan.X_BL;
    const auto most = static_cast<int>(fit_m_ / LikelihoodField::kStep_m);
    int ends = 0, fit = 0;
    scan.ForEachEnd([&](const Vec2& p_L) {
      ++ends;
      fit += field_->StepsAway(X_WL * p_L) <= most ? 1 : 0;
    });
    if (ends == 0) return;
    now_share_ = fit / static_cast<double>(ends);
    // The mean of all scans that fitted; what does not fit is not usual.
    if (scans_ < kFirst || now_share_ >= fall_ * usual_) {
      ++scans_;
      usual_ += (now_share_ - usual_) / scans_;
    }
  }

  double fall_ = 0.7, fit_m_ = 0.1, most_lean_deg_ = 2;
  LeanAngle lean_;
  const HazardMap* known_ = nullptr;
  std::optional<LikelihoodField> field_;
  int scans_ = 0;
  double usual_ = 0, now_share_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Monitor, ScanFit)

}  // namespace floorproof
