// SPDX-License-Identifier: Apache-2.0
// No seam is felt: where something is missing from a floor, the floor is made of slabs, and a robot
// that rolls from one to the next must not notice. Pits beside the way cut the bench's floor into
// slabs of 0.10 and 0.25 m. The latter is also the distance between hTetro's wheels, so that two
// rows meet a seam at once, the worst case.
//
// The bounds and their reason are in vertical_motion.h; tests/physics holds them on real maps. The
// wrong model has every second slab 1 mm lower: neither friction nor wheels say anything of seams.
#include "validate/law.h"
#include "validate/vertical_motion.h"

namespace floorproof {
namespace {

class Seams final : public Law {
 public:
  std::string_view statement() const override {
    return "rolling over the seams of a floor of slabs: vertical acceleration and height 0";
  }
  std::vector<WrongModel> notices() const override { return {{.seam_step_m = 0.001}}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    Row("beluga", "forward", {0.25, 0, 0}, wrong, rows);
    Row("beluga", "curve", {0.25, 0, 0.3}, wrong, rows);
    Row("htetro", "forward", {0.25, 0, 0}, wrong, rows);
    Row("htetro", "aslant", {0.20, 0.15, 0}, wrong, rows);
  }

 private:
  static void Row(const std::string& robot, const std::string& way, const BodyTwist& twist,
                  const WrongModel& wrong, std::vector<LawRow>& rows) {
    constexpr double kFrom_s = 1, kTo_s = 7;
    RigOptions options{.wrong = wrong};
    for (int i = 0; i < 6; ++i) {
      const double x_m = 0.3 + 0.35 * i;
      Hazard pit;
      pit.id = "pit" + std::to_string(i);
      pit.solids = {{Solid::Kind::kCut, Rectangle({x_m, -6}, {x_m + 0.1, -4}), {}, -0.1, 0}};
      options.hazards.push_back(pit);
    }
    Rig rig(robot, std::move(options));
    rig.Run(twist, kFrom_s);
    VerticalMotion motion;
    while (rig.truth().t_s < kTo_s) {
      rig.Step();
      motion.Update(rig.truth());
    }
    const std::string law = "seams/" + robot + "/" + way;
    rows.push_back({law + "/acceleration", 0, motion.accel_mps2(), kMaxHeave_mps2, "m/s^2"});
    rows.push_back({law + "/height", 0, 1000 * motion.height_m(), 1000 * kMaxHeave_m, "mm"});
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Seams)

}  // namespace floorproof
