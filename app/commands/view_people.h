// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands/view_command.h"
#include "app/live/view_settings.h"
#include "core/result.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

// Settings of the people who move the hand, listen, or keep the window open, from the options of `view`.
core::Result<void> set_people(const ViewOptions& options, const exhibit::Stage& stage, ViewSettings& settings);

}  // namespace afm::app
