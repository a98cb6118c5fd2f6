// SPDX-License-Identifier: Apache-2.0
// A 2D lidar of the RP-LIDAR A3 class, mounted level on the robot and tilting with it.
//
// Every 1 / rate_hz all beams are cast at once (mj_multiRay; walls of large maps in the map): the
// robot's motion during a turn is not modelled. Glass lets a beam through unless it is met within
// glass_angle_deg of its normal. A surface of reflectance r is seen to range_m sqrt(r), as the
// light that comes back falls with r / range^2. What is lower than the plane is not met. A beam
// that meets something comes back with Gaussian noise, or, with chance `dropout`, not at all.
#include <algorithm>
#include <cmath>
#include <optional>

#include "env/sensors/body_frame.h"
#include "env/sensors/rays.h"
#include "env/sensors/sensor.h"

namespace floorproof {
namespace {

constexpr double kHousing_m = 0.06;  // of a scanner of this class: its own beams begin outside
constexpr int kMaxPanes = 8;         // a beam passes
constexpr double kThrough_m = 1e-4;  // beyond a surface that let it pass

class Lidar final : public Sensor {
 public:
  Reading Fills() const override { return Reading::kScan; }
  bool draws() const override { return noise_m_ > 0 || noise_share_ > 0 || dropout_ > 0; }
  void Visit(ParamVisitor& v) override {
    v("beams", beams_, Between(1, 3600), "in a turn, evenly spaced from straight ahead");
    v("rate_hz", rate_hz_, Between(0.1, 100), "turns a second");
    v("range_m", range_m_, Between(0.1, 100), "to which a white wall is seen (m)");
    v("least_m", least_m_, Between(0, 1), "nearer things are not told (m)");
    v("noise_m", noise_m_, Between(0, 1), "standard deviation of a range (m)");
    v("noise_share", noise_share_, Between(0, 1), "the same, as a share of the range; both add");
    v("dropout", dropout_, Between(0, 1), "chance that a beam does not come back");
    v("glass_angle_deg", glass_angle_deg_, Between(0, 90),
      "glass is seen within this angle of its normal (deg)");
    v("z_m", z_m_, Positive(), "height of the scan plane (m); none: of the model's site `lidar`");
  }

  void Start(const SensorContext& context, const mjData* data, const Truth& truth,
             const Stream& noise, Observation& out) override {
    context_.emplace(context);
    const mjModel* m = context.scene.model.get();
    stream_ = noise;
    rays_.emplace(context.scene);
    base_ = context.scene.base_body;
    const int site = mj_name2id(m, mjOBJ_SITE, "lidar");
    if (site < 0 && !z_m_)
      throw InputError({}, "sensors.lidar.z_m", "",
                       "must be stated: " + context.robot.name + " has no site `lidar`");
    p_R_ = site >= 0 ? Vec3(m->site_pos + 3 * site) : Vec3::Zero();
    if (z_m_) p_R_.z() = *z_m_;
    RefuseBlockedView(m, data);
    if (!(least_m_ < range_m_))
      throw InputError({}, "sensors.lidar.least_m", FormatDouble(least_m_),
                       "must be less than range_m, " + FormatDouble(range_m_));

    LidarScan& scan = out.scan;
    scan = {};
    scan.height_m = p_R_.z();
    scan.least_m = least_m_;
    scan.most_m = range_m_;
    scan.X_BL = MountOn(truth, data);
    const auto n = static_cast<std::size_t>(beams_);
    for (std::size_t i = 0; i < n; ++i)
      scan.angle_rad.push_back(WrapAngle(2 * kPi * static_cast<double>(i) / beams_));
    scan.range_m.assign(n, std::numeric_limits<double>::infinity());
    directions_W_.assign(3 * n, 0);
    hits_.assign(n, {});
    next_s_ = truth.t_s;
  }

  void Sense(mjData* data, const Truth& truth, Observation& out) override {
    LidarScan& scan = out.scan;
    scan.fresh = truth.t_s >= next_s_ - 1e-9;
    if (!scan.fresh) return;
    next_s_ += 1 / rate_hz_;
    const Rotation R_WR = RotationOf(data, base_);
    const Vec3 p_W = Vec3(data->xpos + 3 * base_) + R_WR * p_R_;
    scan.t_s = truth.t_s;
    // The mount is known, as are the hinges; how the robot tilts is not.
    if (truth.hinges.n > 0)
      scan.X_BL = truth.X_WB().Inverse() * Pose2{p_W.x(), p_W.y(), truth.yaw_rad};
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      const double a = scan.angle_rad[i];
      const Vec3 direction_W = R_WR * Vec3(std::cos(a), std::sin(a), 0);
      std::copy_n(direction_W.data(), 3, &directions_W_[3 * i]);
    }
    rays_->CastAll(data, p_W, directions_W_, range_m_, hits_);
    for (std::size_t i = 0; i < hits_.size(); ++i)
      scan.range_m[i] = Told(SeenThrough(data, p_W, Vec3(&directions_W_[3 * i]), hits_[i]));
  }

