// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// `bench cluster`.
void add_cluster_benchmarks(OptionList& bench, const CommandContext& context);

}  // namespace afm::app
