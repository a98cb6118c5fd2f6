// SPDX-License-Identifier: Apache-2.0
// Particles do not meet one another, so each one's story is told by itself, from the first contact
// to the last. The motion is cut into pieces in which the tool moves straight without turning (a
// turn into many short ones). Bins list the pieces that reach into them, in the motion's order. A
// particle asks those of its bin: seen along a piece's way, the tool is at the particle between two
// lengths that are known in closed form. A push sends it to the list of another bin.
//
// Not modelled: particles that stick to the brush, fall off it, or are pushed ahead of it.
#include "env/audit/brush.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "env/geometry/box.h"
#include "env/geometry/rasterise.h"

namespace floorproof {
namespace {

constexpr double kTurn_m = 0.002;  // the rim's way in one piece of a turn

double ReachOf(const Shape2& tool) {
  double reach_m = tool.radius_m;
  if (tool.kind == Shape2::Kind::kFootprint) {
    reach_m = 0;
    for (const Vec2& p : tool.footprint_B) reach_m = std::max(reach_m, p.norm());
  }
  return reach_m;
}

// The way since the last contact beyond which the next one is a new pass (CoverageMeter's rule).
double PassGap(const Shape2& tool) {
  if (tool.kind == Shape2::Kind::kCircle) return 4 * tool.radius_m;
  return 2 * BoxAround(tool.footprint_B).Size().maxCoeff();
}

// A straight motion without a turn, in frame A: origin at the tool's start, x along the way.
struct Piece {
  Vec2 from_G = Vec2::Zero(), way = Vec2(1, 0);
  double length_m = 0, s_m = 0;  // and the way until its start
  std::size_t first = 0;         // of the footprint's corners in A
  Box2 tool_A;                   // around the tool at the start
};

// The way along the whole motion at which the tool meets a place, and leaves it.
struct Contact {
  double enter_m = 0, leave_m = 0;
};

class Motion {
 public:
  Motion(const DirtField& field, const Shape2& tool, std::span<const Pose2> poses_W)
      : tool_(tool), reach_m_(ReachOf(tool)), listed_(field.frame().width, field.frame().height) {
    const Pose2 X_GW = field.frame().X_WG.Inverse();
    Pose2 from;
    for (std::size_t i = 0; i < poses_W.size(); ++i) {
      const Pose2 to = X_GW * poses_W[i];
      if (i == 0) Add(to.p(), to.p(), to.yaw_rad, field.frame());
      if (i > 0) AddTurning(from, to, field.frame());
      from = to;
    }
  }

  double reach_m() const { return reach_m_; }
  const Piece& piece(int i) const { return pieces_[static_cast<std::size_t>(i)]; }
  // Those that may touch a particle in the bin, ascending.
  const std::vector<int>& In(Cell bin) const { return listed_(bin); }

  std::optional<Contact> Touch(const Piece& piece, const Vec2& p_G) {
    const Vec2 d = p_G - piece.from_G;
    const double along = piece.way.dot(d), across = Cross(piece.way, d);
    const Box2& box = piece.tool_A;
    if (across < box.low.y() || across > box.high.y() || along < box.low.x() ||
        along > piece.length_m + box.high.x())
      return std::nullopt;
    std::optional<Contact> contact;
    // The tool's part from `back` to `front` on the particle's line.
    const auto pass = [&](double back, double front) {
      const double enter = std::max(0.0, along - front);
      const double leave = std::min(piece.length_m, along - back);
      if (enter > leave) return;
      if (!contact) contact = Contact{piece.s_m + enter, piece.s_m + leave};
      contact->enter_m = std::min(contact->enter_m, piece.s_m + enter);
      contact->leave_m = std::max(contact->leave_m, piece.s_m + leave);
    };
    if (tool_.kind == Shape2::Kind::kCircle) {
      const double half = std::sqrt(std::max(0.0, reach_m_ * reach_m_ - across * across));
      pass(-half, half);
      return contact;
    }
    crossings_.clear();
    const std::size_t n = tool_.footprint_B.size();
    for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
      const Vec2 &a = corners_A_[piece.first + j], &b = corners_A_[piece.first + i];
      if ((a.y() <= across) != (b.y() <= across))
        crossings_.push_back(a.x() + (b.x() - a.x()) * (across - a.y()) / (b.y() - a.y()));
    }
    std::ranges::sort(crossings_);
    for (std::size_t k = 0; k + 1 < crossings_.size(); k += 2)
      pass(crossings_[k], crossings_[k + 1]);
    return contact;
  }