  // No scan is new.
  void Silence(Observation& out) const override { out.scan.fresh = false; }

 private:
  // As the robot stands level, at its start.
  Pose2 MountOn(const Truth& truth, const mjData* data) const {
    const Pose2 X_WR{data->xpos[3 * base_], data->xpos[3 * base_ + 1], truth.yaw_rad};
    const Vec2 p_W = X_WR * Vec2(p_R_.head<2>());
    return truth.X_WB().Inverse() * Pose2{p_W.x(), p_W.y(), truth.yaw_rad};
  }

  // What the beam comes back from.
  RayHit SeenThrough(const mjData* data, const Vec3& p_W, const Vec3& direction_W,
                     RayHit hit) const {
    double passed_m = 0;
    for (int pane = 0; pane < kMaxPanes && IsGlass(hit.geom); ++pane) {
      const double angle_rad =
          std::acos(std::min(1.0, std::abs(hit.normal_W.normalized().dot(direction_W))));
      if (angle_rad <= glass_angle_deg_ * kPi / 180) break;
      passed_m = hit.range_m + kThrough_m;
      hit = rays_->Cast(data, p_W + passed_m * direction_W, direction_W, range_m_ - passed_m);
      hit.range_m += passed_m;
    }
    return hit;
  }

  // Always as many draws, so that what one beam meets changes no other's noise.
  double Told(const RayHit& hit) {
    const double normal = stream_->Normal(), chance = stream_->Uniform();
    const double most_m = range_m_ * std::sqrt(Reflectance(hit.geom));
    if (!(hit.range_m >= least_m_ && hit.range_m <= most_m) || chance < dropout_)
      return std::numeric_limits<double>::infinity();
    const double told_m = hit.range_m + (noise_m_ + noise_share_ * hit.range_m) * normal;
    return std::clamp(told_m, least_m_, range_m_);
  }

  bool IsGlass(int geom) const {
    return geom >= 0 && context_->scene.model->geom_group[geom] == kGlassGroup;
  }
  double Reflectance(int geom) const {
    if (geom < 0) return 1;
    const int hazard = context_->scene.roles[static_cast<std::size_t>(geom)].hazard;
    return hazard < 0
               ? 1
               : context_->map.hazards[static_cast<std::size_t>(hazard)].material.reflectance;
  }

  // Beams begin outside the scanner's own housing; body and wheels beyond it would be all that they
  // see.
  void RefuseBlockedView(const mjModel* m, const mjData* data) const {
    const Rotation R_WR = RotationOf(data, base_);
    const Vec3 p_W = Vec3(data->xpos + 3 * base_) + R_WR * p_R_;
    for (int g = 0; g < m->ngeom; ++g) {
      const GeomRole::Kind kind = context_->scene.roles[static_cast<std::size_t>(g)].kind;
      if ((kind != GeomRole::Kind::kBody && kind != GeomRole::Kind::kWheel) ||
          m->geom_type[g] == mjGEOM_MESH)
        continue;
      for (int i = 0; i < beams_; ++i) {
        const double a = 2 * kPi * i / beams_;
        const Vec3 way_W = R_WR * Vec3(std::cos(a), std::sin(a), 0);
        const Vec3 from_W = p_W + kHousing_m * way_W;
        if (mju_rayGeom(data->geom_xpos + 3 * g, data->geom_xmat + 9 * g, m->geom_size + 3 * g,
                        from_W.data(), way_W.data(), m->geom_type[g], nullptr) < 0)
          continue;
        const char* name = mj_id2name(m, mjOBJ_GEOM, g);
        throw InputError({}, "sensors.lidar.z_m", FormatDouble(p_R_.z()),
                         "the robot itself is in the way of its beams: geom " +
                             (name ? std::string(name) : std::to_string(g)) + " of " +
                             context_->robot.name);
      }
    }
  }

  int beams_ = 90;
  double rate_hz_ = 10;
  double range_m_ = 25, least_m_ = 0.2;  // RP-LIDAR A3
  double noise_m_ = 0.005, noise_share_ = 0.005;
  double dropout_ = 0.005;
  double glass_angle_deg_ = 5;
  std::optional<double> z_m_;

  std::optional<SensorContext> context_;
  std::optional<Stream> stream_;
  std::optional<Rays> rays_;
  int base_ = -1;
  Vec3 p_R_ = Vec3::Zero();  // the scanner in the base's frame
  double next_s_ = 0;
  std::vector<double> directions_W_;
  std::vector<RayHit> hits_;
};

}  // namespace

FP_DEFINE_PLUGIN(Sensor, Lidar)

}  // namespace floorproof
