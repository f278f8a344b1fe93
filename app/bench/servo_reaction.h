// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace afm::app {

enum class RendererFate { Killed, Stopped };

// How long the hand still felt a force after the renderer's end, milliseconds, once for each round: a renderer in a
// process of its own starts touchafm-servo, which lies beside `program`, and holds the tip on the sample; then it is
// killed, or stopped. A round in which the machine made the servo let go before is done again. The caller has one
// thread only. Two seconds a round.
core::Result<std::vector<double>> measure_reaction(const std::string& program, RendererFate fate, int rounds);

}  // namespace afm::app
