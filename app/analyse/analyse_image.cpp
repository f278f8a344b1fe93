// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/analyse_image.h"

#include <nlohmann/json.hpp>

#include "app/options/standard_output.h"
#include "core/json_text.h"

namespace afm::app {

core::Result<void> analyse_image_file(const std::string& file, const curves::TopographyReading& reading, bool json) {
  const auto topography = curves::load_topography(file, reading);
  if (!topography) return tl::unexpected(topography.error());
  return json ? write_stdout(core::json_text(curves::topography_json(*topography), 2) + "\n")
              : write_report(curves::topography_text(*topography));
}

}  // namespace afm::app
