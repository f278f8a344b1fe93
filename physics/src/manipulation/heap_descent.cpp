// SPDX-License-Identifier: Apache-2.0
#include "heap_descent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "definite_solution.h"
#include "heap_system.h"
#include "rod_steps.h"

namespace afm::physics {
namespace {

using Step = HeapContacts::Step;
using Body = HeapContacts::Body;
using Place = HeapContacts::Place;
using System = HeapSystem;
using Normal = HeapContacts::Normal;
using Touch = HeapContacts::Touch;

constexpr double kTinyGain = 1e-12;       // smallest gain of a round that counts, as a fraction of E + R
constexpr double kLeastStiffness = 1e-6;  // added stiffness as a fraction of a contact's
constexpr int kMostHalvings = 8;
constexpr int kMostAttempts = 3;         // solutions for one Newton step, each with other contacts
constexpr double kSolvingShare = 0.02;   // work of a solution per cube of the system's size
constexpr int kNewtonSteps = 3;          // Newton steps in a round, and of the tip at the start
constexpr double kRestRounding = 1e-12;  // fraction by which a force must exceed a threshold

using Move = std::array<double, kMostUnknowns>;

class Descent {
 public:
  Descent(HeapContacts& heap, double reach_m, double& work) noexcept
      : heap_(heap), start_(heap.apex()), reach_m_(reach_m), work_(work) {}

  bool run() noexcept;

 private:
  Flat pull_on(std::size_t i, double& spring) const noexcept;
  bool settle(std::size_t i) noexcept;
  bool settle_rod(std::size_t i) noexcept;
  bool sweep() noexcept;
  bool touches(std::size_t i) const noexcept;
  void assemble(System& s, const Step& movers, bool curved, bool foreseen) const noexcept;
  bool solve(const Step& movers, bool foreseen, Move& move) noexcept;
  void propose(Step& step, const Move& move, double share) const noexcept;
  bool foresee(const Step& step, bool foreseen) noexcept;
  bool tip_counts(std::size_t i, bool foreseen) const noexcept {
    return foreseen ? tip_foreseen_[i] : heap_.tip_acts(i);
  }
  bool pair_counts(std::size_t p, bool foreseen) const noexcept {
    return foreseen ? pair_foreseen_[p] : heap_.touches(p);
  }
  bool within_reach(const Step& step) const noexcept;
  double farthest(const Step& step) const noexcept;
  bool newton() noexcept;
  bool take_if_lower(const Step& step, double change_j) noexcept;
  std::size_t row_of(std::size_t body) const noexcept;