 private:
  void AddTurning(const Pose2& from, const Pose2& to, const GridFrame& frame) {
    const bool round = tool_.kind == Shape2::Kind::kCircle;
    const double turn_rad = round ? 0.0 : WrapAngle(to.yaw_rad - from.yaw_rad);
    const int n = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) * reach_m_ / kTurn_m)));
    const Vec2 way = to.p() - from.p();
    for (int i = 0; i < n; ++i) {
      const double begin = static_cast<double>(i) / n, end = (i + 1.0) / n;
      Add(from.p() + begin * way, from.p() + end * way, from.yaw_rad + turn_rad * (begin + end) / 2,
          frame);
    }
  }

  void Add(const Vec2& from_G, const Vec2& to_G, double yaw_rad, const GridFrame& frame) {
    Piece piece;
    piece.from_G = from_G;
    piece.s_m = s_m_;
    piece.length_m = (to_G - from_G).norm();
    if (piece.length_m > 0) piece.way = (to_G - from_G) / piece.length_m;
    s_m_ += piece.length_m;
    if (tool_.kind == Shape2::Kind::kCircle) {
      piece.tool_A = {Vec2(-reach_m_, -reach_m_), Vec2(reach_m_, reach_m_)};
    } else {
      piece.first = corners_A_.size();
      const Pose2 turned{0, 0, yaw_rad};
      for (const Vec2& p_B : tool_.footprint_B) {
        const Vec2 p = turned.Rotate(p_B);
        corners_A_.push_back({piece.way.dot(p), Cross(piece.way, p)});
      }
      piece.tool_A = BoxAround(
          {corners_A_.begin() + static_cast<std::ptrdiff_t>(piece.first), corners_A_.end()});
    }
    List(piece, frame);
    pieces_.push_back(piece);
  }

  // In the bins that the tool's box reaches into on its way.
  void List(const Piece& piece, const GridFrame& frame) {
    const int number = static_cast<int>(pieces_.size());
    constexpr double kMore_m = 1e-4;  // what only touches a bin's border counts
    Polygon swept = Rectangle(piece.tool_A.low - Vec2(kMore_m, kMore_m),
                              piece.tool_A.high + Vec2(piece.length_m + kMore_m, kMore_m));
    for (Vec2& p : swept)
      p = (piece.from_G + p.x() * piece.way + p.y() * Vec2(-piece.way.y(), piece.way.x())) /
          frame.cell_m;
    Rasterise(swept, frame.width, frame.height, [&](int ix, int iy) {
      std::vector<int>& list = listed_(ix, iy);
      if (list.empty() || list.back() != number) list.push_back(number);
    });
  }

  const Shape2& tool_;
  double reach_m_, s_m_ = 0;
  std::vector<Piece> pieces_;
  std::vector<Vec2> corners_A_;
  Grid<std::vector<int>> listed_;
  std::vector<double> crossings_;  // of a particle's line with the footprint's edges
};

// One call's state.
class Cleaning {
 public:
  Cleaning(DirtField& field, const Shape2& tool, std::span<const Pose2> poses,
           const CleaningParams& params, Stream& random)
      : field_(field),
        params_(params),
        random_(random),
        motion_(field, tool, poses),
        gap_m_(PassGap(tool)) {}

