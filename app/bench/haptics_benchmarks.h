// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/command.h"

namespace afm::app {

// touchafm bench haptics: the work of a tick, the wake-ups of the real servo beside a renderer that draws as fast as it
// can, and how long a force outlives its renderer.
void add_haptics_benchmarks(OptionList& bench, const CommandContext& context);

}  // namespace afm::app
