// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cluster/frame_message.h"
#include "render/frame.h"

namespace afm::exhibit {

// Of everything in a frame, and of whom and how it is drawn for: two machines that show the same have the same digest.
// The eyes of a frame follow from the view and from each machine's own screens, and are left out.
std::uint64_t digest_of(const render::FrameState& frame, const cluster::ShownView& view);

}  // namespace afm::exhibit
