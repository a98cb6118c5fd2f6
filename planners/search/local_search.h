// SPDX-License-Identifier: Apache-2.0
// What local searches for tours share, whatever their moves are: candidate lists, the queue of
// those that are worth another look, and the loop that kicks a tour and keeps what is better.
//
// A local search changes a few edges of a tour at a time, as long as that saves something. It looks
// only at edges to near neighbours (candidate lists), and only around what changed last (don't-look
// bits); both after Bentley, "Fast Algorithms for Geometric Traveling Salesman Problems", 1992.
// Where no move helps any more, a kick changes the tour at random in one place, the search mends
// what that touched, and the outcome is kept or undone (Martin, Otto & Felten 1991).
// Users: planners/search/three_opt.h (single places) and planners/lines/tour.h (lines that are
// driven from end to end). Their moves differ: those that suit lines keep or turn whole lines.
#pragma once

#include <span>
#include <vector>

#include "planners/search/index.h"

namespace floorproof {

// Of each vertex 0, 1, ... the edges worth trying, the cheapest first.
template <class Edge>
class CandidateLists {
 public:
  // To the list of the vertex that is not closed yet.
  void Add(const Edge& edge) { edges_.push_back(edge); }
  std::span<Edge> Open() { return std::span(edges_).subspan(first_.back()); }
  void Close() { first_.push_back(edges_.size()); }

  std::span<const Edge> Of(int vertex) const {
    return std::span(edges_).subspan(first_[Z(vertex)], first_[Z(vertex) + 1] - first_[Z(vertex)]);
  }

 private:
  std::vector<Edge> edges_;
  std::vector<std::size_t> first_ = {0};  // by vertex, and the end
};

// The vertices whose don't-look bit is off: each once, first come, first served.
class LookQueue {
 public:
  explicit LookQueue(std::size_t vertices) : waits_(vertices, 0) {}

  void Push(int vertex) {
    if (waits_[Z(vertex)]) return;
    waits_[Z(vertex)] = 1;
    queue_.push_back(vertex);
  }
  bool empty() const { return next_ == queue_.size(); }
  int Pop() {
    const int vertex = queue_[next_++];
    waits_[Z(vertex)] = 0;
    if (empty()) queue_.clear(), next_ = 0;
    return vertex;
  }

 private:
  std::vector<std::uint8_t> waits_;
  std::vector<int> queue_;
  std::size_t next_ = 0;
};

// Until no vertex in the queue can be helped. improve(vertex): makes one move that saves something
// around the vertex, and puts those whose edges it changed into the queue; false: there is none.
template <class Improve>
void Settle(LookQueue& queue, const Improve& improve) {
  while (!queue.empty()) {
    const int vertex = queue.Pop();
    while (improve(vertex)) {
    }
  }
}

// Kicks a tour that has settled. The tour says how: MayKick() whether there is time for another
// one, Kick() makes one (false: none here), Settle() mends it, IsWorse() compares the outcome with
// the tour before the kick, Undo() goes back to that one.
template <class Tour>
void Perturb(Tour& tour) {
  while (tour.MayKick()) {
    if (!tour.Kick()) continue;
    tour.Settle();
    if (tour.IsWorse()) tour.Undo();
  }
}

}  // namespace floorproof
