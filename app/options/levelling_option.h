// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "app/options/command.h"
#include "physics/imaging/levelling.h"

namespace afm::app {

// Adds --channel, or another name, and --level: how to read an instrument's image.
std::array<Option, 2> add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling,
                                          const std::string& channel_name = "--channel");

}  // namespace afm::app
