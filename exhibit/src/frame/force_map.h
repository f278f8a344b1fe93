// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_files.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// Pixel of the force map that is felt first; null if no map is wanted. Reads and, if wanted, fits every
// curve, with progress in the log. BadInputFile as from curves::CurveMap::load(), WrongUsage if a fit
// is impossible; Failed if interrupted.
core::Result<std::shared_ptr<const curves::SampleModel>> load_force_map(const ExhibitFiles& files);

// Entry of that pixel's map on the shelf. Its title omits the pixel, which may change.
scene::MaterialEntry entry_of(const curves::SampleModel& pixel);

}  // namespace afm::exhibit
