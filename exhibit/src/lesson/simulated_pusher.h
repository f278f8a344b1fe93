// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "simulated_hand.h"

namespace afm::exhibit {

// A hand that pushes particles and steers along the line from particle to target. As SimulatedHand::create.
std::unique_ptr<SimulatedHand> make_pushing_hand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo,
                                                 std::uint64_t seed);

}  // namespace afm::exhibit
