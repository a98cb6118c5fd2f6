// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/wheel_finder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/comma_list.h"
#include "base/error.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr double kUpright = 0.9, kLying = 0.2;  // of an axle's unit vector, along the vertical
constexpr double kAlike = 0.05;  // radii that differ by no larger share belong to one pair

std::vector<std::string> Names(const std::string& text) {
  std::vector<std::string> names = SplitAtCommas(text);
  std::erase(names, "");
  return names;
}

class WheelFinder {
 public:
  WheelFinder(const fs::path& file, const UrdfModel& model, const std::vector<LinkGroup>& groups,
              const UrdfAnswers& answers, const ChooseDrive& choose,
              std::vector<std::string>& notes)
      : file_(file),
        model_(model),
        groups_(groups),
        answers_(answers),
        choose_(choose),
        notes_(notes) {}

  FoundWheels Find() {
    FindRollers();
    out_.driven = ChooseDriven();
    PlaceBody(out_.driven);
    return std::move(out_);
  }

 private:
  [[noreturn]] void Refuse(const std::string& key, const std::string& rule) const {
    throw InputError({file_.string(), 0}, key, "", rule);
  }
  const UrdfLink& Head(std::size_t group) const {
    return model_.links[static_cast<std::size_t>(groups_[group].head)];
  }
  bool HangsOnBase(std::size_t group) const { return groups_[group].parent == 0; }

  void FindRollers() {
    for (std::size_t g = 1; g < groups_.size(); ++g) {
      const UrdfLink& head = Head(g);
      if (std::abs(head.axis_M.z()) > kLying) continue;
      const auto parent = static_cast<std::size_t>(groups_[g].parent);
      const bool swivels =
          parent != 0 && HangsOnBase(parent) && std::abs(Head(parent).axis_M.z()) > kUpright;
      if (!HangsOnBase(g) && !swivels) continue;
      auto fit = FitRound(groups_[g].shapes, head.p_M, head.axis_M);
      if (!fit && answers_.wheel_radius_m)
        fit = RoundFit{head.p_M, *answers_.wheel_radius_m, 0.2 * *answers_.wheel_radius_m,
                       "its width: it has no shape"};
      if (!fit) continue;
      const double low_m = fit->centre.z() - fit->radius_m;
      out_.rollers.push_back({g, std::move(*fit), swivels, low_m});
    }
    if (out_.rollers.empty())
      Refuse("wheels",
             "no continuous joint has a level axle and a link with a shape: it has no driven "
             "wheels, or their meshes are missing (--set wheel_radius_m stands for these)");
    floor_m_ = std::numeric_limits<double>::infinity();
    for (const Roller& roller : out_.rollers) floor_m_ = std::min(floor_m_, roller.low_m);
    std::erase_if(out_.rollers, [&](const Roller& roller) {
      const double gap_m = roller.low_m - floor_m_;
      if (gap_m <= FloorGap(roller.fit.radius_m)) return false;
      hanging_.push_back({Head(roller.group).joint_name, gap_m});
      return true;
    });
    for (const Roller& roller : out_.rollers) RefuseSteering(Head(roller.group));
  }

  // A wheel below an upright joint with limits steers, which no URDF says more of.
  void RefuseSteering(const UrdfLink& wheel) const {
    for (int at = wheel.parent; at >= 0;) {
      const UrdfLink& link = model_.links[static_cast<std::size_t>(at)];
      if (link.joint == UrdfLink::Joint::kHinge && !link.turns_freely &&
          std::abs(link.axis_M.z()) > kUpright)
        Refuse("joint " + link.joint_name,
               "steers the wheel of " + wheel.joint_name +
                   ": write such a robot's MJCF by hand (docs/adding-a-robot.md); where the wheel "
                   "swivels freely the joint is continuous, where it stands straight, fixed");
      at = link.parent;
    }
  }

