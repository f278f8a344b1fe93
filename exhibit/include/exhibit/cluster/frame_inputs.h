// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cluster/frame_message.h"
#include "exhibit/panels/depth_report.h"
#include "exhibit/state/moment.h"
#include "scene/shared/shared_blocks.h"

// Conversion of a frame's inputs to the messages of a wall's machines and back.
namespace afm::exhibit {

// Stores the fields that the moment contains; `blank`: no picture.
void set_moment(const Moment& moment, const scene::TipState& tip, const std::string& caption, bool blank,
                cluster::FrameMessage& message);

// The moment of a message, without its curves.
Moment moment_of(const cluster::FrameMessage& message);
std::string caption_of(const cluster::FrameMessage& message);

// State of the tip, as far as the wall shows it.
scene::TipState tip_of(const cluster::FrameMessage& message);

void set_depth(const DepthReport& depth, cluster::ShownView& view);
DepthReport depth_of(const cluster::ShownView& view);

}  // namespace afm::exhibit
