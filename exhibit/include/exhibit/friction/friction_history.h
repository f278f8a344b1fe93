// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/friction/friction_loop.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The tip's path over the sample: the current or newest contact, and the newest contact before it with a friction loop.
// Discarded when the material or its parameters change. Memory is bounded. One thread.
class FrictionHistory {
 public:
  static constexpr std::size_t kMostPoints = 30'000;  // limit for one contact; beyond it the oldest third is dropped

  void add(const scene::TipSample& sample);

  std::span<const physics::SidewaysPoint> contact() const { return contact_; }
  std::span<const physics::SidewaysPoint> earlier() const { return earlier_; }
  bool attached() const { return attached_; }

  // All of the object's state, for storage by exhibit/cluster/wall_history.h.
  template <class History, class Visit>
  static void visit_state(History& history, Visit&& visit) {
    visit(history.contact_);
    visit(history.earlier_);
    visit(history.material_);
    visit(history.edit_revision_);
    visit(history.attached_);
  }
  bool sound() const { return contact_.size() <= kMostPoints && earlier_.size() <= kMostPoints; }

 private:
  std::vector<physics::SidewaysPoint> contact_, earlier_;
  std::int32_t material_ = -1;
  std::uint32_t edit_revision_ = 0;
  bool attached_ = false;
};

}  // namespace afm::exhibit
