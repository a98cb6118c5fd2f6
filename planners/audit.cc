// SPDX-License-Identifier: Apache-2.0
// Audit: a tour of the places where samples of the floor are taken, after "audit-sampling"
// (Pathmakumar et al. 2022, "A Novel Path Planning Strategy for a Cleaning Audit Robot Using
// Geometrical Features and Swarm Algorithms").
//
// (1) Places are found near walls and corners (section 4; planners/audit/find_samples.h), or given.
// (2) Distances between those that the robot can reach are measured along ways that it can drive
// (planners/audit/audit_floor.h). (3) An order of visit is chosen (section 5; planners/orders), by
// length alone: energy is proportional to it (Eqs. 2 and 3, E = M D). (4) The ways are joined; at
// each place the robot turns its sensor there and stands for as long as a sample takes.
// Assumed: a known floor. Not done: weighing how much dirt a place promises; every place is
// visited.
#include <algorithm>
#include <cmath>

#include "planners/audit/audit_floor.h"
#include "planners/audit/find_samples.h"
#include "planners/lines/why_nothing.h"

namespace floorproof {
namespace {

constexpr std::size_t kLeastStops = 2;     // of a tour, beside the start
constexpr std::size_t kMostPlaces = 5000;  // memory and time grow as their square: minutes, 1 GB

class AuditPlanner final : public Planner {
 public:
  AuditPlanner() {
    for (const auto& entry : VisitOrders()) orders_.emplace_back(entry.name, entry.make());
  }

  void Visit(ParamVisitor& visit) override {
    visit("order", order_, PluginNames(VisitOrders()), "in which the places are visited");
    visit("closed", closed_, "the way back to the start is part of the tour");
    visit("margin_m", margin_m_, NonNegative(),
          "kept beyond the clear shape for the tracker's error, except around places that lie "
          "closer to an obstacle, and in the middle of narrower passages");
    visit("speed_mps", speed_mps_, Between(0.001, 10),
          "between places; none: the pace of the robot's audits, else its cruise speed");
    visit("dwell_s", dwell_s_, Between(0.1, 600),
          "that a sample takes; none: as the robot's model states, else 1");
    visit.Group(
        "samples", [this](ParamVisitor& v) { samples_.Visit(v); },
        "where to sample; or file: points.csv, places of your own");
    for (const auto& [name, order] : orders_)
      visit.Group(
          std::string(name).c_str(), [&o = order](ParamVisitor& v) { o->Visit(v); },
          "of that order");
  }

  PlannerPromises promises() const override { return {.uses_seed = true, .visits_places = true}; }

  PlanResult Plan(const PlanRequest& request) const override {
    PlanResult result;
    const RobotSpec& robot = request.robot;
    result.clear = robot.clear;
    result.tool = robot.tool;
    result.tool_width_m = robot.tool_width_m;
    if (result.clear.kind == Shape2::Kind::kFootprint && !IsConvex(result.clear.footprint_B)) {
      result.message = kNotConvex;
      return result;
    }
    // What the clear shape itself passes over: the room that the robot audits.
    const HeldShapes held = HoldYaw(request.map, request.start, result.clear, result.clear);
    const FloorRoom room(request.map, robot.step_m);
    const SweepArea area = room.Sweepable(held.clear, held.tool, request.start.p(), held.yaws);
    if (!StartFits(area)) {
      result.status = PlanStatus::kStartBlocked;
      result.message = WhyNothing(request, area, result.clear);
      return result;
    }
    if (!FindPlaces(request, area, result)) return result;

    if (result.samples.size() > kMostPlaces) {
      result.message =
          std::to_string(result.samples.size()) + " places to sample are more than the " +
          std::to_string(kMostPlaces) + " that a tour takes" +
          (request.places.empty() ? ": larger intervals (samples.du_m) give fewer" : "");
      result.samples.clear();
      return result;
    }
    std::vector<Vec2> places;  // p_W
    for (const SamplePlace& place : result.samples) places.push_back(place.p_W);
    const AuditFloor floor(request, room, area, held, places, margin_m_);
    if (floor.stops().size() < 1 + kLeastStops) {
      result.status = PlanStatus::kTooFewSamples;
      result.message = TooFew(result.samples.size(), floor.stops().size() - 1);
      MarkReachable(floor, {}, result);
      return result;
    }
    MakeTour(request, floor, held.yaw_rad, result);
    return result;
  }

