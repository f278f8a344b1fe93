// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>

#include "heap_descent.h"
#include "push_ticker.h"

// A sub-step among several spheres.
namespace afm::physics {

bool PushedParticles::Ticker::add_sphere(std::size_t i, bool near_tip) noexcept {
  const LoneContact& contact = contacts_[species_[i]];
  const Pressed& pressed = pressed_[i];
  const LoneThresholds thresholds = contact.under_load(pressed.normal_n, pressed.sine, pressed.cosine);
  return heap_.add(HeapContacts::Sphere{.particle = i,
                                        .profile = &contact.profile(),
                                        .start = {x_[i], y_[i]},
                                        .at = {x_[i], y_[i]},
                                        .rest_n = rest_threshold(i, thresholds.rest_n, thresholds.moving_n),
                                        .moving_n = thresholds.moving_n,
                                        .pinned = pinned_[i],
                                        .near_tip = near_tip});
}

// The neighbours of a sphere of the descent, as spheres of it too while there is room.
bool PushedParticles::Ticker::gather_pairs_of(std::size_t first) noexcept {
  const std::size_t i = heap_.sphere(first).particle;
  bool fits = true;
  grid_->near(x_[i], y_[i], [&](std::size_t j) {
    const double touching = touching_m(i, j), most_m = touching + 2.0 * heap_reach_m_;
    const double x = x_[i] - x_[j], y = y_[i] - y_[j];
    if (j == i || x * x + y * y > most_m * most_m) return;
    std::size_t second = heap_.find(j);
    if (second == heap_.size() && !add_sphere(j, false)) second = HeapContacts::kMostActive;
    if (second < first) return;  // known from the other side
    fits = heap_.add(HeapContacts::Pair{first, second, {x_[j], y_[j]}, touching}) && fits;
  });
  return fits;
}

bool PushedParticles::Ticker::gather(const Apex& to) noexcept {
  heap_.begin(to, apex_);
  if (!find_near()) return false;
  bool fits = true;
  for (const std::size_t i : near_) fits = add_sphere(i, true) && fits;
  // spheres near the tip and their neighbours first, then those of an unsettled heap while there is room
  std::size_t n = 0;
  for (; n < near_.size(); ++n) fits = gather_pairs_of(n) && fits;
  for (const std::size_t i : restless_) {
    if (heap_.find(i) == heap_.size()) add_sphere(i, false);
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
    if (!heap_.sphere(n).pinned) restless_.add(heap_.sphere(n).particle);
  }
  for (std::size_t n = 0; n < heap_.size(); ++n) {
    const HeapContacts::Sphere& sphere = heap_.sphere(n);
    if (!sphere.moved()) continue;
    if (sphere.rest_n > sphere.moving_n) gave(sphere.rest_n, sphere.moving_n);
    place(sphere.particle, sphere.at);
  }
}

}  // namespace afm::physics
