// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "app/options/command.h"
#include "physics/imaging/levelling.h"
#include "scene/samples/level_choice.h"

namespace afm::app {

// Adds --channel, or another name, and --level: how to read an instrument's image. With `particles`, --level also takes
// the number of their level.
std::array<Option, 2> add_channel_options(OptionList& command, std::string& channel, physics::Levelling& levelling,
                                          const std::string& channel_name = "--channel",
                                          scene::LevelChoice* particles = nullptr);

}  // namespace afm::app
