// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace afm::app {

enum class RendererFate { Killed, Stopped };

// Time from the renderer's end to zero force, milliseconds, one value per round. In each round a renderer in a separate
// process starts touchafm-servo from the folder of `program` and holds the tip on the sample; then it is killed or
// stopped. Repeats a round in which the load on the machine made the servo release the hand early. The caller has one
// thread only. Two seconds a round.
core::Result<std::vector<double>> measure_reaction(const std::string& program, RendererFate fate, int rounds);

}  // namespace afm::app
