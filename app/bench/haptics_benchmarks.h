// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// touchafm bench haptics: work per tick, scheduling latency of the real servo alongside a renderer at full speed, and
// the time until zero force after the renderer fails.
void add_haptics_benchmarks(OptionList& bench, const CommandContext& context);

}  // namespace afm::app
