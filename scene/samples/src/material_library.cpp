// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/material_library.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "named_entries.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "scene/shared/shared_blocks.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

constexpr std::array<std::string_view, 29> kMaterialKeys{"name",
                                                         "title",
                                                         "tip",
                                                         "medium",
                                                         "note",
                                                         "look",
                                                         "tip_radius",
                                                         "spring_constant",
                                                         "hamaker",
                                                         "sample_stiffness",
                                                         "atomic_distance",
                                                         "mean_surface_energy",
                                                         "work_of_adhesion",
                                                         "reduced_modulus",
                                                         "tip_modulus",
                                                         "tip_poisson_ratio",
                                                         "sample_modulus",
                                                         "sample_poisson_ratio",
                                                         "resonance",
                                                         "quality_factor",
                                                         "temperature",
                                                         "experiment_f_attr",
                                                         "experiment_f_ad",
                                                         "friction_coefficient",
                                                         "shear_strength",
                                                         "lateral_stiffness",
                                                         "lattice",
                                                         "lattice_period",
                                                         "lattice_corrugation"};

// Reads one [[material]].
class MaterialReader {
 public:
  explicit MaterialReader(const TomlTable& table) : table_(table), values_(table_) {}

  MaterialEntry read() {
    table_.allow_only(kMaterialKeys);
    entry_.name = table_.text("name");
    entry_.title = table_.text("title");
    entry_.tip = table_.text("tip");
    entry_.medium = table_.text("medium");
    entry_.note = table_.has("note") ? table_.text("note") : "";
    entry_.look = table_.has("look") ? table_.text("look") : entry_.name;
    if (entry_.name.size() >= kNameLength) {
      table_.refuse("name", fmt::format("is longer than {} bytes", kNameLength - 1));
    }
    // the name is a cell of the tables of lessons
    if (!entry_.name.empty() && std::string_view("=+-@").find(entry_.name.front()) != std::string_view::npos) {
      table_.refuse(
          "name",
          fmt::format("\"{}\" begins like a formula of a spreadsheet or an option; begin with a letter or a digit",
                      entry_.name));
    }

    physics::ContactParameters& contact = entry_.contact;
    contact.tip_radius = values_.quantity("tip_radius", physics::kLengthUnits);
    contact.spring_constant = values_.quantity("spring_constant", physics::kStiffnessUnits);
    contact.sample_stiffness =
        values_.quantity("sample_stiffness", physics::kStiffnessUnits, physics::Infinity::Allowed);
    contact.hamaker = values_.quantity("hamaker", physics::kEnergyUnits);
    read_adhesion();
    read_elasticity();
    read_atomic_distance();
    read_dynamics();
    entry_.experiment_f_attr = magnitude("experiment_f_attr");
    entry_.experiment_f_ad = magnitude("experiment_f_ad");
    check_physics();
    entry_.sources = values_.take_sources();
    read_friction();
    entry_.friction_sources = values_.take_sources();
    return std::move(entry_);
  }

 private:
  void read_adhesion() {
    if (table_.has("mean_surface_energy") == table_.has("work_of_adhesion")) {
      table_.refuse("mean_surface_energy",
                    table_.has("work_of_adhesion")
                        ? "is given together with work_of_adhesion; give one or the other, not both"
                        : "is missing; give this value or work_of_adhesion, which is twice as large");
    }
    physics::SurfaceEnergy& mean = entry_.contact.mean_surface_energy;
    if (table_.has("mean_surface_energy")) {
      mean = values_.quantity("mean_surface_energy", physics::kSurfaceEnergyUnits);
    } else {
      mean = 0.5 * values_.quantity("work_of_adhesion", physics::kSurfaceEnergyUnits);  // (3.3)
    }
  }

  // Both bodies' moduli, or E*, or neither: rigid.
  void read_elasticity() {
    constexpr std::array<const char*, 4> kBodies{"tip_modulus", "tip_poisson_ratio", "sample_modulus",
                                                 "sample_poisson_ratio"};
    const auto given = std::count_if(kBodies.begin(), kBodies.end(), [&](const char* key) { return table_.has(key); });
    if (table_.has("reduced_modulus")) {
      if (given > 0)
        table_.refuse("reduced_modulus", "is given together with the moduli of tip and sample; give one or the other");
      entry_.contact.reduced_modulus = values_.quantity("reduced_modulus", physics::kPressureUnits);
      return;
    }
    if (given == 0) return;
    const physics::Elasticity tip{values_.quantity("tip_modulus", physics::kPressureUnits),
                                  values_.number("tip_poisson_ratio")};
    const physics::Elasticity sample{values_.quantity("sample_modulus", physics::kPressureUnits),
                                     values_.number("sample_poisson_ratio")};
    entry_.tip_elasticity = tip;
    entry_.sample_elasticity = sample;
    try {
      entry_.contact.reduced_modulus = physics::reduced_modulus(tip, sample);
    } catch (const physics::UnphysicalValue& error) {
      table_.refuse(error.field(), error.what());
    }
  }

  void read_atomic_distance() {
    if (table_.has("atomic_distance")) {
      entry_.contact.atomic_distance = values_.quantity("atomic_distance", physics::kLengthUnits);
      return;
    }
    values_.add_source({"atomic_distance",
                        physics::format_quantity(entry_.contact.atomic_distance, physics::kLengthUnits),
                        "default: z0 of most solids lies within 0.2 nm to 0.4 nm", true});
  }

