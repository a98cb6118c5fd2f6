// SPDX-License-Identifier: Apache-2.0
// An old or cold battery: its voltage is a share of what it would be, under load and at rest.
#include "env/faults/fault.h"

namespace floorproof {
namespace {

class BatterySag final : public Fault {
 public:
  void Visit(ParamVisitor& v) override {
    v("voltage_share", voltage_share_, {0, 1, true}, "of the battery's voltage");
  }
  void Start(const FaultContext&) override {}
  void Break(Alterations& alterations) const override {
    alterations.battery_voltage *= voltage_share_;
  }

 private:
  double voltage_share_ = 0.8;
};

}  // namespace

FP_DEFINE_PLUGIN(Fault, BatterySag)

}  // namespace floorproof
