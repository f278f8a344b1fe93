// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>

#include "app/options/command.h"
#include "app/options/contact_options.h"
#include "app/options/standard_output.h"
#include "core/whole_file.h"
#include "curves/adhesion_map_plot.h"
#include "physics/law_tables.h"
#include "physics/quantity_text.h"

namespace afm::app {
namespace {

template <class Q>
std::string text_of(Q value, const physics::UnitList<Q>& units) {
  return std::isinf(value.si) ? "infinite" : physics::format_quantity(value, units, 4);
}

std::string in_words(const std::string& key) {
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string sources_text(std::span<const scene::SourcedValue> sources) {
  std::string text;
  for (const scene::SourcedValue& source : sources) {
    text += fmt::format("  {:<22}{:<14}{}{}\n", in_words(source.key), source.value, source.source,
                        source.estimated ? " (estimated)" : "");
  }
  return text;
}

std::string cycle_text(const physics::CycleFigures& figures) {
  using namespace physics;
  std::string text;
  if (figures.hysteretic) {
    text += fmt::format("  snap-in               at {}: {} before, {} after\n", text_of(figures.z_jtc, kLengthUnits),
                        text_of(figures.force_before_jtc, kForceUnits), text_of(figures.force_after_jtc, kForceUnits));
    text += fmt::format("  pull-off              at {}: {}\n", text_of(figures.z_joc, kLengthUnits),
                        text_of(figures.force_before_joc, kForceUnits));
  } else {
    text += "  no jumps              the lever is so stiff that approach and retract coincide\n";
  }
  text += fmt::format("  loop energy           {}\n", text_of(figures.loop_energy, kEnergyUnits));
  text += std::isinf(figures.critical_stiffness.si)
              ? std::string("  hysteresis            with a lever of any stiffness\n")
              : fmt::format("  hysteresis            vanishes at and above k_c = {}\n",
                            text_of(figures.critical_stiffness, kStiffnessUnits));
  return text;
}

core::Result<std::shared_ptr<const physics::LawTables>> tables_of(const curves::ContactSetup& setup) {
  try {
    return physics::build_law_tables(setup.law(), setup.material.contact, setup.law_options);
  } catch (const std::invalid_argument& error) {
    return core::failure(core::ErrorCategory::WrongUsage, error.what());
  }
}

// One line for every known material and probe, with its main values.
core::Result<std::string> material_list(const curves::ContactOptions& options) {
  const auto materials = load_materials(options);
  if (!materials) return tl::unexpected(materials.error());
  const auto probes = load_probes(options);
  if (!probes) return tl::unexpected(probes.error());
  std::string text = "materials (touchafm material NAME prints each value with its source)\n";
  for (const scene::MaterialEntry& m : materials->materials) {
    const auto place = physics::choose_law(m.contact);
    text += fmt::format("  {:<20}{:<18}{:<9}in {:<15}W {:<13}E* {:<12}Tabor {:<10.3g}{}\n", m.name, m.title, m.tip,
                        m.medium, text_of(2.0 * m.contact.mean_surface_energy, physics::kSurfaceEnergyUnits),
                        text_of(m.contact.reduced_modulus, physics::kPressureUnits), place.tabor,
                        physics::name_of(place.law));
  }
  text += "probes (--probe NAME; nominal values)\n";
  for (const scene::ProbeEntry& p : probes->probes) {
    const auto& resonance = p.resonance_in_air;
    text +=
        fmt::format("  {:<20}k_c {:<11}R {:<8}{:<11}{}\n", p.name, text_of(p.spring_constant, physics::kStiffnessUnits),
                    text_of(p.tip_radius, physics::kLengthUnits),
                    resonance ? text_of(*resonance, physics::kFrequencyUnits) : "", p.title);
  }
  return text;
}

// Describes one contact: each value with its source, its position on the adhesion map, the law and why it was chosen,
// and the figures of a cycle.
core::Result<std::string> material_text(const curves::ContactSetup& setup) {
  const auto tables = tables_of(setup);
  if (!tables) return tl::unexpected(tables.error());
  const scene::MaterialEntry& material = setup.material;
  std::string text = fmt::format("{}: {} tip, in {}\n", material.title, material.tip, material.medium);
  if (!material.note.empty()) text += material.note + "\n";
  text += "\nvalues and their sources\n" + sources_text(material.sources);
  if (material.tip_elasticity) {
    text += fmt::format("  {:<22}{:<14}from tip and sample: 1/E* = (1 - nu_t^2)/E_t + (1 - nu_s^2)/E_s\n",
                        "reduced modulus", text_of(material.contact.reduced_modulus, physics::kPressureUnits));
  }
  text += "\nfriction (--friction of demo and view) and its sources\n" + sources_text(material.friction_sources);
  text += material.has_lattice
              ? fmt::format("  {:<22}{}\n", "lattice",
                            physics::kLatticeKinds.at(static_cast<std::size_t>(material.friction.lattice)).word)
              : fmt::format("  {:<22}none: --friction lattice rubs by the load instead\n", "lattice");
  if (const auto place = setup.place()) {
    text += fmt::format(
        "\nposition on the adhesion map\n"
        "  Tabor parameter       {:.4g}\n"
        "  Maugis parameter      {:.4g}\n",
        place->tabor, place->maugis);
    text += fmt::format("  regime                {}\n  {}\n", physics::name_of(place->regime), place->reason);
  }
  text += fmt::format(
      "\none cycle with the model {}{}\n"
      "{}",
      setup.used_model(), setup.model.automatic ? ", chosen by the Tabor parameter" : "",
      cycle_text((*tables)->figures));
  return text;
}

// The adhesion map with the contact on it, as SVG.
core::Result<std::string> material_map(const curves::ContactSetup& setup) {
  const auto tables = tables_of(setup);
  if (!tables) return tl::unexpected(tables.error());
  const auto place = setup.place();
  if (!place) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         "cannot place a contact without work of adhesion on the map; give --work-of-adhesion");
  }
  const std::string title =
      fmt::format("Adhesion map: {}, {} tip, in {}", setup.material.title, setup.material.tip, setup.material.medium);
  return curves::svg(
      curves::adhesion_map_plot(title, *place, setup.material.contact, (*tables)->figures.force_before_joc));
}

struct MaterialOptions {
  curves::ContactOptions contact;
  std::string map;  // SVG file, or empty
};

core::Result<void> print_material(const MaterialOptions& options) {
  if (options.contact.material.empty()) {
    if (!options.map.empty()) {
      return core::failure(core::ErrorCategory::WrongUsage, "--map needs a material; name one");
    }
    const auto list = material_list(options.contact);
    if (!list) return tl::unexpected(list.error());
    return write_report(*list);
  }
  const auto setup = contact_setup(options.contact);
  if (!setup) return tl::unexpected(setup.error());
  const auto text = material_text(*setup);
  if (!text) return tl::unexpected(text.error());
  if (!options.map.empty()) {
    const auto map = material_map(*setup);
    if (!map) return tl::unexpected(map.error());
    if (const auto written = core::write_file(options.map, *map); !written) return written;
  }
  return write_report(*text);
}

}  // namespace

void add_material_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "material", "print a material's properties with their sources and the law that suits it; or list all materials");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<MaterialOptions>();
  command.add_option("name", options->contact.material, "name of a material; default: list all materials and probes")
      .type_name("MATERIAL");
  add_contact_options(command, options->contact, context);
  command.add_option("--map", options->map, "write the adhesion map, with this contact marked, as SVG")
      .picture_file(".svg")
      .type_name("FILE");
  command.footer(
      "Each parameter overrides that of the material or the probe.\n"
      "example: touchafm material gold --tip-radius 20nm --map map.svg");
  command.when_chosen([options] { return print_material(*options); });
}

}  // namespace afm::app
