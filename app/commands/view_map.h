// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands/view_command.h"
#include "app/live/view_settings.h"
#include "core/result.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// Checks the options of the force map, and stores in `files` those that it shares with tapping: with a force map,
// --spring-constant describes the lever that recorded it. A map vibrates only on a device whose profile allows it; for
// the device "auto" the servo decides.
core::Result<void> take_map_options(const ViewOptions& options, curves::TappedHand& tapping,
                                    exhibit::ExhibitFiles& files);

// Stores the file of the map in the settings, if sessions are recorded.
core::Result<void> keep_map(const exhibit::Stage& stage, const exhibit::ExhibitFiles& files, ViewSettings& settings);

}  // namespace afm::app
