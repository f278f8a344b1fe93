// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "curves/sample_model.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

struct CycleResult;

// What the wall says of the material under the tip: its numbers with their sources, the law that it is given and why,
// what that comes to, and the two values that move. Values that are not their files' are marked.
render::DataPanel data_panel(const curves::SampleModel& material, const scene::Tip& tip);

// What was felt on each material, when all is done.
render::DataPanel results_panel(std::span<const CycleResult> results);

}  // namespace afm::exhibit
