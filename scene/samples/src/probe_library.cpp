// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/probe_library.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <utility>

#include "named_entries.h"
#include "physics/cantilever.h"
#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

constexpr std::array<std::string_view, 20> kProbeKeys{"name",
                                                      "title",
                                                      "shape",
                                                      "tip",
                                                      "note",
                                                      "tip_radius",
                                                      "spring_constant",
                                                      "length",
                                                      "width",
                                                      "thickness",
                                                      "base_width",
                                                      "arm_width",
                                                      "lever_modulus",
                                                      "lever_density",
                                                      "tip_modulus",
                                                      "tip_poisson_ratio",
                                                      "resonance_in_air",
                                                      "resonance_in_liquid",
                                                      "quality_factor_in_air",
                                                      "quality_factor_in_liquid"};

// Reads one [[probe]].
class ProbeReader {
 public:
  explicit ProbeReader(const TomlTable& table) : table_(table), values_(table_) {}

  ProbeEntry read() {
    table_.allow_only(kProbeKeys);
    entry_.name = table_.text("name");
    entry_.title = table_.text("title");
    entry_.shape = table_.text("shape");
    entry_.tip = table_.text("tip");
    entry_.note = table_.has("note") ? table_.text("note") : "";
    if (entry_.shape != "rectangular" && entry_.shape != "v-shaped") {
      table_.refuse("shape", fmt::format("is \"{}\"; it must be \"rectangular\" or \"v-shaped\"", entry_.shape));
    }
    entry_.tip_radius = values_.quantity("tip_radius", physics::kLengthUnits);
    entry_.resonance_in_air = positive_frequency("resonance_in_air");
    entry_.resonance_in_liquid = positive_frequency("resonance_in_liquid");
    entry_.quality_factor_in_air = positive_number("quality_factor_in_air");
    entry_.quality_factor_in_liquid = positive_number("quality_factor_in_liquid");
    read_lever();
    if (table_.has("tip_modulus") || table_.has("tip_poisson_ratio")) {
      entry_.tip_elasticity = physics::Elasticity{values_.quantity("tip_modulus", physics::kPressureUnits),
                                                  values_.number("tip_poisson_ratio")};
    }
    check_physics();
    entry_.sources = values_.take_sources();
    return std::move(entry_);
  }

 private:
  physics::Length length(std::string_view key) { return values_.quantity(key, physics::kLengthUnits); }

  // The nominal spring constant, or the one computed from the geometry.
  void read_lever() {
    const bool given = table_.has("spring_constant");
    try {
      if (given) {
        read_given_lever();
      } else if (entry_.shape == "rectangular") {
        read_rectangular_lever();
      } else {
        read_v_shaped_lever();
      }
    } catch (const physics::UnphysicalValue& error) {
      const std::string& field = error.field();
      table_.refuse(field == "young_modulus" ? "lever_modulus"
                    : field == "density"     ? "lever_density"
                                             : field,
                    error.what());
    }
    if (given) return;
    values_.add_source({"spring_constant", physics::format_quantity(entry_.spring_constant, physics::kStiffnessUnits),
                        "calculated from the lever's geometry and modulus", true});
  }

  // The geometry is read for its sources alone, but must be possible.
  void read_given_lever() {
    entry_.spring_constant = values_.quantity("spring_constant", physics::kStiffnessUnits);
    for (const char* key : {"base_width", "arm_width", "lever_modulus", "lever_density"}) {
      if (table_.has(key)) table_.refuse(key, "has an effect only if no spring_constant is given");
    }
    const auto given = [&](std::string_view key) {
      return values_.optional_quantity(key, physics::kLengthUnits).value_or(physics::Length(1e-6));
    };
    const physics::Length length = given("length"), width = given("width"), thickness = given("thickness");
    physics::validate(
        physics::RectangularLever{length, width, thickness, physics::Pressure(1e11), physics::Density(1e3)});
  }

  void read_rectangular_lever() {
    const physics::RectangularLever lever{length("length"), length("width"), length("thickness"),
                                          values_.quantity("lever_modulus", physics::kPressureUnits),
                                          values_.quantity("lever_density", physics::kDensityUnits)};
    physics::validate(lever);
    entry_.spring_constant = physics::spring_constant(lever);
    if (entry_.resonance_in_air) return;
    entry_.resonance_in_air = physics::vacuum_resonance(lever);
    values_.add_source({"resonance_in_air",
                        physics::format_quantity(*entry_.resonance_in_air, physics::kFrequencyUnits),
                        "calculated from the lever's geometry, modulus and density, for vacuum", true});
  }

  void read_v_shaped_lever() {
    const physics::VShapedLever lever{length("length"), length("base_width"), length("arm_width"), length("thickness"),
                                      values_.quantity("lever_modulus", physics::kPressureUnits)};
    physics::validate(lever);
    entry_.spring_constant = physics::spring_constant(lever);
  }

