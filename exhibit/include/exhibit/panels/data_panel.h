// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "curves/sample_model.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

struct CycleResult;

// The material under the tip: its numbers with their sources, its law of force and the reason for it, the jumps and the
// energy that follow, and the two values that move. Numbers that were changed are marked.
render::DataPanel data_panel(const curves::SampleModel& material, const scene::Tip& tip, const Phrases& phrases);

// The jumps of each material's cycle, when all are done.
render::DataPanel results_panel(std::span<const CycleResult> results, const Phrases& phrases);

}  // namespace afm::exhibit
