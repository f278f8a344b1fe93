// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// touchafm bench maps: time to read the curves of a file, and to fit them on one core and on all, compared with that
// of `unzip -t` for a zip archive.
void add_map_benchmark(OptionList& bench);

}  // namespace afm::app
