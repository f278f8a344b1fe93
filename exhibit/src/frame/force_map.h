// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_files.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// The pixel of the force map that is felt first; null if no map is wanted. Reads, and where a fit is wanted fits, every
// curve, with progress in the log. BadInputFile as from curves::CurveMap::load(), WrongUsage for a fit that cannot be
// made; Failed if it is interrupted.
core::Result<std::shared_ptr<const curves::SampleModel>> load_force_map(const ExhibitFiles& files);

// Its entry on the shelf, without the pixel in its title: it may change.
scene::MaterialEntry entry_of(const curves::SampleModel& pixel);

}  // namespace afm::exhibit
