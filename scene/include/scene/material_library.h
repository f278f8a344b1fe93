// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/interaction.h"
#include "physics/units.h"

namespace afm::scene {

// One choice of tip, sample and medium, with where each number comes from.
struct MaterialEntry {
  // A number as the file writes it ("50 nm") and its citation.
  struct Sourced {
    std::string key;
    std::string value;
    std::string source;
  };

  std::string name;   // what commands and models call it: "mica"
  std::string title;  // what people read: "Mica"
  std::string tip;
  std::string medium;
  std::string note;  // what a reader of the numbers must know; may be empty
  physics::Interaction interaction;
  physics::Force experiment_f_attr;  // magnitude, measured by others
  physics::Force experiment_f_ad;    // magnitude, measured by others
  std::vector<Sourced> sources;      // in the order of the fields above, then of Interaction
};

struct MaterialLibrary {
  std::vector<MaterialEntry> materials;  // in the file's order, names unique, every interaction valid

  // Null if there is none.
  const MaterialEntry* find(std::string_view name) const;

  // find(), or an error of wrong usage that lists the known names.
  core::Result<const MaterialEntry*> require(std::string_view name) const;
};

// Reads a material file (TOML, assets/materials.toml). An unreadable file, an unknown or missing key, a wrong type and
// an unphysical value are errors that name file, line and key.
core::Result<MaterialLibrary> load_materials(const std::string& path);

}  // namespace afm::scene
