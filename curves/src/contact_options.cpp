// SPDX-License-Identifier: Apache-2.0
#include "curves/contact_options.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace afm::curves {
namespace {

using core::wrong_usage;

std::vector<std::string> with_built_in(const std::string& built_in, const std::vector<std::string>& own) {
  std::vector<std::string> files{built_in};
  files.insert(files.end(), own.begin(), own.end());
  return files;
}

// A contact without known values. Hamaker constant and surface energy are placeholders for laws without these forces,
// which never read them.
scene::MaterialEntry nameless_material() {
  scene::MaterialEntry entry;
  entry.name = ContactSetup::kNoMaterial;
  entry.title = "Contact given by numbers";
  entry.tip = entry.medium = "not named";
  entry.contact.sample_stiffness = physics::Stiffness(std::numeric_limits<double>::infinity());
  entry.contact.hamaker = physics::Energy(1e-20);
  entry.contact.mean_surface_energy = physics::SurfaceEnergy(1e-9);
  entry.lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.15)};
  entry.sources = {{"sample_stiffness", "inf N/m", "default: a sample on a rigid support", false},
                   {"atomic_distance", "0.3 nm", "default: z0 of most solids lies within 0.2 nm to 0.4 nm", true},
                   {"resonance", "12 kHz", "default: a soft lever in a liquid", true},
                   {"quality_factor", "2.5", "default: a soft lever in a liquid", true},
                   {"temperature", "298.15 K", "default: 25 degrees Celsius", true}};
  return entry;
}

// Options that a model needs.
std::vector<const char*> needed_options(const ModelName& model) {
  std::vector<const char*> needed{"tip-radius", "spring-constant"};
  const physics::LawTraits& law = physics::traits_of(model.law);
  if (model.automatic || law.van_der_waals) needed.push_back("hamaker");
  if (model.automatic || law.adhesion) needed.push_back("work-of-adhesion");
  if (model.automatic || law.modulus == physics::ModulusUse::Needed) needed.push_back("reduced-modulus");
  return needed;
}

bool is_given(const ContactOptions& options, std::string_view option) {
  const auto typed = options.values.find(option);
  return options.si_values.contains(option) || (typed != options.values.end() && !typed->second.empty());
}

core::Result<void> require_numbers(const ContactOptions& options, const ModelName& model) {
  std::string missing;
  for (const char* option : needed_options(model)) {
    const bool by_probe = !options.probe.empty() &&
                          (option == std::string_view("tip-radius") || option == std::string_view("spring-constant"));
    if (by_probe || is_given(options, option)) continue;
    missing += fmt::format("{}--{}", missing.empty() ? "" : ", ", option);
  }
  if (missing.empty()) return {};
  return wrong_usage(fmt::format("model {} without --material also needs {}; a material supplies them: --material gold",
                                 model.text, missing));
}

core::Result<scene::MaterialEntry> base_material(const ContactOptions& options, const ModelName& model) {
  if (options.material.empty()) {
    if (const auto complete = require_numbers(options, model); !complete) return tl::unexpected(complete.error());
    return nameless_material();
  }
  const auto library = load_materials(options);
  if (!library) return tl::unexpected(library.error());
  const auto found = library->require(options.material);
  if (!found) return tl::unexpected(found.error());
  return **found;
}

core::Result<void> apply_values(const ContactOptions& options, ContactSetup& setup) {
  for (const ContactParameter& parameter : contact_parameters()) {
    if (!is_given(options, parameter.option)) continue;
    if (!changes_force(parameter, setup.model)) {
      return wrong_usage(fmt::format("--{} has no effect on model {}; remove it", parameter.option, setup.model.text));
    }
    if (const auto si = options.si_values.find(parameter.option); si != options.si_values.end()) {
      override_parameter(setup, parameter, si->second, format_parameter(parameter, si->second), "given by a program");
      continue;
    }
    const std::string& text = options.values.find(parameter.option)->second;
    const auto value = parse_parameter(parameter, text);
    if (!value) return tl::unexpected(value.error());
    override_parameter(setup, parameter, *value, text, fmt::format("--{} on the command line", parameter.option));
  }
  if (options.exact_sphere) {
    if (!acts(*find_contact_parameter("retardation"), setup.model)) {
      return wrong_usage(fmt::format("--exact-sphere has no effect on model {}; remove it", setup.model.text));
    }
    setup.law_options.exact_hamaker_sphere = true;
  }
  return {};
}

}  // namespace

core::Result<scene::MaterialLibrary> load_materials(const ContactOptions& options) {
  return scene::load_materials(with_built_in(options.assets_dir + "/materials.toml", options.material_files));
}

core::Result<scene::ProbeLibrary> load_probes(const ContactOptions& options) {
  return scene::load_probes(with_built_in(options.assets_dir + "/probes.toml", options.probe_files));
}

core::Result<ContactSetup> contact_setup(const ContactOptions& options) {
  auto model = ModelName::parse(options.model);
  if (!model) {
    return wrong_usage(fmt::format("unknown model \"{}\"; choose {}", options.model, known_models(ModelUse::Curve)));
  }
  model->driven = options.driven;
  const auto material = base_material(options, *model);
  if (!material) return tl::unexpected(material.error());
  ContactSetup setup{*material, {}, *model};
  if (!options.probe.empty()) {
    const auto probes = load_probes(options);
    if (!probes) return tl::unexpected(probes.error());
    const auto probe = probes->require(options.probe);
    if (!probe) return tl::unexpected(probe.error());
    setup.material = scene::with_probe(std::move(setup.material), **probe);
  }
  if (const auto applied = apply_values(options, setup); !applied) return tl::unexpected(applied.error());
  return setup;
}

}  // namespace afm::curves
