// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cluster/frame_message.h"
#include "render/frame.h"

namespace afm::exhibit {

// Digest of a frame's content, its viewer and its drawing options. Equal on machines that show the same. Excludes the
// eyes, which each machine derives from the view and its own screens.
std::uint64_t digest_of(const render::FrameState& frame, const cluster::ShownView& view);

}  // namespace afm::exhibit
