// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <utility>

#include "heap_descent.h"
#include "push_ticker.h"

// A sub-step among several particles, or with a rod.
namespace afm::physics {

bool PushedParticles::Ticker::add_body(std::size_t i, bool near_tip) noexcept {
  const LoneContact& contact = contacts_[species_[i]];
  const Pressed& pressed = pressed_[i];
  const LoneThresholds thresholds = contact.under_load(pressed.normal_n, pressed.sine, pressed.cosine);
  const Outline there = outline(i);
  return heap_.add(HeapContacts::Body{.particle = i,
                                      .profile = &contact.profile(),
                                      .start = {x_[i], y_[i]},
                                      .at = {x_[i], y_[i]},
                                      .rest_n = rest_threshold(i, thresholds.rest_n, thresholds.moving_n),
                                      .moving_n = thresholds.moving_n,
                                      .pinned = pinned_[i],
                                      .near_tip = near_tip,
                                      .half_m = there.half_m,
                                      .start_axis = there.axis,
                                      .axis = there.axis});
}

// Whether two particles are farther apart than `most_m`.
bool PushedParticles::Ticker::is_beyond(std::size_t i, std::size_t j, double most_m) const noexcept {
  if (half_m(i) > 0.0 || half_m(j) > 0.0) return apart_m(i, j) > most_m;
  const double x = x_[i] - x_[j], y = y_[i] - y_[j];
  return x * x + y * y > most_m * most_m;
}

// `second` is kMostActive for a particle that stays.
bool PushedParticles::Ticker::add_pairs(std::size_t first, std::size_t second, std::size_t particle) noexcept {
  HeapContacts::Pair pair{.first = first,
                          .second = second,
                          .stays = outline(particle),
                          .distance_m = touching_m(heap_.body(first).particle, particle)};
  if (!(heap_.body(first).is_rod() && pair.stays.half_m > 0.0)) return heap_.add(pair);
  bool fits = true;
  for (const auto& [of_first, of_second] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
    pair.first_end = of_first;
    pair.second_end = of_second;
    fits = heap_.add(pair) && fits;
  }
  return fits;
}

// The neighbours of a body of the descent, as bodies of it too while there is room.
bool PushedParticles::Ticker::gather_pairs_of(std::size_t first) noexcept {
  const std::size_t i = heap_.body(first).particle;
  bool fits = true;
  grid_->near(x_[i], y_[i], [&](std::size_t j) {
    if (j == i || is_beyond(i, j, touching_m(i, j) + 2.0 * heap_reach_m_)) return;
    std::size_t second = heap_.find(j);
    if (second == heap_.size() && !add_body(j, false)) second = HeapContacts::kMostActive;
    if (second < first) return;  // known from the other side
    fits = add_pairs(first, second, j) && fits;
  });
  return fits;
}

bool PushedParticles::Ticker::gather(const Apex& to) noexcept {
  heap_.begin(to, apex_);
  if (!find_near()) return false;
  bool fits = true;
  for (const std::size_t i : near_) fits = add_body(i, true) && fits;
  // particles near the tip and their neighbours first, then those of an unsettled heap while there is room
  std::size_t n = 0;
  for (; n < near_.size(); ++n) fits = gather_pairs_of(n) && fits;
  for (const std::size_t i : restless_) {
    if (heap_.find(i) == heap_.size()) add_body(i, false);
  }
  for (; n < heap_.size(); ++n) fits = gather_pairs_of(n) && fits;
  heap_.find_contacts();
  return fits;
}

void PushedParticles::Ticker::heap_step(const Apex& to) noexcept {
  if (!gather(to)) {  // the base waits
    exhausted_ = true;
    settled_ = false;
    return;
  }
  const double loaded_j = lever_j(to, apex_) - lever_j(base_, apex_), frozen_j = heap_.stored();
  const double share = work_left_ / std::max(1, heap_steps_left_--);
  double work = share;
  const bool at_rest = descend(heap_, heap_reach_m_, work);
  work_left_ -= share - work;
  if (!at_rest) exhausted_ = true;
  const Apex& now = heap_.apex();
  settled_ = at_rest && heap_.friction() == 0.0 && now.x == apex_.x && now.y == apex_.y && now.height == apex_.height;
  tick_.given = tick_.given + Energy(loaded_j);
  tick_.work = tick_.work + Energy(work_j(base_, apex_, to, heap_.apex()));
  tick_.lost = tick_.lost + Energy(heap_.friction());
  tick_.stored = tick_.stored + Energy(loaded_j + heap_.stored() - frozen_j);
  base_ = to;
  apex_ = heap_.apex();
  restless_.clear();
  for (std::size_t n = 0; n < heap_.size() && !at_rest; ++n) {
    if (!heap_.body(n).pinned) restless_.add(heap_.body(n).particle);
  }
  for (std::size_t n = 0; n < heap_.size(); ++n) {
    const HeapContacts::Body& body = heap_.body(n);
    if (!body.moved()) continue;
    const double pushed = share_of_push(body.particle);
    if (body.rest_n > body.moving_n) gave(body.rest_n * pushed, body.moving_n * pushed);
    const HalfTurn& turn = turns_[body.particle];
    place(body.particle, body.at, body.is_rod() ? turned(turn, half_tangent(body.turned_m, body.half_m)) : turn);
  }
}

}  // namespace afm::physics
