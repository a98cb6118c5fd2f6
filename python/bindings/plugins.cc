// SPDX-License-Identifier: Apache-2.0
// Planners and trackers written in Python. Each is a Python object with
//   params()                -> [(name, value, help), ..]; value: float, int, bool or
//   str set(name, value)        takes a checked one promises()              -> dict (planners)
// and the calls below. python/floorproof/plugins.py wraps what a user writes in such an object.

#include <cmath>
#include <deque>
#include <memory>
#include <variant>

#include "controllers/twist_tracker.h"
#include "planners/online/online_planner.h"
#include "planners/planner.h"
#include "planners/risk/risk_map.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"

namespace floorproof {
namespace {

using namespace nb::literals;

// A Python object whose last reference may be dropped by a thread without the GIL.
class Held {
 public:
  explicit Held(nb::object object) : object_(new nb::object(std::move(object))) {}
  ~Held() {
    if (!Py_IsInitialized()) return;  // the interpreter has ended: there is nothing to give back
    const nb::gil_scoped_acquire held;
    delete object_;
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  nb::object& operator*() const { return *object_; }

 private:
  nb::object* object_;
};

// The parameters of a Python plug-in, as its class states them.
class PythonParams {
 public:
  PythonParams(std::string who, nb::object plugin)
      : who_(std::move(who)), plugin_(std::move(plugin)) {
    for (const nb::handle one : (*plugin_).attr("params")()) {
      const auto row = nb::cast<nb::tuple>(one);
      Param& p = params_.emplace_back();
      p.name = nb::cast<std::string>(row[0]);
      p.value = ValueOf(row[1]);
      p.help = nb::cast<std::string>(row[2]);
    }
  }

  void Visit(ParamVisitor& v) {
    for (Param& p : params_) {
      const Value before = p.value;
      if (auto* flag = std::get_if<bool>(&p.value))
        v(p.name.c_str(), *flag, p.help.c_str());
      else if (auto* whole = std::get_if<int>(&p.value))
        v(p.name.c_str(), *whole, Any(), p.help.c_str());
      else if (auto* real = std::get_if<double>(&p.value))
        v(p.name.c_str(), *real, Any(), p.help.c_str());
      else
        v(p.name.c_str(), std::get<std::string>(p.value), {}, p.help.c_str());
      if (p.value != before) InPython(who_, [&] { (*plugin_).attr("set")(p.name, p.value); });
    }
  }

  const std::string& who() const { return who_; }
  nb::object attr(const char* name) const { return (*plugin_).attr(name); }

 private:
  using Value = std::variant<bool, int, double, std::string>;
  static Value ValueOf(const nb::object& value) {
    if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
    if (nb::isinstance<nb::int_>(value)) return nb::cast<int>(value);
    if (nb::isinstance<nb::float_>(value)) return nb::cast<double>(value);
    return nb::cast<std::string>(value);
  }
  struct Param {
    std::string name, help;
    Value value;
  };
  std::string who_;
  Held plugin_;
  std::deque<Param> params_;
};

// --- planners ---

nb::dict RequestDict(const PlanRequest& request) {
  const RobotSpec& robot = request.robot;
  nb::dict out;
  out["frame"] = FrameDict(request.map.frame);
  Grid<std::uint8_t> walls(request.map.frame.width, request.map.frame.height);
  for (int iy = 0; iy < walls.height; ++iy)
    for (int ix = 0; ix < walls.width; ++ix) walls(ix, iy) = request.map.IsWall(ix, iy);
  out["walls"] = MaskArray(walls);
  const GridFrame fine = FineFrame(request.map.frame);
  out["obstacle_frame"] = FrameDict(fine);
  out["obstacles"] = MaskArray(ObstacleMask(request.map, robot.step_m, fine));
  if (request.risk != nullptr) {
    out["risk"] = GridArray<double>(request.risk->rf);
    out["risk_frame"] = FrameDict(request.risk->grid.frame);
  }
  out["hazards"] = HazardList(request.map);
  out["robot"] = RobotDict(robot);
  out["start"] = PoseTuple(request.start);
  out["goal"] = request.goal ? nb::object(nb::make_tuple(request.goal->x(), request.goal->y()))
                             : nb::object(nb::none());
  out["seed"] = request.seed;
  return out;
}

class PythonPlanner final : public Planner {
 public:
  PythonPlanner(const std::string& name, nb::object plugin)
      : params_("planner " + name, std::move(plugin)) {}

  void Visit(ParamVisitor& v) override { params_.Visit(v); }

  PlannerPromises promises() const override {
    return InPython(params_.who(), [&] {
      const auto said = nb::cast<nb::dict>(params_.attr("promises")());
      PlannerPromises promises;
      promises.needs_risk = nb::cast<bool>(said["needs_risk"]);
      promises.needs_goal = nb::cast<bool>(said["needs_goal"]);
      promises.uses_seed = nb::cast<bool>(said["uses_seed"]);
      return promises;
    });
  }

