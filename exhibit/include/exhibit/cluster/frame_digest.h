// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/frame.h"

namespace afm::exhibit {

// Of everything in a frame but its eyes: two machines that build the same frame have the same digest.
std::uint64_t digest_of(const render::FrameState& frame);

}  // namespace afm::exhibit
