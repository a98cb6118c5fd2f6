// SPDX-License-Identifier: Apache-2.0
// A robot whose MJCF MuJoCo has compiled, with other numbers in it: what is read from it must be a
// robot that can be planned for, or refused. MuJoCo's own reading of text happens in a child
// process (env/scene/robot_mjcf.h), where it may crash.
//
// Bytes: which robot, then records of what is changed (1), which of them (2, little endian), to
// which value (1; or 0 and the 8 of a double).
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "env/scene/robot_model.h"
#include "env/scene/spec_reader.h"
#include "fuzz/read_or_refuse.h"

namespace {

using namespace floorproof;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 18> kValues = {0.0,   -0.0,   1.0,   -1.0, 0.5,  1e-3,
                                            1e-9,  1e-300, 10.0,  1e3,  1e9,  1e100,
                                            1e308, kInf,   -kInf, kNaN, 0.03, -1e100};

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  bool empty() const { return left_ == 0; }
  std::uint8_t Next() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  std::size_t Index() {
    const std::size_t low = Next();
    return low + 256u * Next();
  }
  double Value() {
    const std::uint8_t which = Next();
    if (which != 0) return kValues[which % kValues.size()];
    std::array<std::uint8_t, sizeof(double)> raw{};
    for (std::uint8_t& byte : raw) byte = Next();
    double value;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

// What the compiler leaves as it was written, of any value.
void Change(mjModel* m, Bytes& bytes) {
  struct Field {
    mjtNum* values;
    std::size_t count;
  };
  const auto n = [](auto count, int each = 1) {
    return static_cast<std::size_t>(count) * static_cast<std::size_t>(each);
  };
  const std::array fields = {
      Field{m->numeric_data, n(m->nnumericdata)},
      Field{m->geom_size, n(m->ngeom, 3)},
      Field{m->geom_pos, n(m->ngeom, 3)},
      Field{m->geom_rbound, n(m->ngeom)},
      Field{m->geom_user, n(m->ngeom, static_cast<int>(m->nuser_geom))},
      Field{m->body_pos, n(m->nbody, 3)},
      Field{m->body_mass, n(m->nbody)},
      Field{m->body_subtreemass, n(m->nbody)},
      Field{m->jnt_pos, n(m->njnt, 3)},
      Field{m->jnt_axis, n(m->njnt, 3)},
      Field{m->jnt_range, n(m->njnt, 2)},
      Field{m->qpos0, n(m->nq)},
      Field{m->actuator_gainprm, n(m->nu, mjNGAIN)},
      Field{m->actuator_forcerange, n(m->nu, 2)},
  };
  const std::size_t which = bytes.Next() % (fields.size() + 1), index = bytes.Index();
  if (which == fields.size()) {  // a letter of a text
    const std::size_t size = n(m->ntextdata);
    if (size > 0 && m->text_data[index % size] != '\0')
      m->text_data[index % size] = static_cast<char>(std::max<int>(1, bytes.Next()));
  } else if (fields[which].count > 0) {
    fields[which].values[index % fields[which].count] = bytes.Value();
  }
}

void Check(const RobotSpec& robot) {
  const auto in = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high))
      Finding(std::string(what) + " is " + std::to_string(value));
  };
  in("mass_kg", robot.mass_kg, 0.01, 1e4);
  in("tool_width_m", robot.tool_width_m, 0.01, 20);
  in("clearance_m", robot.clearance_m, 0, 20);
  in("height_m", robot.height_m, 0, 20);
  in("circumscribed_radius_m", robot.circumscribed_radius_m, 0, 20);
  in("inscribed_radius_m", robot.inscribed_radius_m, 0, 20);
  in("static_tip_rad", robot.static_tip_rad, 0, 1.6);
  in("max_speed_mps", robot.max_speed_mps, robot.cruise_mps, 20);
  for (const WheelSpec& wheel : robot.wheels) {
    in("radius_m", wheel.radius_m, 0.001, 2);
    in("max_speed_radps", wheel.max_speed_radps, 0, 1e4);
    in("max_torque_nm", wheel.max_torque_nm, 0, 1e5);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array<ModelPtr, 2> models = [] {
    unsetenv("FLOORPROOF_MODELS");
    std::array<ModelPtr, 2> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const RobotModel robot =
          ReadRobot(FindRobotFile(i == 0 ? "beluga" : "htetro", {}), {}, Blocks::kHinged);
      out[i] = CompileSpec(robot.mjcf.get(), robot.assets.get());
    }
    return out;
  }();
  Bytes bytes(data, size);
  const ModelPtr model = CopyModel(models[bytes.Next() % models.size()].get());
  while (!bytes.empty()) Change(model.get(), bytes);
  ReadOrRefuse([&] {
    try {
      Check(ReadSpec(model.get(), "robot.xml"));
    } catch (const InternalError&) {  // the engine's own word: the child's answer, else
    }
  });
  return 0;
}
