// SPDX-License-Identifier: Apache-2.0
// Particle swarm over random keys: a particle's position is a number for each place but the start,
// its key. The order that it stands for is that of ascending keys, ties by place number.
//
// The sampling paper's section 5.1, which names the parameters but neither the decoding nor the
// bounds. The motion is that of Poli, Kennedy & Blackwell, "Particle swarm optimization. An
// overview", Swarm Intelligence 1, 2007: of each key, v = w v + c1 r1 (own best - x) + c2 r2 (best
// of all - x), x = x + v, with r1, r2 uniform in [0, 1] and w smaller by `damping` each iteration.
// Keys that stand for an order: Bean, "Genetic Algorithms and Random Keys for Sequencing and
// Optimization", ORSA Journal on Computing 6, 1994.
// Chosen here: keys lie in [0, 1], speeds in [-0.1, 0.1] an iteration. A particle that would leave
// the box stays at its side and turns back. The bests are those of the whole iteration before.
// Weak by nature: keys say nothing of nearness, and with w = 0.9 x 0.95^k the swarm stands still
// after some hundred iterations. The paper's own figures show it, too.
#include <algorithm>
#include <tuple>

#include "base/streams.h"
#include "planners/orders/visit_order.h"

namespace floorproof {
namespace {

constexpr double kMaxSpeed = 0.1;  // keys an iteration

struct Particle {
  std::vector<double> key, speed, best_key;  // by place, less one
  double best_m = 0;
};

class ParticleSwarm final : public VisitOrder {
 public:
  void Visit(ParamVisitor& v) override {
    v("particles", particles_, Between(1, 1e4), "how many there are");
    v("inertia", inertia_, NonNegative(), "share of its speed that a particle keeps at first");
    v("damping", damping_, Between(0, 1), "factor on the inertia after each iteration");
    v("learning_local", learning_local_, NonNegative(), "pull of a particle's own best position");
    v("learning_global", learning_global_, NonNegative(), "pull of the best position of all");
    v("iterations", iterations_, Between(1, 1e6), "how often all particles move");
  }

  VisitSequence Order(const OrderRequest& request) const override {
    Stream random(request.seed, 0, "pso");
    const std::size_t keys = Z(std::max(0, request.distances.size() - 1));
    std::vector<Particle> swarm(Z(particles_));
    std::vector<int> order;
    for (Particle& particle : swarm) {
      for (std::size_t k = 0; k < keys; ++k) {
        particle.key.push_back(random.Uniform());
        particle.speed.push_back(random.Uniform(-kMaxSpeed, kMaxSpeed));
      }
      particle.best_key = particle.key;
      particle.best_m = Length(request, particle.key, order);
    }
    Particle best = Best(swarm);
    VisitSequence found;
    double inertia = inertia_;
    for (int i = 0; i < iterations_; ++i, inertia *= damping_) {
      for (Particle& particle : swarm) {
        Move(best.best_key, inertia, random, particle);
        const double length_m = Length(request, particle.key, order);
        if (length_m >= particle.best_m) continue;
        particle.best_m = length_m;
        particle.best_key = particle.key;
      }
      best = Best(swarm);
      found.convergence.push_back(best.best_m);
    }
    found.length_m = Length(request, best.best_key, order);
    found.order = order;
    return found;
  }

 private:
  static const Particle& Best(const std::vector<Particle>& swarm) {
    return *std::ranges::min_element(swarm, {}, &Particle::best_m);
  }

  void Move(const std::vector<double>& best_key, double inertia, Stream& random,
            Particle& particle) const {
    for (std::size_t k = 0; k < best_key.size(); ++k) {
      double& x = particle.key[k];
      double& v = particle.speed[k];
      const double local = learning_local_ * random.Uniform() * (particle.best_key[k] - x);
      const double global = learning_global_ * random.Uniform() * (best_key[k] - x);
      v = std::clamp(inertia * v + local + global, -kMaxSpeed, kMaxSpeed);
      x += v;
      if (x >= 0 && x <= 1) continue;
      x = std::clamp(x, 0.0, 1.0);
      v = -v;
    }
  }

  // Of the order that `key` stands for, which is left in `order`.
  static double Length(const OrderRequest& request, const std::vector<double>& key,
                       std::vector<int>& order) {
    order = AsNumbered(request.distances.size());
    if (!order.empty())
      std::sort(order.begin() + 1, order.end(), [&](int a, int b) {
        return std::tuple(key[Z(a - 1)], a) < std::tuple(key[Z(b - 1)], b);
      });
    return TourLength(request.distances, order, request.closed);
  }

  int particles_ = 100, iterations_ = 1000;
  double inertia_ = 0.9, damping_ = 0.95;
  double learning_local_ = 0.85, learning_global_ = 0.85;
};

}  // namespace

FP_DEFINE_PLUGIN(VisitOrder, ParticleSwarm)

}  // namespace floorproof
