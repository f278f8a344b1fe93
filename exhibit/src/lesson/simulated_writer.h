// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "simulated_hand.h"

namespace afm::exhibit {

// A hand that scratches lines into the soft sample of a set: it presses with the load for the wanted width, which it
// feels, and steers towards the line. As SimulatedHand::create.
std::unique_ptr<SimulatedHand> make_writing_hand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo,
                                                 std::uint64_t seed);

}  // namespace afm::exhibit
