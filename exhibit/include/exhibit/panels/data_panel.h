// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "curves/sample_model.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

struct CycleResult;

// Data of the material under the tip: values with their sources, its force law and the reason for it, the resulting
// jumps and energy, and the two moving values. Changed values are marked. Sources and reasons are left out as details.
render::DataPanel data_panel(const curves::SampleModel& material, const scene::Tip& tip, const Phrases& phrases);

// The jumps of each material's cycle, once all are done.
render::DataPanel results_panel(std::span<const CycleResult> results, const Phrases& phrases);

}  // namespace afm::exhibit
