// SPDX-License-Identifier: Apache-2.0
// Zig-zag along y: the place of the least y comes first, then that of the second least, and so on.
//
// The sampling paper's baseline (section 6.2). It does not say what happens among places of the
// same y, nor how equal two y must be. Taken to the letter (`literal`) a robot would run back and
// forth along a row whose places differ by millimetres. So by default they form a row, and rows are
// gone through to and fro, as cleaning robots do (planners/orders/rows.h). x and y are the world's.
// Not done: looking at the distances, but for the end of the first row to begin at; and choosing
// the direction of the rows.
#include "planners/orders/rows.h"

namespace floorproof {
namespace {

class Zigzag final : public VisitOrder {
 public:
  void Visit(ParamVisitor& v) override {
    v("row_m", row_m_, NonNegative(),
      "places form a row whose y is at most so far above its least (m)");
    v("literal", literal_,
      "no rows: by y alone, of equals the lesser x first, as the paper has it");
  }

  VisitSequence Order(const OrderRequest& request) const override {
    VisitSequence found;
    found.order = literal_ ? OrderByY(request) : OrderByRows(request, row_m_);
    found.length_m = TourLength(request.distances, found.order, request.closed);
    return found;
  }

 private:
  double row_m_ = 0.05;
  bool literal_ = false;
};

}  // namespace

FP_DEFINE_PLUGIN(VisitOrder, Zigzag)

}  // namespace floorproof