  std::optional<physics::Frequency> positive_frequency(std::string_view key) {
    const auto frequency = values_.optional_quantity(key, physics::kFrequencyUnits);
    if (frequency && frequency->si <= 0.0) table_.refuse(key, "must be positive");
    return frequency;
  }

  std::optional<double> positive_number(std::string_view key) {
    if (!table_.has(key)) return std::nullopt;
    const double number = values_.number(key);
    if (number <= 0.0) table_.refuse(key, "must be positive");
    return number;
  }

  // Checks that every value is within its range, independent of the sample.
  void check_physics() const {
    constexpr physics::Elasticity kAnySample{physics::Pressure(1e9), 0.3};
    physics::ContactParameters any;
    any.tip_radius = entry_.tip_radius;
    any.spring_constant = entry_.spring_constant;
    any.sample_stiffness = physics::Stiffness(1.0);
    any.hamaker = physics::Energy(1e-20);
    any.mean_surface_energy = physics::SurfaceEnergy(1e-3);
    try {
      physics::validate(any);
      if (entry_.tip_elasticity) static_cast<void>(physics::reduced_modulus(*entry_.tip_elasticity, kAnySample));
    } catch (const physics::UnphysicalValue& error) {
      table_.refuse(error.field(), error.what());
    }
  }

  const TomlTable table_;
  SourcedValues values_;
  ProbeEntry entry_;
};

ProbeLibrary read_probes(const toml::table& root) {
  ProbeLibrary library;
  const TomlTable top(root);
  top.allow_only({"probe"});
  for (const TomlTable& table : top.tables("probe")) {
    ProbeEntry entry = ProbeReader(table).read();
    if (library.find(entry.name) != nullptr) table.refuse("name", fmt::format("\"{}\" is used twice", entry.name));
    library.probes.push_back(std::move(entry));
  }
  return library;
}

// Replaces the material's source of `key` by the probe's source of `probe_key`.
void take_source(MaterialEntry& material, std::string_view key, const ProbeEntry& probe, std::string_view probe_key) {
  const SourcedValue* found = find_source(probe.sources, probe_key);
  SourcedValue taken{std::string(key), found->value, fmt::format("{}: {}", probe.title, found->source),
                     found->estimated};
  const auto old = std::find_if(material.sources.begin(), material.sources.end(),
                                [&](const SourcedValue& s) { return s.key == key; });
  if (old != material.sources.end()) {
    *old = std::move(taken);
  } else {
    material.sources.push_back(std::move(taken));
  }
}

}  // namespace

const ProbeEntry* ProbeLibrary::find(std::string_view name) const { return find_named(probes, name); }

core::Result<const ProbeEntry*> ProbeLibrary::require(std::string_view name) const {
  return require_named(probes, "probe", name);
}

void ProbeLibrary::add(ProbeLibrary other) { add_named(probes, std::move(other.probes)); }

core::Result<ProbeLibrary> load_probes(const std::string& path) { return read_toml("probe file", path, read_probes); }

core::Result<ProbeLibrary> load_probes(std::span<const std::string> paths) {
  ProbeLibrary library;
  for (const std::string& path : paths) {
    auto loaded = load_probes(path);
    if (!loaded) return loaded;
    library.add(std::move(*loaded));
  }
  return library;
}

MaterialEntry with_probe(MaterialEntry material, const ProbeEntry& probe) {
  material.contact.tip_radius = probe.tip_radius;
  material.contact.spring_constant = probe.spring_constant;
  take_source(material, "tip_radius", probe, "tip_radius");
  take_source(material, "spring_constant", probe, "spring_constant");

  if (probe.tip_elasticity && material.sample_elasticity) {
    material.tip_elasticity = probe.tip_elasticity;
    material.contact.reduced_modulus = physics::reduced_modulus(*probe.tip_elasticity, *material.sample_elasticity);
    take_source(material, "tip_modulus", probe, "tip_modulus");
    take_source(material, "tip_poisson_ratio", probe, "tip_poisson_ratio");
  }

  const bool air = material.medium == "air";
  if (const auto& resonance = air ? probe.resonance_in_air : probe.resonance_in_liquid) {
    material.lever.resonance = *resonance;
    take_source(material, "resonance", probe, air ? "resonance_in_air" : "resonance_in_liquid");
  }
  if (const auto& quality = air ? probe.quality_factor_in_air : probe.quality_factor_in_liquid) {
    material.lever.quality_factor = *quality;
    take_source(material, "quality_factor", probe, air ? "quality_factor_in_air" : "quality_factor_in_liquid");
  }

  const bool pair_is_known = find_source(material.sources, "hamaker") != nullptr;
  if (pair_is_known && material.tip != probe.tip) {
    material.note +=
        fmt::format("{}The Hamaker constant and the work of adhesion are those of a {} tip; the probe's tip is {}.",
                    material.note.empty() ? "" : " ", material.tip, probe.tip);
  }
  material.tip = probe.tip;
  return material;
}

}  // namespace afm::scene
