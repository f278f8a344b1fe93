// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "app/view/view_control.h"
#include "exhibit/state/particles_now.h"

namespace afm::app {

struct ViewParts;

// Shows the particles where the servo has moved them, and has it take pushes back.
class ParticlesControl final : public ViewControl {
 public:
  // `set` must outlive the object.
  ParticlesControl(ViewParts& parts, const scene::ParticleSet& set) : parts_(parts), now_{.set = &set} {}

  // Takes the newest push back, after the force has been taken from the hand.
  void take_back();

  void update(const ViewFrame& frame) override;
  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  enum class Order { None, TakeBack, PutBack };

  // The servo carries it out without force alone, so the order waits until there is none.
  void give(Order order);

  // Announces a pattern once it is done.
  void follow_pattern();

  ViewParts& parts_;
  exhibit::ParticlesNow now_;
  Order order_ = Order::None;
  std::uint64_t digest_ = 0;  // places whose pattern was judged last
  bool pattern_done_ = true;  // at first, so that one that is done from the start is not announced
};

}  // namespace afm::app
