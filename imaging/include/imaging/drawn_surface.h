// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.h"
#include "scene/samples/material_library.h"
#include "scene/shared/shared_blocks.h"

namespace afm::imaging {

// The material whose models are used for this one: itself, the one with its look or, with a line on stderr, the grey
// one.
std::string model_of(const std::string& assets_dir, const scene::MaterialEntry& material);

// The surface that the wall draws for a material. Does not draw it. The error names the file.
core::Result<std::unique_ptr<scene::SharedHeightField>> drawn_surface(const std::string& assets_dir,
                                                                      const scene::MaterialEntry& material);

}  // namespace afm::imaging