  void read_dynamics() {
    constexpr const char* kDefault = "default: a soft lever in a liquid";
    physics::LeverDynamics& lever = entry_.lever;
    lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.15)};
    if (table_.has("resonance")) {
      lever.resonance = values_.quantity("resonance", physics::kFrequencyUnits);
    } else {
      values_.add_source({"resonance", "12 kHz", kDefault, true});
    }
    if (table_.has("quality_factor")) {
      lever.quality_factor = values_.number("quality_factor");
    } else {
      values_.add_source({"quality_factor", "2.5", kDefault, true});
    }
    if (table_.has("temperature")) {
      lever.temperature = values_.quantity("temperature", physics::kTemperatureUnits);
    } else {
      values_.add_source({"temperature", "298.15 K", "default: 25 degrees Celsius", true});
    }
  }

  void read_friction() {
    physics::FrictionParameters& friction = entry_.friction;
    friction.coefficient = 0.1;
    if (table_.has("friction_coefficient")) {
      friction.coefficient = values_.number("friction_coefficient");
    } else {
      values_.add_source({"friction_coefficient", "0.1", "default: most pairs lie within 0.01 to 0.5", true});
    }
    friction.shear_strength = read_or("shear_strength", physics::kPressureUnits, physics::Pressure(1e8),
                                      "default: 10 MPa to 1 GPa have been measured");
    friction.lateral_stiffness = read_or("lateral_stiffness", physics::kStiffnessUnits, physics::Stiffness(1.0),
                                         "default: tip and contact give way at some 1 N/m, far softer than the lever");
    entry_.has_lattice = table_.has("lattice");
    for (const char* key : {"lattice_period", "lattice_corrugation"}) {
      if (table_.has(key) != entry_.has_lattice) {
        table_.refuse(key, entry_.has_lattice ? "is missing; lattice needs it" : "needs lattice = \"hexagonal\"");
      }
    }
    if (entry_.has_lattice) read_lattice();
    check_friction();
  }

  void read_lattice() {
    entry_.friction.lattice = table_.one_of("lattice", physics::kLatticeKinds, &physics::LatticeKindText::word).kind;
    entry_.friction.period = values_.quantity("lattice_period", physics::kLengthUnits);
    entry_.friction.corrugation = values_.quantity("lattice_corrugation", physics::kLengthUnits);
  }

  // Checks every friction law for which the material has the numbers.
  void check_friction() const {
    for (const physics::FrictionLawText& row : physics::kFrictionLaws) {
      if (row.law == physics::FrictionLaw::Lattice && !entry_.has_lattice) continue;
      physics::FrictionParameters friction = entry_.friction;
      friction.law = row.law;
      try {
        physics::validate(friction);
      } catch (const physics::UnphysicalValue& error) {
        table_.refuse(error.field(), error.what());
      }
    }
  }

  template <class Q>
  Q read_or(std::string_view key, const physics::UnitList<Q>& units, Q usual, const char* why) {
    if (table_.has(key)) return values_.quantity(key, units);
    values_.add_source({std::string(key), physics::format_quantity(usual, units), why, true});
    return usual;
  }

  std::optional<physics::Force> magnitude(std::string_view key) {
    const auto force = values_.optional_quantity(key, physics::kForceUnits);
    if (force && *force <= physics::Force()) {
      table_.refuse(key, fmt::format("is {}; it must be a positive magnitude",
                                     physics::format_quantity(*force, physics::kForceUnits)));
    }
    return force;
  }

  void check_physics() const {
    try {
      physics::validate(entry_.contact);
      physics::validate(entry_.lever);
    } catch (const physics::UnphysicalValue& error) {
      const bool by_work = error.field() == "mean_surface_energy" && table_.has("work_of_adhesion");
      table_.refuse(by_work ? "work_of_adhesion" : error.field(), error.what());
    }
  }

  const TomlTable table_;
  SourcedValues values_;
  MaterialEntry entry_;
};

MaterialLibrary read_materials(const toml::table& root) {
  MaterialLibrary library;
  const TomlTable top(root);
  top.allow_only({"material"});
  for (const TomlTable& table : top.tables("material")) {
    MaterialEntry entry = MaterialReader(table).read();
    if (library.find(entry.name) != nullptr) table.refuse("name", fmt::format("\"{}\" is used twice", entry.name));
    library.materials.push_back(std::move(entry));
  }
  return library;
}

}  // namespace

std::vector<std::string> MaterialLibrary::names() const {
  std::vector<std::string> all(materials.size());
  std::transform(materials.begin(), materials.end(), all.begin(), [](const MaterialEntry& m) { return m.name; });
  return all;
}

const MaterialEntry* MaterialLibrary::find(std::string_view name) const { return find_named(materials, name); }

core::Result<const MaterialEntry*> MaterialLibrary::require(std::string_view name) const {
  return require_named(materials, "material", name);
}

core::Result<MaterialLibrary> MaterialLibrary::only(std::span<const std::string> names) const {
  MaterialLibrary chosen;
  for (const std::string& name : names) {
    const auto entry = require(name);
    if (!entry) return tl::unexpected(entry.error());
    chosen.materials.push_back(**entry);
  }
  return chosen;
}

void MaterialLibrary::add(MaterialLibrary other) { add_named(materials, std::move(other.materials)); }

core::Result<MaterialLibrary> load_materials(const std::string& path) {
  return read_toml("material file", path, read_materials);
}

core::Result<MaterialLibrary> load_materials(std::span<const std::string> paths) {
  MaterialLibrary library;
  for (const std::string& path : paths) {
    auto loaded = load_materials(path);
    if (!loaded) return loaded;
    library.add(std::move(*loaded));
  }
  return library;
}

}  // namespace afm::scene