 private:
  // Fills in the places; false: there are none, and the message says why.
  bool FindPlaces(const PlanRequest& request, const SweepArea& area, PlanResult& result) const {
    if (!request.places.empty()) {
      for (const Vec2& p_W : request.places)
        result.samples.push_back({.p_W = p_W, .kinds = {.given = true}});
      return true;
    }
    const RobotSpec& robot = request.robot;
    const Room room = MakeRoom(request.map, area, robot.circumscribed_radius_m);
    FoundSamples found = FindSamples(room, SensorReach(area, robot), 2 * robot.inscribed_radius_m,
                                     samples_, request.seed);
    result.message = found.why;
    if (!found.why.empty()) return false;
    result.samples = std::move(found.places);
    result.boundary = std::move(found.boundary_W);
    result.sampled_parts = found.parts;
    result.figures.push_back({"general_samples", found.general});
    result.figures.push_back({"boundary_samples", found.boundary});
    result.figures.push_back({"corner_samples", found.corner});
    result.figures.push_back({"random_samples", found.random});
    result.figures.push_back({"near_walls_share", found.parts.near_walls});
    result.figures.push_back({"elsewhere_share", found.parts.elsewhere});
    return true;
  }

  static std::string TooFew(std::size_t places, std::size_t reached) {
    if (places == 0)
      return "no place to sample lies on the floor: smaller intervals (samples.du_m) give more";
    return std::to_string(reached) + " of " + std::to_string(places) +
           (places == 1 ? " place" : " places") + " to sample can be reached: a tour needs two";
  }

  // `order`: of the stops; visits are numbered by it.
  static void MarkReachable(const AuditFloor& floor, const std::vector<int>& order,
                            PlanResult& result) {
    std::vector<int> visit(floor.stops().size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) visit[Z(order[k])] = static_cast<int>(k);
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
      const int stop = floor.stop_of()[i];
      result.samples[i].reachable = stop > 0;
      result.samples[i].visit = stop > 0 ? visit[Z(stop)] : 0;
      left_out += stop == 0;
    }
    if (left_out > 0 && result.message.empty())
      result.message = "left out: " + std::to_string(left_out) + " of " +
                       std::to_string(result.samples.size()) +
                       " places to sample, which the robot cannot reach";
  }

  void MakeTour(const PlanRequest& request, const AuditFloor& floor, std::optional<double> yaw_rad,
                PlanResult& result) const {
    const RobotSpec& robot = request.robot;
    const auto& chosen = *std::ranges::find(orders_, order_, &Named::first)->second;
    std::vector<Vec2> stops;  // p_W
    for (const AuditFloor::Stop& stop : floor.stops()) stops.push_back(stop.p_W);
    const VisitSequence tour = chosen.Order({floor.distances(), stops, closed_, request.seed});
    MarkReachable(floor, tour.order, result);

    const double speed_mps = speed_mps_.value_or(robot.audit_speed_mps);  // 0: at cruise speed
    const auto add = [&](const Vec2& p_W) -> Waypoint& {
      Waypoint& w = result.path.emplace_back();
      w.p_W = p_W;
      w.yaw_rad = yaw_rad;
      w.speed_mps = speed_mps;
      return w;
    };
    std::vector<int> sample_at(floor.stops().size(), -1);
    for (std::size_t i = 0; i < result.samples.size(); ++i)
      if (floor.stop_of()[i] > 0) sample_at[Z(floor.stop_of()[i])] = static_cast<int>(i);
    std::vector<int> order = tour.order;
    if (closed_) order.push_back(order.front());
    add(stops[0]).speed_mps = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::vector<Vec2> way = floor.Way(order[k - 1], order[k]);
      for (std::size_t i = 1; i < way.size(); ++i) add(way[i]);
      if (sample_at[Z(order[k])] < 0) continue;  // back at the start
      Waypoint& stop = result.path.back();
      stop.dwell_s = dwell_s_.value_or(robot.audit_dwell_s > 0 ? robot.audit_dwell_s : 1.0);
      if (const auto& yaw_W = floor.stops()[Z(order[k])].yaw_rad) stop.yaw_rad = yaw_W;
      stop.task = {WaypointTask::Kind::kSample, sample_at[Z(order[k])]};
    }
    result.status = PlanStatus::kSuccess;
    result.convergence_m = tour.convergence;
    result.figures.push_back({"samples", static_cast<double>(result.samples.size())});
    result.figures.push_back({"reachable_samples", static_cast<double>(floor.stops().size() - 1)});
    result.figures.push_back({"margin_m", floor.margin_m()});
    result.figures.push_back({"tour_m", tour.length_m});
    if (tour.bound_m) {
      result.figures.push_back({"tour_bound_m", *tour.bound_m});
      result.figures.push_back(
          {"tour_gap", *tour.bound_m > 0 ? tour.length_m / *tour.bound_m - 1 : 0});
    }
  }

  using Named = std::pair<std::string_view, std::unique_ptr<VisitOrder>>;
  std::vector<Named> orders_;
  std::string order_ = "tour";
  bool closed_ = false;
  double margin_m_ = 0.03;  // BELUGA's, as for coverage (planners/lines/coverage_planner.cc)
  std::optional<double> speed_mps_, dwell_s_;
  SampleParams samples_;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, AuditPlanner)

}  // namespace floorproof
