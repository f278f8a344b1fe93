// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

// Parts of the module touchafm._core, in the order in which they are added: each uses the types of those before it.
namespace afm::python {

void add_errors(pybind11::module_& module);
void add_contacts(pybind11::module_& module);  // adds materials, probes, contacts, laws
void add_cycles(pybind11::module_& module);    // adds cycles, sweeps, the paper's tables
void add_files(pybind11::module_& module);     // adds curves from files
void add_images(pybind11::module_& module);    // adds images from files
void add_fits(pybind11::module_& module);      // adds analysis and fits
void add_drive(pybind11::module_& module);
void add_tapping(pybind11::module_& module);
void add_frequency_shifts(pybind11::module_& module);
void add_surfaces(pybind11::module_& module);   // adds samples for the images below
void add_scans(pybind11::module_& module);      // adds images of the virtual microscope
void add_levers(pybind11::module_& module);     // adds the calibration of levers
void add_synthetic(pybind11::module_& module);  // adds synthetic curves with their truth
void add_sessions(pybind11::module_& module);
void add_studies(pybind11::module_& module);

}  // namespace afm::python
