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

// A lever with its tip, as in a catalogue.
struct ProbeEntry {
  std::string name;   // name in commands
  std::string title;  // name for display
  std::string shape;  // "rectangular" or "v-shaped"
  std::string tip;    // material of the tip
  std::string note;   // remark about the probe; may be empty
  physics::Length tip_radius;
  physics::Stiffness spring_constant;  // nominal value, or computed from the geometry
  std::optional<physics::Elasticity> tip_elasticity;
  std::optional<physics::Frequency> resonance_in_air, resonance_in_liquid;
  std::optional<double> quality_factor_in_air, quality_factor_in_liquid;
  std::vector<SourcedValue> sources;
};

struct ProbeLibrary {
  std::vector<ProbeEntry> probes;  // probes in the order of the files, with unique names

  // Null if the name is unknown.
  const ProbeEntry* find(std::string_view name) const;

  // find(), or an error of wrong usage that lists the known names.
  core::Result<const ProbeEntry*> require(std::string_view name) const;

  // Adds another file's probes at the end. One of a known name replaces the old one.
  void add(ProbeLibrary other);
};

// Reads a probe file (TOML, assets/probes.toml; docs/manual/measure.md lists its keys). A missing spring constant is
// computed from the geometry (physics/cantilever.h), as is a missing resonance of a rectangular lever. Fails as
// load_materials() does.
core::Result<ProbeLibrary> load_probes(const std::string& path);

// Several files, each added to the previous ones.
core::Result<ProbeLibrary> load_probes(std::span<const std::string> paths);

// The same sample and medium with another lever and tip: radius, spring constant, and, if the probe has them, the tip's
// modulus and the resonance and quality factor in the medium ("air", or a liquid). The Hamaker constant and the work of
// adhesion do not change, because they belong to the pair; if the tip is of another material, the note says so.
MaterialEntry with_probe(MaterialEntry material, const ProbeEntry& probe);

}  // namespace afm::scene
