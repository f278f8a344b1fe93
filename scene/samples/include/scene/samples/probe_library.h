// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/elasticity.h"
#include "physics/units.h"
#include "scene/samples/material_library.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {

// A lever with its tip, as a catalogue lists it.
struct ProbeEntry {
  std::string name;   // name in commands
  std::string title;  // name for display
  std::string shape;  // "rectangular" or "v-shaped"
  std::string tip;    // material of the tip
  std::string note;   // may be empty
  physics::Length tip_radius;
  physics::Stiffness spring_constant;  // nominal, or of the geometry
  std::optional<physics::Elasticity> tip_elasticity;
  std::optional<physics::Frequency> resonance_in_air, resonance_in_liquid;
  std::optional<double> quality_factor_in_air, quality_factor_in_liquid;
  std::vector<SourcedValue> sources;
};

struct ProbeLibrary {
  std::vector<ProbeEntry> probes;  // in the file's order, names unique

  // Null if there is none.
  const ProbeEntry* find(std::string_view name) const;

  // find(), or an error of wrong usage that lists the known names.
  core::Result<const ProbeEntry*> require(std::string_view name) const;

  // Adds another file's probes behind; one of a known name takes the place of the old one.
  void add(ProbeLibrary other);
};

// Reads a probe file (TOML, assets/probes.toml; docs/manual.md has its keys). A spring constant that is not given is
// that of the geometry (physics/cantilever.h), and so is a rectangular lever's resonance. Errors as load_materials()
// has them.
core::Result<ProbeLibrary> load_probes(const std::string& path);

// Several files, the later ones added to the first.
core::Result<ProbeLibrary> load_probes(std::span<const std::string> paths);

// The same sample and medium under another lever and tip: radius, spring constant, and where the probe has them the
// tip's modulus and the resonance and quality factor in the medium ("air", or a liquid). The Hamaker constant and the
// work of adhesion stay, since no probe knows them for the pair; the note says so where the tip is of another material.
MaterialEntry with_probe(MaterialEntry material, const ProbeEntry& probe);

}  // namespace afm::scene