  PlanResult Plan(const PlanRequest& request) const override {
    return InPython(params_.who(), [&] {
      PlanResult result;
      result.clear = request.robot.clear;
      result.tool = request.robot.tool;
      result.tool_width_m = request.robot.tool_width_m;
      const auto answer = nb::cast<nb::tuple>(params_.attr("plan")(RequestDict(request)));
      result.message = nb::cast<std::string>(answer[1]);
      const nb::object rows = answer[0];
      if (rows.is_none()) return result;  // failed, and says why
      result.path = PathFrom(nb::cast<Rows>(rows), request.map.frame, params_.who());
      // It begins where the robot stands; what leads elsewhere first is driven to.
      if ((result.path.front().p_W - request.start.p()).norm() > 1e-6) {
        Waypoint start;
        start.p_W = request.start.p();
        result.path.insert(result.path.begin(), start);
      }
      result.status = PlanStatus::kSuccess;
      return result;
    });
  }

 private:
  PythonParams params_;
};

// --- planners of unknown floors ---

// What Next() may look at; of this call alone.
struct Known {
  Lent<const OnlineInput> lent;
};

nb::ndarray<nb::numpy, std::uint8_t> KnownCells(const Known& k) {
  const KnownMap& known = k.lent->known;
  Grid<std::uint8_t> states(known.frame.width, known.frame.height);
  for (int iy = 0; iy < states.height; ++iy)
    for (int ix = 0; ix < states.width; ++ix)
      states(ix, iy) = static_cast<std::uint8_t>(known.At(ix, iy));
  return GridArray<std::uint8_t>(states);
}

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
      params_.attr("start")(about);
      return 0;
    });
    ground_ = task.ground;
  }

  OnlineStep Next(const OnlineInput& input) override {
    return InPython(params_.who(), [&] {
      const auto answer = nb::cast<nb::tuple>(
          Lend<Known>(input, [&](const nb::object& known) { return params_.attr("next")(known); }));
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
      return nb::cast<bool>(nb::cast<nb::dict>(params_.attr("promises")())[what]);
    });
  }

  OnlineParams shared_;
  PythonParams params_;
  GridFrame ground_;
  std::string why_;
};

// --- trackers ---

class PythonTracker final : public TwistTracker {
 public:
  PythonTracker(const std::string& name, nb::object plugin)
      : params_("controller " + name, std::move(plugin)) {}

  void Visit(ParamVisitor& v) override { params_.Visit(v); }

 protected:
  void OnPath(const Path& path, const RobotSpec& robot) override {
    InPython(params_.who(), [&] {
      params_.attr("start")(PathArray(path), RobotDict(robot));
      return 0;
    });
  }

  BodyTwist Twist(const Situation& now) override {
    return InPython(params_.who(), [&] {
      const Pose2& X_WB = now.estimate.X_WB;
      const BodyTwist& V = now.estimate.V_WB_B;
      const auto answer = nb::cast<nb::tuple>(params_.attr("update")(
          now.t_s, PoseTuple(X_WB), nb::make_tuple(V.vx_mps, V.vy_mps, V.wz_radps), now.segment,
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

// `make`: makes the Python object.
template <class Interface, class Plugin>
void Register(std::span<const PluginEntry<Interface>> table, const std::string& name,
              nb::object make) {
  AddGuestPlugin<Interface>(
      table, {name, [name, held = std::make_shared<Held>(std::move(make))] {
                return InPython(name, [&] {
                  return std::unique_ptr<Interface>(std::make_unique<Plugin>(name, (**held)()));
                });
              }});
}

template <class Interface>
std::vector<std::tuple<std::string, std::string>> Listed(
    std::span<const PluginEntry<Interface>> table) {
  std::vector<std::tuple<std::string, std::string>> out;
  for (const auto& entry : table) out.emplace_back(entry.name, entry.help);
  return out;
}

}  // namespace

void BindPlugins(nb::module_& m) {
  m.def("register_planner", [](const std::string& name, nb::object make) {
    Register<Planner, PythonPlanner>(Planners(), name, std::move(make));
  });
  m.def("register_online_planner", [](const std::string& name, nb::object make) {
    Register<OnlinePlanner, PythonOnlinePlanner>(OnlinePlanners(), name, std::move(make));
  });
  m.def("register_tracker", [](const std::string& name, nb::object make) {
    Register<Tracker, PythonTracker>(Trackers(), name, std::move(make));
  });
  m.def("planners", [] { return Listed(Planners()); });
  m.def("online_planners", [] { return Listed(OnlinePlanners()); });
  m.def("trackers", [] { return Listed(Trackers()); });
  nb::class_<Known>(m, "Known")
      .def_prop_ro("pose", [](const Known& k) { return PoseTuple(k.lent->estimate.X_WB); })
      .def_prop_ro("cells", &KnownCells, nb::rv_policy::automatic)
      .def_prop_ro("frame", [](const Known& k) { return FrameDict(k.lent->known.frame); })
      .def_prop_ro("bumped", [](const Known& k) { return k.lent->bumped; })
      .def_prop_ro("dropped", [](const Known& k) { return k.lent->dropped; })
      .def_prop_ro("missed", [](const Known& k) { return k.lent->missed; })
      .def_prop_ro("stopped", [](const Known& k) { return k.lent->stopped; });
}

}  // namespace floorproof