  HeapContacts& heap_;
  Apex start_;
  double reach_m_;
  double& work_;
  double gained_j_ = 0.0;                                          // energy gained in this round
  std::array<std::size_t, HeapContacts::kMostActive + 1> rows_{};  // first row of each mover, and the end
  double tiny_j_ = 0.0;                                            // largest gain of a round that does not count
  std::size_t links_ = 0;                                          // contacts of the parts moved by a Newton step
  std::array<bool, HeapContacts::kMostActive> tip_foreseen_{};
  std::array<bool, HeapContacts::kMostPairs> pair_foreseen_{};
  bool at_limit_ = false;  // true: a part has moved by reach_m_
};

bool Descent::take_if_lower(const Step& step, double change_j) noexcept {
  if (!may_be_taken(change_j)) return false;
  gained_j_ -= change_j;
  heap_.take(step);
  return true;
}

// Force of E on a sphere, and the stiffness of what it touches.
Flat Descent::pull_on(std::size_t i, double& spring) const noexcept {
  const double k_n = heap_.springs().contact.si;
  Flat force;
  spring = 0.0;
  if (const Normal normal = heap_.normal_of(i); normal.acts) {
    force.x += k_n * normal.overlap_m * normal.towards[0];
    force.y += k_n * normal.overlap_m * normal.towards[1];
    spring += k_n;
  }
  for (const std::size_t p : heap_.pairs_of(i)) {
    if (!heap_.touches(p)) continue;
    const Touch touch = heap_.touch_of(p);
    const double push = (heap_.pair(p).first == i ? k_n : -k_n) * touch.overlap_m;
    force.x += push * touch.u[0];
    force.y += push * touch.u[1];
    spring += k_n;
  }
  return force;
}

// One proximal step of a sphere, which decides whether it moves. Returns whether it was taken.
bool Descent::settle(std::size_t i) noexcept {
  const Body& body = heap_.body(i);
  if (body.pinned) return false;
  if (body.is_rod()) return settle_rod(i);
  double spring = 0.0;
  const Flat force = pull_on(i, spring);
  const double size = std::sqrt(force.x * force.x + force.y * force.y);
  if (!body.moved() && size <= body.rest_n * (1.0 + kRestRounding)) return false;
  if (!(spring > 0.0)) spring = heap_.springs().contact.si;  // friction only: back to the start
  const double f = body.moving_n;
  const Flat was = body.at, start = body.start;
  const double zx = was.x + force.x / spring - start.x, zy = was.y + force.y / spring - start.y;
  const double way = std::sqrt(zx * zx + zy * zy);
  const double share = way * spring > f ? 1.0 - f / (spring * way) : 0.0;
  Step step;
  step.count = 1;
  step.movers[0] = i;
  heap_.choose({step.movers.data(), 1});
  double length = 1.0;
  for (int halving = 0; halving < kMostHalvings; ++halving, length *= 0.5) {
    Flat& to = step.to[0].at;
    to = {was.x + length * (start.x + share * zx - was.x), was.y + length * (start.y + share * zy - was.y)};
    if (length == 1.0 && share == 0.0) to = start;
    if (distance_between(to, start) > reach_m_) continue;
    work_ -= static_cast<double>(heap_.pairs_of(i).size());
    if (take_if_lower(step, heap_.change_of(step))) return true;
  }
  return false;
}

bool Descent::settle_rod(std::size_t i) noexcept {
  const Body& rod = heap_.body(i);
  work_ -= static_cast<double>(heap_.pairs_of(i).size());
  const std::optional<Place> proposed = rod_step(heap_, i);
  if (!proposed) return false;
  Step step;
  step.count = 1;
  step.movers[0] = i;
  heap_.choose({step.movers.data(), 1});
  const Place was = rod.place(), start = rod.place_at(rod.start, 0.0);
  Flat way{proposed->at.x - was.at.x, proposed->at.y - was.at.y};
  double turn_m = proposed->turned_m - was.turned_m;
  step.to[0] = *proposed;
  for (int halving = 0; halving < kMostHalvings; ++halving) {
    work_ -= static_cast<double>(heap_.pairs_of(i).size());
    if (way_between(step.to[0], start) <= reach_m_ && take_if_lower(step, heap_.change_of(step))) return true;
    way = {0.5 * way.x, 0.5 * way.y};
    turn_m *= 0.5;
    step.to[0] = rod.place_at({was.at.x + way.x, was.at.y + way.y}, was.turned_m + turn_m);
  }
  return false;
}

bool Descent::touches(std::size_t i) const noexcept {
  if (heap_.tip_acts(i)) return true;
  const auto pairs = heap_.pairs_of(i);
  return std::any_of(pairs.begin(), pairs.end(), [this](std::size_t p) { return heap_.touches(p); });
}

bool Descent::sweep() noexcept {
  work_ -= static_cast<double>(heap_.size() + heap_.pair_count());
  bool any = false;
  for (std::size_t i = 0; i < heap_.size(); ++i) any = settle(i) || any;
  return any;
}

// First row of a body in the system; 0: it does not move.
std::size_t Descent::row_of(std::size_t body) const noexcept {
  const std::size_t mover = heap_.mover(body);
  return mover == HeapContacts::kMostActive ? 0 : rows_[mover];
}

void Descent::assemble(System& s, const Step& movers, bool curved, bool foreseen) const noexcept {
  const double k_l = heap_.springs().lateral.si, k_c = heap_.springs().normal.si;
  const Apex &apex = heap_.apex(), &base = heap_.base();
  s.gradient[0] = k_l * (apex.x - base.x);
  s.gradient[1] = k_l * (apex.y - base.y);
  s.gradient[2] = k_c * (apex.height - base.height);
  s.stiffness[0][0] = s.stiffness[1][1] = k_l;
  s.stiffness[2][2] = k_c;
  for (const std::size_t i : heap_.near_tip()) {
    if (!tip_counts(i, foreseen)) continue;
    const std::size_t row = row_of(i);
    heap_.body(i).is_rod() ? add_rod_tip(s, heap_, i, row) : add_sphere_tip(s, heap_, i, row, curved);
  }
  for (std::size_t m = 0; m < movers.count; ++m) {
    const std::size_t i = movers.movers[m];
    const Body& body = heap_.body(i);
    body.is_rod() ? add_rod_friction(s, body, rows_[m]) : add_sphere_friction(s, body, rows_[m]);
    for (const std::size_t p : heap_.pairs_of(i)) {
      if (!heap_.counts_to(i, p) || !pair_counts(p, foreseen)) continue;
      const std::size_t first = row_of(heap_.pair(p).first), second = row_of(heap_.pair(p).second);
      heap_.has_rod(p) ? add_rod_pair(s, heap_, p, first, second) : add_sphere_pair(s, heap_, p, first, second, curved);
    }
  }
  if (!curved) {
    // a body that nothing touches has no stiffness along its way
    for (std::size_t i = 3; i < s.size; ++i) s.stiffness[i][i] += kLeastStiffness * heap_.springs().contact.si;
  }
  // an apex that the lever presses on the sample stays there
  if (apex.height <= 0.0 && s.gradient[2] > 0.0) {
    for (std::size_t j = 0; j < s.size; ++j) s.stiffness[2][j] = s.stiffness[j][2] = 0.0;
    s.stiffness[2][2] = k_c;
    s.gradient[2] = 0.0;
  }
}

bool Descent::within_reach(const Step& step) const noexcept {
  const double x = step.apex.x - start_.x, y = step.apex.y - start_.y, z = step.apex.height - start_.height;
  if (!(x * x + y * y + z * z <= reach_m_ * reach_m_)) return false;
  for (std::size_t m = 0; m < step.count; ++m) {
    const Body& body = heap_.body(step.movers[m]);
    if (!(way_between(step.to[m], {.at = body.start}) <= reach_m_)) return false;
  }
  return true;
}

// Solves for the Newton step from the contacts of now, or from those foreseen. False if there is none.
bool Descent::solve(const Step& movers, bool foreseen, Move& move) noexcept {
  const auto size = static_cast<double>(rows_[movers.count]);
  for (const bool curved : {true, false}) {
    if (!curved && work_ <= 0.0) return false;
    work_ -= static_cast<double>(links_) + kSolvingShare * size * size * size;
    System system(rows_[movers.count]);
    assemble(system, movers, curved, foreseen);
    if (!solve_definite(system.size, system.stiffness, system.gradient, move)) continue;
    // what a step gains is half of what its gradient promises
    double promised_j = 0.0;
    for (std::size_t i = 0; i < system.size; ++i) promised_j -= 0.5 * system.gradient[i] * move[i];
    return foreseen || promised_j > 0.1 * tiny_j_;
  }
  return false;
}

// Proposes a part of a move. Friction has a kink where a body started: a body that would go back past it stops there.
void Descent::propose(Step& step, const Move& move, double share) const noexcept {
  const Apex& was = heap_.apex();
  step.apex = {was.x + share * move[0], was.y + share * move[1], std::max(0.0, was.height + share * move[2])};
  for (std::size_t m = 0; m < step.count; ++m) {
    const Body& body = heap_.body(step.movers[m]);
    const std::size_t row = rows_[m];
    const Flat to{body.at.x + share * move[row], body.at.y + share * move[row + 1]};
    step.to[m] = body.place_at(to, body.is_rod() ? body.turned_m + share * move[row + 2] : 0.0);
    if (goes_back(body, step.to[m])) step.to[m] = body.place_at(body.start, 0.0);
  }
}

// Takes the contacts at the end of the step asked last for those of the next solution. False if they are the same.
bool Descent::foresee(const Step& step, bool foreseen) noexcept {
  bool changed = false;
  const auto mark = [&changed](bool& known, bool solved_with, bool touches) {
    changed = changed || touches != solved_with;
    known = touches;
  };
  for (const std::size_t i : heap_.near_tip()) mark(tip_foreseen_[i], tip_counts(i, foreseen), heap_.tip_acts_then(i));
  for (std::size_t m = 0; m < step.count; ++m) {
    const std::size_t i = step.movers[m];
    for (const std::size_t p : heap_.pairs_of(i)) {
      if (heap_.counts_to(i, p)) mark(pair_foreseen_[p], pair_counts(p, foreseen), heap_.touches_then(p));
    }
  }
  return changed;
}

// Longest way of a part in a proposed step, above zero.
double Descent::farthest(const Step& step) const noexcept {
  const Apex& was = heap_.apex();
  const double x = step.apex.x - was.x, y = step.apex.y - was.y, z = step.apex.height - was.height;
  double longest_m = std::max(1e-30, std::sqrt(x * x + y * y + z * z));
  for (std::size_t m = 0; m < step.count; ++m) {
    longest_m = std::max(longest_m, way_between(step.to[m], heap_.body(step.movers[m]).place()));
  }
  return longest_m;
}

// One Newton step of the apex, and of the bodies that move. Taken only if it lowers the sum. A step that would close
// or open contacts is tried again with those that it ends in, and then in parts.
bool Descent::newton() noexcept {
  Step step;
  step.moves_apex = true;
  rows_[0] = 3;
  links_ = heap_.near_tip().size();
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    if (!heap_.body(i).moved() || !touches(i)) continue;
    rows_[step.count + 1] = rows_[step.count] + unknowns_of(heap_.body(i));
    step.movers[step.count++] = i;
    links_ += heap_.pairs_of(i).size();
  }
  heap_.choose({step.movers.data(), step.count});
  Move first{}, move{};
  bool inside = false;
  for (int attempt = 0; attempt < kMostAttempts && (attempt == 0 || work_ > 0.0); ++attempt) {
    if (!solve(step, attempt > 0, move)) {
      if (attempt == 0) return false;
      break;
    }
    if (attempt == 0) first = move;
    propose(step, move, 1.0);
    if (!within_reach(step)) propose(step, move, 0.5 * reach_m_ / farthest(step));
    work_ -= static_cast<double>(links_);
    const double change_j = heap_.change_of(step);
    const bool within = within_reach(step);
    if (attempt == 0) inside = within;
    if (within && take_if_lower(step, change_j)) return true;
    if (!foresee(step, attempt > 0)) break;
  }
  // a part that nothing holds may be sent far away
  propose(step, first, 0.5);
  double share = 0.5 * std::min(1.0, reach_m_ / farthest(step));
  for (int halving = 0; halving < kMostHalvings && work_ > 0.0; ++halving, share *= 0.5) {
    propose(step, first, share);
    if (!within_reach(step)) continue;
    inside = true;
    work_ -= static_cast<double>(links_);
    if (take_if_lower(step, heap_.change_of(step))) return true;
  }
  if (!inside && work_ > 0.0) at_limit_ = true;
  return false;
}

bool Descent::run() noexcept {
  tiny_j_ = kTinyGain * heap_.stored();
  // no body moves yet: these are steps of the tip alone
  for (int i = 0; i < kNewtonSteps && newton(); ++i) continue;
  while (work_ > 0.0 && !at_limit_) {
    gained_j_ = 0.0;
    tiny_j_ = kTinyGain * (heap_.stored() + heap_.friction());
    bool moved = sweep();
    for (int i = 0; i < kNewtonSteps && work_ > 0.0 && newton(); ++i) moved = true;
    if (at_limit_ || work_ <= 0.0) return false;
    if (!moved || gained_j_ <= tiny_j_) return true;
  }
  return false;
}

}  // namespace

bool may_be_taken(double change_j) noexcept { return change_j < 0.0; }

bool descend(HeapContacts& heap, double reach_m, double& work) noexcept { return Descent(heap, reach_m, work).run(); }

}  // namespace afm::physics
