// SPDX-License-Identifier: Apache-2.0
// A mission as it runs: what each node of its tree has come to, and how safe it is.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "controllers/safety/mission.h"

namespace floorproof {

enum class NodeStatus { kWaiting, kRunning, kDone, kFailed };  // waiting: its turn has not come
std::string_view Name(NodeStatus status);

// A unique operation of the robot ("safety-monitoring", section 3.1), with the monitors that watch
// it.
class Primitive {
 public:
  virtual ~Primitive() = default;
  virtual void Start(double t_s) = 0;
  // One period; running, done or failed. Not once it is done or failed.
  virtual NodeStatus Update(double t_s) = 0;
  // What its monitors say now; none: it does what it should.
  virtual std::optional<Failure> failure() const = 0;
};

class MissionRun {
 public:
  using Make = std::function<std::unique_ptr<Primitive>(const MissionNode&)>;

  // `mission` outlives it. `make`: called for each primitive of the tree, in its order.
  MissionRun(const Mission& mission, const Make& make);

  // One period of all that runs now. Where something is done, what comes after it begins in the
  // same period. A node fails with its first child that fails. It is done when those of its
  // children are that run in order, and ends those beside them. Allocates nothing.
  NodeStatus Update(double t_s);

  NodeStatus status(std::size_t node) const { return status_[node]; }
  // Eq. 1, of the skills below a node, and their sum: a skill's is that of its worst primitive, in
  // parallel or in its turn. A node that waits or is done has no risk; a failed one keeps
  // its risk. The two differ where skills run beside each other.
  struct Risk {
    double greatest = 0, sum = 0;
    bool operator==(const Risk&) const = default;
  };
  const Risk& risk(std::size_t node) const { return risk_[node]; }
  // When it began; only of one that has.
  double begun_s(std::size_t node) const { return begun_s_[node]; }
  // What its monitors say of a primitive that runs, or has failed.
  std::optional<Failure> failure(std::size_t node) const;
  // All skills of the tree, in order, and R_i of each.
  std::span<const std::size_t> skills() const { return skills_; }
  std::span<const double> safety_states() const { return states_; }

 private:
  NodeStatus Run(std::size_t node, double t_s);
  NodeStatus RunChildren(std::size_t node, double t_s);
  void End(std::size_t node);
  void Assess();

  const Mission& mission_;
  std::vector<std::unique_ptr<Primitive>> primitives_;  // by node; of the others nullptr
  std::vector<NodeStatus> status_;
  std::vector<double> begun_s_;
  std::vector<Risk> risk_;
  std::vector<std::size_t> skills_;
  std::vector<double> states_;
};

}  // namespace floorproof