  // Indices into out_.rollers.
  std::vector<std::size_t> ChooseDriven() {
    if (const auto names = Names(answers_.driven); !names.empty()) return NamedDriven(names);
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < out_.rollers.size(); ++i)
      if (!out_.rollers[i].swivels) all.push_back(i);
    if (all.empty()) Refuse("wheels", "all wheels swivel: none is driven");
    std::string why;
    if (Takes(all, why)) {
      if (all.size() > 2 && !answers_.roller_radius_m)
        notes_.push_back(
            "guess: its " + std::to_string(all.size()) +
            " wheels are plain (--set roller_radius_m=... where they are Mecanum wheels)");
      return all;
    }
    for (const auto& pair : Pairs(all)) {
      std::string ignored;
      if (!Takes(pair, ignored)) continue;
      notes_.push_back("guess: " + JointOf(pair[0]) + " and " + JointOf(pair[1]) +
                       " are driven, the other wheels roll freely (--set driven=...)");
      return pair;
    }
    if (!hanging_.empty()) why = HangingText() + ": mend its height; without it " + why;
    if (all.size() > 1) why += " (--set driven=LEFT_JOINT,RIGHT_JOINT names the driven ones)";
    Refuse("drive", why);
  }

  std::vector<std::size_t> NamedDriven(const std::vector<std::string>& names) {
    std::vector<std::size_t> driven;
    std::vector<std::string> known;
    for (const Roller& roller : out_.rollers) known.push_back(Head(roller.group).joint_name);
    for (const std::string& name : names) {
      const auto at = std::ranges::find(known, name);
      if (const auto wheel = std::ranges::find(hanging_, name, &Hanging::joint);
          wheel != hanging_.end())
        throw InputError({"--set driven", 0}, "", name, HangsOver(*wheel));
      if (at == known.end())
        throw InputError({"--set driven", 0}, "", name,
                         "is no wheel that reaches the floor" + DidYouMeanOneOf(name, known));
      driven.push_back(static_cast<std::size_t>(at - known.begin()));
    }
    std::string why;
    if (!Takes(driven, why)) Refuse("drive", why);
    return driven;
  }

  // A wheel that does not reach the floor.
  struct Hanging {
    std::string joint;
    double gap_m;
  };
  std::string HangsOver(const Hanging& wheel) const {
    return "hangs " + LengthText(wheel.gap_m) + " over the floor that " + JointOf(0) + " stands on";
  }
  std::string HangingText() const {
    std::string text;
    for (const Hanging& wheel : hanging_)
      text += (text.empty() ? "" : ", ") + wheel.joint + " " + HangsOver(wheel);
    return text;
  }

  const std::string& JointOf(std::size_t roller) const {
    return Head(out_.rollers[roller].group).joint_name;
  }

  // Two of one size on one axle, the largest first.
  std::vector<std::vector<std::size_t>> Pairs(const std::vector<std::size_t>& all) const {
    std::vector<std::vector<std::size_t>> pairs;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        const RoundFit &a = out_.rollers[all[i]].fit, &b = out_.rollers[all[k]].fit;
        const Vec3 apart = b.centre - a.centre, axis = Head(out_.rollers[all[i]].group).axis_M;
        const bool level = apart.cross(axis).norm() < kAlike * apart.norm();
        if (level && std::abs(a.radius_m - b.radius_m) < kAlike * a.radius_m)
          pairs.push_back({all[i], all[k]});
      }
    std::ranges::stable_sort(pairs, std::greater{},
                             [&](const auto& pair) { return out_.rollers[pair[0]].fit.radius_m; });
    return pairs;
  }

  // The pose of B in M with these driven wheels: forward is square to the axle, as near to the
  // model's x as it goes.
  void PlaceBody(const std::vector<std::size_t>& driven) {
    Vec3 left = Head(out_.rollers[driven[0]].group).axis_M;
    left.z() = 0;
    left.normalize();
    if (left.y() < 0 || (left.y() == 0 && left.x() < 0)) left = -left;
    out_.R_MB.col(0) = left.cross(Vec3::UnitZ());
    out_.R_MB.col(1) = left;
    out_.R_MB.col(2) = Vec3::UnitZ();
    out_.p_MB = Vec3::Zero();
    for (const std::size_t i : driven)
      out_.p_MB += out_.rollers[i].fit.centre / static_cast<double>(driven.size());
    out_.p_MB.z() = floor_m_;
  }

  bool Takes(const std::vector<std::size_t>& driven, std::string& why) {
    PlaceBody(driven);
    RobotSpec spec;
    for (const std::size_t i : driven) {
      WheelSpec& wheel = spec.wheels.emplace_back();
      wheel.name = JointOf(i);
      wheel.p_BW = out_.R_MB.transpose() * (out_.rollers[i].fit.centre - out_.p_MB);
      wheel.radius_m = out_.rollers[i].fit.radius_m;
      wheel.half_width_m = out_.rollers[i].fit.half_width_m;
      if (answers_.roller_radius_m) {
        wheel.roller_radius_m = *answers_.roller_radius_m;
        wheel.roller_angle_rad = RollerAngle(wheel.p_BW);
      }
      wheel.max_speed_radps = wheel.max_torque_nm = 1;  // whatever they are, there are motors
    }
    const auto choice = choose_(spec, why);
    if (!choice) return false;
    out_.drive = *choice;
    return true;
  }

  const fs::path& file_;
  const UrdfModel& model_;
  const std::vector<LinkGroup>& groups_;
  const UrdfAnswers& answers_;
  const ChooseDrive& choose_;
  std::vector<std::string>& notes_;
  std::vector<Hanging> hanging_;
  double floor_m_ = 0;
  FoundWheels out_;
};

}  // namespace

FoundWheels FindWheels(const fs::path& file, const UrdfModel& model,
                       const std::vector<LinkGroup>& groups, const UrdfAnswers& answers,
                       const ChooseDrive& choose, std::vector<std::string>& notes) {
  return WheelFinder(file, model, groups, answers, choose, notes).Find();
}

double RollerAngle(const Vec3& p_B) { return std::copysign(kPi / 4, p_B.x() * p_B.y()); }

double FloorGap(double radius_m) { return std::max(0.003, 0.1 * radius_m); }

}  // namespace floorproof