  CleaningOutcome Run() {
    // Laid down again at the end, so that no bin hands a particle to one that is yet to come.
    std::vector<std::pair<Vec2, double>> pushed;
    const GridFrame& frame = field_.frame();
    for (int iy = 0; iy < frame.height; ++iy)
      for (int ix = 0; ix < frame.width; ++ix) {
        if (motion_.In({ix, iy}).empty()) continue;
        field_.TakeIf(ix, iy, [&](const Vec2& p_G, double diameter_m) {
          const std::optional<Vec2> rests = Story(p_G);
          const bool moved = rests && *rests != p_G;
          if (moved) pushed.emplace_back(*rests, diameter_m);
          return !rests || moved;
        });
      }
    for (const auto& [p_G, diameter_m] : pushed) field_.LayInGrid(p_G, diameter_m);
    return outcome_;
  }

 private:
  // Where a particle lies in the end; none: it was taken up.
  std::optional<Vec2> Story(Vec2 p_G) {
    bool met = false;
    double last_m = 0;  // where the tool last touched it
    int next = 0;       // the first piece that may touch it from now on
    for (;;) {
      const std::vector<int>& list = motion_.In(BinOf(p_G));
      auto at = std::lower_bound(list.begin(), list.end(), next);
      for (; at != list.end(); ++at) {
        const Piece& piece = motion_.piece(*at);
        const auto contact = motion_.Touch(piece, p_G);
        if (!contact) continue;
        const bool same_pass = met && contact->enter_m - last_m <= gap_m_;
        last_m = met ? std::max(last_m, contact->leave_m) : contact->leave_m;
        met = true;
        if (same_pass) continue;
        ++outcome_.passed_over;
        if (random_.Uniform() < params_.pick_up) {
          ++outcome_.taken_up;
          return std::nullopt;
        }
        if (random_.Uniform() >= params_.push_aside) continue;
        ++outcome_.pushed_aside;
        p_G = Pushed(piece, p_G);
        break;
      }
      if (at == list.end()) return p_G;
      next = *at + 1;
    }
  }

  Cell BinOf(const Vec2& p_G) const {
    const Vec2 p = p_G / field_.frame().cell_m;
    return {static_cast<int>(p.x()), static_cast<int>(p.y())};
  }

  // Beside the lane, on the side on which it lay; from a tool that stands, straight away from it.
  Vec2 Pushed(const Piece& piece, const Vec2& p_G) {
    const Vec2 d = p_G - piece.from_G;
    Vec2 aside = piece.way;
    double far_m = 0;
    if (piece.length_m > 0) {
      const double across = Cross(piece.way, d);
      const Vec2 left(-piece.way.y(), piece.way.x());
      aside = across >= 0 ? left : Vec2(-left);
      far_m = across >= 0 ? piece.tool_A.high.y() - across : across - piece.tool_A.low.y();
    } else {
      if (d.norm() > 0) aside = d.normalized();
      far_m = motion_.reach_m() - d.norm();
    }
    far_m = std::max(0.0, far_m) + random_.Uniform(0, params_.push_m);
    // As far as there is floor.
    const double step_m = std::min(0.005, field_.frame().cell_m / 2);
    const int steps = static_cast<int>(std::ceil(far_m / step_m));
    Vec2 rests = p_G;
    for (int i = 1; i <= steps; ++i) {
      const Vec2 p = p_G + aside * std::min(far_m, i * step_m);
      if (!field_.IsFloorInGrid(p)) break;
      rests = p;
    }
    return rests;
  }

  DirtField& field_;
  const CleaningParams& params_;
  Stream& random_;
  Motion motion_;
  double gap_m_;
  CleaningOutcome outcome_;
};

}  // namespace

void CleaningParams::Visit(ParamVisitor& v) {
  v("pick_up", pick_up, Between(0, 1), "share of the particles that one pass takes up");
  v("push_aside", push_aside, Between(0, 1), "share of the others that it puts beside its lane");
  v("push_m", push_m, Between(0, 1), "how far beside it, at most");
}

CleaningOutcome CleanAlong(DirtField& field, const Shape2& tool, std::span<const Pose2> poses,
                           const CleaningParams& params, Stream& random) {
  for (const Pose2& X_WB : poses)
    if (!std::isfinite(X_WB.x_m + X_WB.y_m + X_WB.yaw_rad))
      throw InputError("cleaning: a pose is not finite");
  return Cleaning(field, tool, poses, params, random).Run();
}

}  // namespace floorproof
