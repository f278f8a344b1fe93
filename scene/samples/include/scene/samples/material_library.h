// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/contact_parameters.h"
#include "physics/elasticity.h"
#include "physics/friction/friction.h"
#include "physics/lever_dynamics.h"
#include "physics/units.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {

// One combination of tip, lever, sample and medium, with the source of each number.
struct MaterialEntry {
  std::string name;   // name in commands and models: "mica"
  std::string title;  // name for display: "Mica"
  std::string tip;
  std::string medium;
  std::string note;  // remark about the numbers; may be empty
  std::string look;  // material whose 3D models represent it; by default its own name
  physics::ContactParameters contact;
  std::optional<physics::Elasticity> tip_elasticity;     // set if the reduced modulus was computed from both bodies
  std::optional<physics::Elasticity> sample_elasticity;  // set if the reduced modulus was computed from both bodies
  physics::LeverDynamics lever;                          // lever in the medium, far from the sample
  std::optional<physics::Force> experiment_f_attr;       // magnitude, measured by others
  std::optional<physics::Force> experiment_f_ad;         // magnitude, measured by others
  std::vector<SourcedValue> sources;                     // sources of all numbers above, in the order of the fields
  physics::FrictionParameters friction;                  // numbers of every friction law; none is selected here
  bool has_lattice = false;                              // true: ordered atoms
  std::vector<SourcedValue> friction_sources;            // sources of the friction numbers
};

struct MaterialLibrary {
  std::vector<MaterialEntry> materials;  // in the file's order, with unique names and valid interactions

  std::vector<std::string> names() const;  // names in the order of the files

  // Null if the name is unknown.
  const MaterialEntry* find(std::string_view name) const;

  // find(), or an error of wrong usage that lists the known names.
  core::Result<const MaterialEntry*> require(std::string_view name) const;

  // The materials with those names, in that order. Fails as require() does.
  core::Result<MaterialLibrary> only(std::span<const std::string> names) const;

  // Adds another file's materials at the end. One of a known name replaces the old one.
  void add(MaterialLibrary other);
};

// The samples of Liu & Peng, the first ones in the built-in file.
inline const std::array<std::string, 3> kPaperMaterials{"mica", "gold", "si3n4"};

// Reads a material file (TOML, assets/materials.toml; docs/manual/measure.md lists its keys). Errors that name file,
// line and key: an unreadable file, an unknown or missing key, a wrong type and an unphysical value.
core::Result<MaterialLibrary> load_materials(const std::string& path);

// Several files, each added to the previous ones.
core::Result<MaterialLibrary> load_materials(std::span<const std::string> paths);

}  // namespace afm::scene
