// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/options/command.h"

namespace afm::app {

// touchafm bench render: frames of the wall, of generated scenes and of glTF files in one multiview pass, in two passes
// and for one eye, compared with other programs; and the time to the first frame.
void add_render_benchmarks(OptionList& bench, const CommandContext& context);

}  // namespace afm::app
