// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_robot.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/params.h"
#include "base/quantity.h"
#include "env/urdf/base_mass.h"
#include "env/urdf/link_groups.h"
#include "env/urdf/link_mass.h"
#include "env/urdf/round_fit.h"
#include "env/urdf/wheel_finder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr double kCrowned = 0.5;  // of a tyre's width, what touches the floor

class PartFinder {
 public:
  PartFinder(const fs::path& file, UrdfModel model, const UrdfAnswers& answers,
             const ChooseDrive& choose)
      : file_(file), model_(std::move(model)), answers_(answers), choose_(choose) {
    out_.name = model_.name;
    out_.notes = model_.notes;
    groups_ = GroupLinks(model_, out_.notes);
    holder_.resize(groups_.size());
  }

  UrdfRobot Find() {
    found_ = FindWheels(file_, model_, groups_, answers_, choose_, out_.notes);
    out_.drive = found_.drive.name;
    out_.holonomic = found_.drive.holonomic;
    Assign();
    MoveIntoBody();
    MakeWheels();
    MakeBase();
    MakeBalls();
    SayWhatIsLost();
    AskForSprings();
    Sensors();
    return std::move(out_);
  }

 private:
  [[noreturn]] void Refuse(const std::string& key, const std::string& rule) const {
    throw InputError({file_.string(), 0}, key, "", rule);
  }
  const UrdfLink& Head(std::size_t group) const {
    return model_.links[static_cast<std::size_t>(groups_[group].head)];
  }

  // Which part each group goes to: what is neither wheel nor caster, to what carries it.
  void Assign() {
    std::set<std::size_t> kept;
    for (const Roller& roller : found_.rollers) {
      kept.insert(roller.group);
      if (roller.swivels) kept.insert(static_cast<std::size_t>(groups_[roller.group].parent));
    }
    for (std::size_t g = 1; g < groups_.size(); ++g) {
      if (kept.contains(g)) {
        holder_[g] = g;
        continue;
      }
      holder_[g] = holder_[static_cast<std::size_t>(groups_[g].parent)];
      out_.notes.push_back("joint " + Head(g).joint_name +
                           " turns for ever and is no wheel on the floor: held where it stands");
    }
    driven_groups_.clear();
    for (const std::size_t i : found_.driven) driven_groups_.insert(found_.rollers[i].group);
  }

  void MoveIntoBody() {
    model_.MoveInto(found_.R_MB, found_.p_MB);
    std::vector<std::string> said;
    groups_ = GroupLinks(model_, said);
    for (Roller& roller : found_.rollers)
      roller.fit.centre = found_.R_MB.transpose() * (roller.fit.centre - found_.p_MB);
    constexpr double kAskew = 0.05;
    if (found_.R_MB.col(0).x() < 1 - kAskew)
      out_.notes.push_back("guess: forward is square to the axle, not the root link's x");
  }

