// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// touchafm bench maps: the time in which the curves of a file are read, and fitted on one core and on all, next to that
// of `unzip -t` for a zip archive.
void add_map_benchmark(OptionList& bench);

}  // namespace afm::app
