// SPDX-License-Identifier: Apache-2.0
// Path trackers written in Python: start(path, robot), and update(...) -> a twist.
#include <cmath>

#include "controllers/twist_tracker.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/modules.h"
#include "python/bindings/plugin.h"

namespace floorproof {
namespace {

class PythonTracker final : public TwistTracker {
 public:
  PythonTracker(const std::string& name, nb::object plugin)
      : params_("controller " + name, std::move(plugin)) {}

  void Visit(ParamVisitor& v) override { params_.Visit(v); }

 protected:
  void OnPath(const Path& path, const RobotSpec& robot) override {
    InPython(params_.who(), [&] {
      Ask(params_.attr("start"), PathArray(path), RobotDict(robot));
      return 0;
    });
  }

  BodyTwist Twist(const Situation& now) override {
    return InPython(params_.who(), [&] {
      const Pose2& X_WB = now.estimate.X_WB;
      const BodyTwist& V = now.estimate.V_WB_B;
      const auto answer = nb::cast<nb::tuple>(
          Ask(params_.attr("update"), now.t_s, PoseTuple(X_WB),
              nb::make_tuple(V.vx_mps, V.vy_mps, V.wz_radps), now.segment,
              nb::make_tuple(now.target_W.x(), now.target_W.y()), now.speed_mps));
      const BodyTwist twist{nb::cast<double>(answer[0]), nb::cast<double>(answer[1]),
                            nb::cast<double>(answer[2])};
      constexpr const char* kParts[] = {"vx_mps", "vy_mps", "wz_radps"};
      const double values[] = {twist.vx_mps, twist.vy_mps, twist.wz_radps};
      for (int i = 0; i < 3; ++i)
        if (!std::isfinite(values[i]))
          throw InternalError(params_.who() + " returned " + kParts[i] + " = " +
                              FormatDouble(values[i]) + " at " + FormatDouble(now.t_s) +
                              " s: must be finite");
      return twist;
    });
  }

 private:
  PythonParams params_;
};

}  // namespace

void BindTrackerPlugins(nb::module_& m) {
  m.def("register_tracker", [](const std::string& name, nb::object make) {
    Register<Tracker, PythonTracker>(Trackers(), name, std::move(make));
  });
  m.def("trackers", [] { return Listed(Trackers()); });
}

}  // namespace floorproof
