// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "core/result.h"
#include "curves/contact_setup.h"
#include "scene/samples/probe_library.h"

namespace afm::app {

// Contact options of the command line, as typed; empty text: not given.
struct ContactOptions {
  std::string assets_dir;                   // holds materials.toml and probes.toml
  std::vector<std::string> material_files;  // of the user; they add to the built-in ones
  std::vector<std::string> probe_files;     // the same
  std::string material;                     // empty: every number that the model needs is given
  std::string probe;                        // empty: the material's lever and tip
  std::string model = "auto";
  std::map<std::string, std::string, std::less<>> values;  // by the option's name, without its dashes
  bool exact_sphere = false;
};

// --materials, --probes, --probe, --model and one option a number. `options` must live while `command` parses.
void add_contact_options(OptionList& command, ContactOptions& options, const CommandContext& context);

// The built-in materials with the user's on top.
core::Result<scene::MaterialLibrary> load_materials(const ContactOptions& options);
core::Result<scene::ProbeLibrary> load_probes(const ContactOptions& options);

// Loads the material, puts the probe under it and applies the overrides. An unknown name, a number that cannot be read
// or does not act on the model, and one that is missing where no material is named are errors of wrong usage that name
// the option.
core::Result<curves::ContactSetup> contact_setup(const ContactOptions& options);

}  // namespace afm::app
