// SPDX-License-Identifier: Apache-2.0
// Planners of unknown floors, written in Python: start(task), and next(known) -> (target or None,
// why, whether all is done).
#include <cmath>

#include "planners/online/online_planner.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/modules.h"
#include "python/bindings/plugin.h"

namespace floorproof {
namespace {

// What Next() may look at; of this call alone.
struct Known {
  Lent<const OnlineInput> lent;
};

class PythonOnlinePlanner final : public OnlinePlanner {
 public:
  PythonOnlinePlanner(const std::string& name, nb::object plugin)
      : params_("planner " + name, std::move(plugin)) {}

  void Visit(ParamVisitor& v) override {
    shared_.Visit(v);
    params_.Visit(v);
  }
  const OnlineParams& params() const override { return shared_; }
  bool uses_seed() const override { return Says("uses_seed"); }
  bool covers_all() const override { return Says("covers_all"); }

  void Start(const OnlineTask& task) override {
    InPython(params_.who(), [&] {
      nb::dict about;
      about["frame"] = FrameDict(task.ground);
      about["start"] = PoseTuple(task.start);
      about["clear_half_m"] = nb::make_tuple(task.clear.half_m.x(), task.clear.half_m.y());
      about["tool_half_m"] = nb::make_tuple(task.tool.half_m.x(), task.tool.half_m.y());
      about["body_half_m"] = nb::make_tuple(task.body.half_m.x(), task.body.half_m.y());
      about["tool_width_m"] = task.tool_width_m;
      about["radius_m"] = shared_.radius_m;
      about["step_m"] =
          shared_.step_m ? nb::object(nb::float_(*shared_.step_m)) : nb::object(nb::none());
      about["seed"] = task.seed;
      Ask(params_.attr("start"), about);
      return 0;
    });
    ground_ = task.ground;
  }

  OnlineStep Next(const OnlineInput& input) override {
    return InPython(params_.who(), [&] {
      const auto answer = nb::cast<nb::tuple>(Lend<Known>(
          input, [&](const nb::object& known) { return Ask(params_.attr("next"), known); }));
      OnlineStep step;
      if (const nb::object place = answer[0]; !place.is_none()) {
        const auto target = nb::cast<nb::tuple>(place);
        step.target_W = {nb::cast<double>(target[0]), nb::cast<double>(target[1])};
        for (int axis = 0; axis < 2; ++axis)
          if (!std::isfinite(step.target_W[axis]))
            throw InputError({params_.who(), 0}, axis == 0 ? "target.x_m" : "target.y_m",
                             FormatDouble(step.target_W[axis]), "must be finite");
        if (!ground_.Inside(ground_.ToCell(step.target_W)))
          throw InputError({params_.who(), 0}, "target",
                           FormatDouble(step.target_W.x()) + ", " + FormatDouble(step.target_W.y()),
                           "lies off the map");
        return step;
      }
      why_ = nb::cast<std::string>(answer[1]);
      step.kind = nb::cast<bool>(answer[2]) ? OnlineStep::Kind::kDone : OnlineStep::Kind::kNowhere;
      step.why = why_;
      return step;
    });
  }

 private:
  bool Says(const char* what) const {
    return InPython(params_.who(), [&] {
      return nb::cast<bool>(nb::cast<nb::dict>(Ask(params_.attr("promises")))[what]);
    });
  }

  OnlineParams shared_;
  PythonParams params_;
  GridFrame ground_;
  std::string why_;
};

}  // namespace

void BindOnlinePlugins(nb::module_& m) {
  m.def("register_online_planner", [](const std::string& name, nb::object make) {
    Register<OnlinePlanner, PythonOnlinePlanner>(OnlinePlanners(), name, std::move(make));
  });
  m.def("online_planners", [] { return Listed(OnlinePlanners()); });
  nb::class_<Known>(m, "Known")
      .def_prop_ro("pose", [](const Known& k) { return PoseTuple(k.lent->estimate.X_WB); })
      .def_prop_ro(
          "cells", [](const Known& k) { return KnownArray(k.lent->known); },
          nb::rv_policy::automatic)
      .def_prop_ro("frame", [](const Known& k) { return FrameDict(k.lent->known.frame); })
      .def_prop_ro("bumped", [](const Known& k) { return k.lent->bumped; })
      .def_prop_ro("dropped", [](const Known& k) { return k.lent->dropped; })
      .def_prop_ro("missed", [](const Known& k) { return k.lent->missed; })
      .def_prop_ro("stopped", [](const Known& k) { return k.lent->stopped; });
}

}  // namespace floorproof
