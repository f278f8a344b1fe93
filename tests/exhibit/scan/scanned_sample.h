// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/scan_subject.h"
#include "support/places.h"

namespace afm::exhibit {

// The samples of the program, loaded once.
inline const Stage& stage() {
  static const Stage loaded = [] {
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    return load_exhibit(files).value();
  }();
  return loaded;
}

inline LiveScan scan_of(std::size_t material) {
  const auto model = curves::make_sample_model(curves::ContactSetup{stage().materials.materials[material], {}, {}});
  return LiveScan(scan_subject(stage().wall_scene, material, model.value()));
}

}  // namespace afm::exhibit
