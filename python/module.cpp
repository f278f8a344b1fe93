// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include "core/version.h"
#include "python/bindings.h"

PYBIND11_MODULE(_core, module) {
  using namespace afm::python;
  module.attr("__version__") = afm::core::kVersion;
  add_errors(module);
  add_contacts(module);
  add_cycles(module);
  add_files(module);
  add_images(module);
  add_fits(module);
  add_drive(module);
  add_tapping(module);
  add_frequency_shifts(module);
  add_surfaces(module);
  add_scans(module);
  add_levers(module);
  add_synthetic(module);
  add_sessions(module);
  add_studies(module);
}
