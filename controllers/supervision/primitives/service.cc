// SPDX-License-Identifier: Apache-2.0
// What goes on while others drive and is watched by monitors alone: that wheels turn as they
// should, that a sense senses, that the battery lasts.
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {
namespace {

class Service final : public RobotPrimitive {
 public:
  bool moves() const override { return false; }
  void VisitOwn(ParamVisitor&) override {}
  void Start(double) override {}
  NodeStatus Update(double) override { return NodeStatus::kRunning; }
};

}  // namespace

FP_DEFINE_PLUGIN(RobotPrimitive, Service)

}  // namespace floorproof
