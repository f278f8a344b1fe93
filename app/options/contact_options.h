// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"
#include "curves/contact_options.h"

namespace afm::app {

// Adds --materials, --probes, --probe, --model and one option per number. `options` must outlive the parsing of
// `command`.
void add_contact_options(OptionList& command, curves::ContactOptions& options, const CommandContext& context);

}  // namespace afm::app
