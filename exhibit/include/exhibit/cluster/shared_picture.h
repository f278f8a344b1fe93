// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "servo/live_picture.h"

namespace afm::cluster {
struct PictureRecord;
}

namespace afm::exhibit {

struct ParticlesNow;
struct WallHistory;

// Picture of the particles, for the other machines of a wall; level 0 if there is none.
cluster::PictureRecord record_of(const ParticlesNow& now);

// Same picture on another machine, whose set has `count` particles; empty if there is none.
std::optional<servo::PictureNow> picture_of(const WallHistory& history, std::size_t count);

}  // namespace afm::exhibit
