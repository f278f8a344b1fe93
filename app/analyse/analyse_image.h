// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/measured_topography.h"

namespace afm::app {

// Prints the figures of an image file to stdout.
core::Result<void> analyse_image_file(const std::string& file, const curves::TopographyReading& reading, bool json);

}  // namespace afm::app
