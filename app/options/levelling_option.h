// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "app/options/command.h"
#include "physics/imaging/levelling.h"

namespace afm::app {

// --channel and --level: how an image that an instrument measured is read.
std::array<Option, 2> add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling);

}  // namespace afm::app
