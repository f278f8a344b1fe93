// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// touchafm bench tapping: the tick of a hand's envelope, a slow curve compared with direct integration, the latter
// compared with a Runge-Kutta of equal error, and an image, each as a ratio of two times measured in turn.
void add_tapping_benchmarks(OptionList& bench, const CommandContext& context);

}  // namespace afm::app
