// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/command.h"
#include "physics/imaging/levelling.h"

namespace afm::app {

// --channel and --level: how an image that an instrument measured is read.
void add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling);

}  // namespace afm::app
