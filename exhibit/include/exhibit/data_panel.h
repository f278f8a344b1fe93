// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "curves/sample_model.h"
#include "render/frame.h"

namespace afm::exhibit {

struct Felt;

// What the wall says of the material under the tip: its numbers with their sources, the law that it is given and why,
// what that comes to, and the two values that move. Values that are not their files' are marked.
render::DataPanel data_panel(const curves::SampleModel& material, double deflection_m, double force_n);

// What was felt on each material, when all is done.
render::DataPanel felt_panel(std::span<const Felt> felt);

}  // namespace afm::exhibit
