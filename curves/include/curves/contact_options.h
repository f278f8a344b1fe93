// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "scene/samples/probe_library.h"

namespace afm::curves {

// A contact as a user describes it; empty text: not given.
struct ContactOptions {
  std::string assets_dir;                   // folder with materials.toml and probes.toml
  std::vector<std::string> material_files;  // files of the user, added to the built-in ones
  std::vector<std::string> probe_files;     // files of the user, added to the built-in ones
  std::string material;                     // empty: all numbers that the model needs must be given
  std::string probe;                        // name of the probe; empty: the material's lever and tip
  std::string model = "auto";
  std::map<std::string, std::string, std::less<>> values;  // values as typed, by the option's name without dashes
  std::map<std::string, double, std::less<>> si_values;    // values in SI from a program; each key is in one of the two
  bool exact_sphere = false;
  bool driven = false;  // true: a drive swings the lever (ModelName)
};

// Loads the built-in and the user's materials. A user's material replaces a built-in one of the same name.
core::Result<scene::MaterialLibrary> load_materials(const ContactOptions& options);
core::Result<scene::ProbeLibrary> load_probes(const ContactOptions& options);

// Loads the material, adds the probe and applies the overrides. WrongUsage, naming the option, for an unknown name, a
// number that is malformed or has no effect in the model, and a missing number if no material is named.
core::Result<ContactSetup> contact_setup(const ContactOptions& options);

}  // namespace afm::curves