  // A part with all groups that go with it.
  void Collect(std::size_t part, MassOf& mass, std::vector<UrdfShape>& shapes) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (holder_[g] != part) continue;
      mass += groups_[g].mass;
      shapes.insert(shapes.end(), groups_[g].shapes.begin(), groups_[g].shapes.end());
    }
  }

  UrdfWheel WheelOf(const Roller& roller) {
    const UrdfLink& head = Head(roller.group);
    UrdfWheel wheel;
    wheel.name = head.joint_name;
    wheel.p_B = roller.fit.centre;
    wheel.axle_B = head.axis_M.y() < 0 ? Vec3(-head.axis_M) : head.axis_M;
    wheel.radius_m = roller.fit.radius_m;
    wheel.half_width_m = kCrowned * roller.fit.half_width_m;
    wheel.effort_nm = head.effort_nm;
    wheel.velocity_radps = head.velocity_radps;
    Collect(roller.group, wheel.mass, wheel.looks);
    if (!roller.fit.guess.empty())
      out_.notes.push_back("guess: of wheel " + wheel.name + " " + roller.fit.guess);
    if (!(wheel.mass.mass_kg > 0)) {
      constexpr double kDensity = 1000, kFull = 0.5;  // kg/m3; of its cylinder, what is not air
      const double volume_m3 = 2 * kPi * wheel.radius_m * wheel.radius_m * roller.fit.half_width_m;
      wheel.mass = BoxMass(wheel.looks, kFull * kDensity * volume_m3);
      wheel.mass.com_M = wheel.p_B;
      out_.notes.push_back("guess: wheel " + wheel.name + " weighs " +
                           NumberText(wheel.mass.mass_kg, 2) + " kg; the file gives it no mass");
    }
    return wheel;
  }

  void MakeWheels() {
    for (const std::size_t i : found_.driven) {
      UrdfWheel& wheel = out_.wheels.emplace_back(WheelOf(found_.rollers[i]));
      if (!answers_.roller_radius_m) continue;
      wheel.roller_radius_m = *answers_.roller_radius_m;
      wheel.roller_angle_rad = RollerAngle(wheel.p_B);
      if (!(wheel.roller_radius_m < wheel.radius_m))
        throw InputError({"--set roller_radius_m", 0}, "", FormatDouble(wheel.roller_radius_m),
                         "must be less than the radius of wheel " + wheel.name + ", " +
                             FormatDouble(wheel.radius_m) + " m");
    }
    for (const Roller& roller : found_.rollers) {
      if (driven_groups_.contains(roller.group)) continue;
      UrdfCaster caster;
      caster.kind = roller.swivels ? UrdfCaster::Kind::kSwivel : UrdfCaster::Kind::kWheel;
      caster.wheel = WheelOf(roller);
      caster.name = caster.wheel.name;
      if (roller.swivels) {
        const auto fork = static_cast<std::size_t>(groups_[roller.group].parent);
        caster.name = Head(fork).joint_name;
        caster.pivot_B = Head(fork).p_M;
        Collect(fork, caster.fork, caster.fork_looks);
      }
      out_.casters.push_back(std::move(caster));
    }
  }

  void MakeBase() {
    Collect(0, out_.base, out_.shapes);
    if (!(out_.base.mass_kg > 0))
      Refuse("mass", "no link but its wheels has a mass: give the base an <inertial>");
    std::erase_if(out_.shapes, IsMark);
    if (out_.shapes.empty()) RefuseWithoutShape("has no shape");
    CollideAsSeen([](const UrdfShape&) { return true; });
    const double base_kg = out_.base.mass_kg;
    const std::string why = WhyTooLight(LinksOfBase(), base_kg, out_.mass_kg() - base_kg);
    if (!why.empty()) Refuse("mass", why);
  }

  std::vector<const UrdfLink*> LinksOfBase() const {
    std::vector<const UrdfLink*> links;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (holder_[g] == 0)
        for (const std::size_t i : groups_[g].links) links.push_back(&model_.links[i]);
    return links;
  }

  // The box of a millimetre that some simulators ask of a link without a body.
  static bool IsMark(const UrdfShape& shape) {
    constexpr double kMark_m = 0.003;
    return BoundsOf(shape).sizes().maxCoeff() <= kMark_m;
  }

  // The first mesh of the base's collisions that cannot be read, and why; empty: all can.
  std::string LostMeshOfBase() const {
    for (const UrdfLink* link : LinksOfBase())
      if (!link->lost_mesh.empty()) return link->lost_mesh;
    return "";
  }

  [[noreturn]] void RefuseWithoutShape(const std::string& what) const {
    const std::string lost = LostMeshOfBase();
    Refuse("base", what + ": give it a <collision>" + (lost.empty() ? "" : "; " + lost));
  }

  // Where nothing of the base collides, what of it is seen does, if it may.
  template <class May>
  void CollideAsSeen(const May& may) {
    if (std::ranges::any_of(out_.shapes, &UrdfShape::collides)) return;
    bool any = false;
    for (UrdfShape& shape : out_.shapes) any |= shape.collides = may(shape);
    if (!any) RefuseWithoutShape("has no shape but its casters");
    is_as_seen_ = true;
    out_.notes.push_back(std::string("guess: the base's visual shapes are used for collision; ") +
                         (LostMeshOfBase().empty() ? "it has no <collision> of its own"
                                                   : "the mesh of its <collision> is left out"));
  }

  static bool HasBody(const UrdfLink& link) {
    return std::ranges::any_of(link.shapes, [](const UrdfShape& shape) { return !IsMark(shape); });
  }

  // Each link of the base lacks what a lost mesh was, unless its visual shapes are used instead.
  void SayWhatIsLost() {
    for (const UrdfLink* link : LinksOfBase())
      if (!link->lost_mesh.empty() && !(is_as_seen_ && HasBody(*link)))
        out_.wrong.push_back("a <collision> of link " + link->name +
                             " is left out: " + link->lost_mesh);
  }

  double LargestRadius() const {
    double radius_m = 0;
    for (const UrdfWheel& wheel : out_.wheels) radius_m = std::max(radius_m, wheel.radius_m);
    return radius_m;
  }

  // What of the body reaches the floor, and is no wider than a wheel: skirts, squeegees and low
  // bodies are wider. Casters are drawn round, or as boxes that touch; a box in the air is a part
  // of the body.
  bool IsCaster(const UrdfShape& shape, double wheel_m) const {
    constexpr double kTouches_m = 0.003;
    const Eigen::AlignedBox3d bounds = BoundsOf(shape);
    const double gap_m = shape.kind == UrdfShape::Kind::kBox ? kTouches_m : FloorGap(wheel_m);
    return bounds.min().z() <= gap_m && bounds.sizes().head<2>().maxCoeff() <= 2 * wheel_m;
  }

  void MakeBalls() {
    constexpr double kHangs_m = 0.001;
    const double wheel_m = LargestRadius();
    for (UrdfShape& shape : out_.shapes) {
      const double low_m = BoundsOf(shape).min().z();
      const bool is_caster = IsCaster(shape, wheel_m);
      if (!shape.collides || (!is_caster && low_m > kHangs_m)) continue;
      if (!is_caster || low_m < -FloorGap(wheel_m))
        Refuse("base", "has a shape whose lowest point is " + LengthText(std::abs(low_m)) +
                           (low_m < 0 ? " below" : " above") + " the floor of its wheels, " +
                           (is_caster ? "too low for a caster" : "too large for a caster") +
                           ": fix its <collision>, or the positions of the wheels");
      AddBall(FitBall(shape), low_m);
      shape.collides = false;
    }
    // Casters are no body.
    CollideAsSeen([&](const UrdfShape& shape) {
      return !IsCaster(shape, wheel_m) && BoundsOf(shape).min().z() > kHangs_m;
    });
  }

  void AddBall(const BallFit& fit, double low_m) {
    constexpr double kSame_m = 0.005;
    for (const UrdfCaster& other : out_.casters)
      if (other.kind == UrdfCaster::Kind::kBall &&
          (other.wheel.p_B - fit.centre).head<2>().norm() < kSame_m)
        return;
    UrdfCaster caster;
    caster.name = "caster_" + std::to_string(out_.casters.size());
    caster.wheel.name = caster.name;
    caster.wheel.p_B = fit.centre;
    caster.wheel.radius_m = fit.radius_m;
    constexpr double kSeen_m = 1e-4;
    if (low_m < -kSeen_m) {
      caster.wheel.p_B.z() -= low_m;
      out_.notes.push_back(caster.name + " reached " + LengthText(-low_m) +
                           " below the wheels: raised onto the floor");
    }
    const auto millimetres = [](double m) { return std::to_string(std::lround(1000 * m)); };
    out_.notes.push_back("guess: " + caster.name + ", at x " + millimetres(fit.centre.x()) +
                         ", y " + millimetres(fit.centre.y()) + " mm, slides" +
                         (fit.guess.empty() ? "" : "; " + fit.guess));
    out_.casters.push_back(std::move(caster));
  }

  // Between casters, held wheels carry what the floor's last tenth of a millimetre says.
  void AskForSprings() {
    if (answers_.sprung_share > 0) return;
    bool ahead = false, behind = false;
    for (const UrdfCaster& caster : out_.casters)
      (caster.wheel.p_B.x() > 0 ? ahead : behind) = true;
    if (ahead && behind)
      out_.notes.push_back(
          "guess: its driven wheels, between casters, have no springs (--set sprung_share=...)");
  }

  void Sensors() {
    const auto find = [&](std::initializer_list<const char*> words) -> std::optional<Vec3> {
      for (const UrdfLink& link : model_.links) {
        std::string name = link.name;
        std::ranges::transform(name, name.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        for (const char* word : words)
          if (name.find(word) != std::string::npos) return link.p_M;
      }
      return std::nullopt;
    };
    out_.lidar_B = find({"lidar", "laser", "scan", "hokuyo"});
    out_.imu_B = find({"imu"});
    if (answers_.lidar_z_m) {
      if (!out_.lidar_B) out_.lidar_B = Vec3::Zero();
      out_.lidar_B->z() = *answers_.lidar_z_m;
    }
  }

  fs::path file_;
  UrdfModel model_;
  const UrdfAnswers& answers_;
  const ChooseDrive& choose_;
  std::vector<LinkGroup> groups_;
  std::vector<std::size_t> holder_;  // by group: the part that it goes to, a group's index
  FoundWheels found_;
  std::set<std::size_t> driven_groups_;
  bool is_as_seen_ = false;  // what is seen of the base collides
  UrdfRobot out_;
};

}  // namespace

double UrdfRobot::mass_kg() const {
  double sum_kg = base.mass_kg;
  for (const UrdfWheel& wheel : wheels) sum_kg += wheel.mass.mass_kg;
  for (const UrdfCaster& caster : casters)
    sum_kg += caster.wheel.mass.mass_kg + caster.fork.mass_kg;
  return sum_kg;
}

UrdfRobot FindRobotParts(const fs::path& file, UrdfModel model, const UrdfAnswers& answers,
                         const ChooseDrive& choose) {
  return PartFinder(file, std::move(model), answers, choose).Find();
}

}  // namespace floorproof
