// SPDX-License-Identifier: Apache-2.0
#include "curves/contact_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace afm::curves {
namespace {

using physics::Law;
using physics::LawTraits;

constexpr std::string_view kDynamicPrefix = "dynamic-";

constexpr std::array<physics::Unit, 1> kPercent{physics::Unit{"%", 1e2, true}};

constexpr std::array<std::string_view, 1> kTipRadius{"tip_radius"};
constexpr std::array<std::string_view, 1> kSpringConstant{"spring_constant"};
constexpr std::array<std::string_view, 1> kSampleStiffness{"sample_stiffness"};
constexpr std::array<std::string_view, 1> kHamaker{"hamaker"};
constexpr std::array<std::string_view, 2> kWorkOfAdhesion{"work_of_adhesion", "mean_surface_energy"};
constexpr std::array<std::string_view, 5> kReducedModulus{"reduced_modulus", "tip_modulus", "tip_poisson_ratio",
                                                          "sample_modulus", "sample_poisson_ratio"};
constexpr std::array<std::string_view, 1> kAtomicDistance{"atomic_distance"};
constexpr std::array<std::string_view, 1> kRetardation{"retardation"};
constexpr std::array<std::string_view, 1> kHumidity{"humidity"};
constexpr std::array<std::string_view, 1> kResonance{"resonance"};
constexpr std::array<std::string_view, 1> kQualityFactor{"quality_factor"};
constexpr std::array<std::string_view, 1> kTemperature{"temperature"};

using Number = std::optional<double>;

// Row for a parameter with units.
ContactParameter row(std::string_view option, std::string_view json_key, std::span<const std::string_view> keys,
                     std::string help, const physics::Units& units, Number (*get)(const ContactSetup&),
                     void (*set)(ContactSetup&, double), physics::Infinity infinity = physics::Infinity::Refused) {
  return {option, json_key, keys, std::move(help), units.sort, units.units, infinity, get, set};
}

std::string help_of(std::string_view meaning, const std::string& range, const physics::Units& units) {
  return fmt::format("{}, {}; units: {}", meaning, range, physics::list_units(units.units));
}

// Title of an option: "tip radius".
std::string title_of(std::string_view option) {
  if (option == "hamaker") return "Hamaker constant";
  std::string title(option);
  std::replace(title.begin(), title.end(), '-', ' ');
  return title;
}

using physics::ContactParameters;

// Row for a member of ContactParameters.
template <auto Member>
ContactParameter row(std::string_view option, std::span<const std::string_view> keys,
                     const physics::ContactField& field) {
  return row(
      option, field.json_key, keys,
      help_of(fmt::format("{} {}", title_of(option), field.meaning), field.range(), *field.units), *field.units,
      [](const ContactSetup& s) { return Number((s.material.contact.*Member).si); },
      [](ContactSetup& s, double si) { (s.material.contact.*Member).si = si; },
      field.largest < std::numeric_limits<double>::infinity() ? physics::Infinity::Refused
                                                              : physics::Infinity::Allowed);
}

// Row of the work of adhesion W, which is twice the laws' surface energy (3.3).
ContactParameter work_of_adhesion() {
  constexpr const physics::ContactField& kMean = physics::contact_field("mean_surface_energy");
  return row(
      "work-of-adhesion", "work_of_adhesion_J_per_m2", kWorkOfAdhesion,
      help_of("work of adhesion W = 2 sqrt(gamma_s gamma_t)",
              physics::range_text(2.0 * kMean.smallest, 2.0 * kMean.largest, *kMean.units), *kMean.units),
      *kMean.units,
      [](const ContactSetup& s) {
        return s.has_work_of_adhesion() ? Number(2.0 * s.material.contact.mean_surface_energy.si) : Number();
      },
      [](ContactSetup& s, double si) { s.material.contact.mean_surface_energy = physics::SurfaceEnergy(0.5 * si); });
}

// Row of E*; a given value replaces the moduli of the two bodies.
ContactParameter reduced_modulus() {
  ContactParameter parameter = row<&ContactParameters::reduced_modulus>("reduced-modulus", kReducedModulus,
                                                                        physics::contact_field("reduced_modulus"));
  parameter.set = [](ContactSetup& s, double si) {
    s.material.contact.reduced_modulus = physics::Pressure(si);
    s.material.tip_elasticity.reset();
    s.material.sample_elasticity.reset();
  };
  return parameter;
}

std::array<ContactParameter, 12> make_parameters() {
  using namespace physics;
  using Setup = ContactSetup;
  return {
      row<&ContactParameters::tip_radius>("tip-radius", kTipRadius, contact_field("tip_radius")),
      row<&ContactParameters::spring_constant>("spring-constant", kSpringConstant, contact_field("spring_constant")),
      row<&ContactParameters::sample_stiffness>("sample-stiffness", kSampleStiffness,
                                                contact_field("sample_stiffness")),
      row<&ContactParameters::hamaker>("hamaker", kHamaker, contact_field("hamaker")),
      work_of_adhesion(),
      reduced_modulus(),
      row<&ContactParameters::atomic_distance>("atomic-distance", kAtomicDistance, contact_field("atomic_distance")),
      row(
          "retardation", "retardation_wavelength_m", kRetardation,
          "retardation wavelength of the van der Waals force, about 100nm; default: no retardation", kLengthUnits,
          [](const Setup& s) {
            const auto& wavelength = s.law_options.retardation_wavelength;
            return wavelength ? Number(wavelength->si) : Number();
          },
          [](Setup& s, double si) { s.law_options.retardation_wavelength = Length(si); }),
      {"humidity", "relative_humidity", kHumidity,
       "relative humidity of the air, which forms a water meniscus, 1% to 99%; default: no meniscus", "a humidity",
       kPercent, Infinity::Refused,
       [](const Setup& s) {
         const auto& meniscus = s.law_options.meniscus;
         return meniscus ? Number(meniscus->relative_humidity) : Number();
       },
       [](Setup& s, double si) {
         if (!s.law_options.meniscus) s.law_options.meniscus.emplace();
         s.law_options.meniscus->relative_humidity = si;
       }},
      row(
          "resonance", "resonance_Hz", kResonance,
          "resonance frequency f0 of the lever in the medium, 1Hz to 100MHz; units: MHz, kHz, Hz", kFrequencyUnits,
          [](const Setup& s) { return Number(s.material.lever.resonance.si); },
          [](Setup& s, double si) { s.material.lever.resonance = Frequency(si); }),
      {"quality-factor",
       "quality_factor",
       kQualityFactor,
       "quality factor Q of the lever in the medium, a plain number from 0.01 to 1e7",
       "a quality factor",
       {},
       Infinity::Refused,
       [](const Setup& s) { return Number(s.material.lever.quality_factor); },
       [](Setup& s, double si) { s.material.lever.quality_factor = si; }},
      row(
          "temperature", "temperature_K", kTemperature, "temperature of the thermal noise, 0K (no noise) to 2000K",
          kTemperatureUnits, [](const Setup& s) { return Number(s.material.lever.temperature.si); },
          [](Setup& s, double si) { s.material.lever.temperature = Temperature(si); })};
}

}  // namespace

std::optional<ModelName> ModelName::parse(std::string_view text) {
  ModelName name;
  name.text = text;
  if (text == "auto") {
    name.automatic = true;
    return name;
  }
  if (text == "paper-rule") {
    name.direction_rule = true;
    return name;
  }
  name.dynamic = text.starts_with(kDynamicPrefix);
  if (name.dynamic) text.remove_prefix(kDynamicPrefix.size());
  const auto law = physics::law_of(text);
  if (!law || !physics::traits_of(*law).computed) return std::nullopt;
  if (name.dynamic && !physics::has_dynamics(*law)) return std::nullopt;
  name.law = *law;
  return name;
}

std::string known_models(ModelUse use) {
  std::string text = use == ModelUse::Curve ? "auto, paper-rule" : "auto";
  for (const Law law : physics::laws_with(&LawTraits::computed)) {
    if (use == ModelUse::Tapped && !physics::has_averaged_swings(law)) continue;
    text += fmt::format(", {}", physics::name_of(law));
  }
  if (use == ModelUse::Tapped) return text;
  for (const Law law : physics::laws_with(&LawTraits::dynamic)) {
    text += fmt::format(", {}{}", kDynamicPrefix, physics::name_of(law));
  }
  return text;
}

bool ContactSetup::has_work_of_adhesion() const {
  return scene::find_source(material.sources, "work_of_adhesion") != nullptr ||
         scene::find_source(material.sources, "mean_surface_energy") != nullptr;
}

physics::FrictionParameters ContactSetup::felt_friction() const {
  using physics::FrictionLaw;
  if (friction == FrictionLaw::None) return {};
  physics::FrictionParameters felt = material.friction;
  felt.law = friction == FrictionLaw::Lattice && !material.has_lattice ? FrictionLaw::Amontons : friction;
  return felt;
}

std::optional<physics::LawChoice> ContactSetup::place() const {
  if (!has_work_of_adhesion()) return std::nullopt;
  return physics::choose_law(material.contact);
}

physics::Law ContactSetup::law() const {
  return model.automatic ? physics::choose_law(material.contact).law : model.law;
}

std::string ContactSetup::used_model() const {
  if (model.direction_rule) return "paper-rule";
  return fmt::format("{}{}", model.dynamic ? kDynamicPrefix : "", physics::name_of(law()));
}

std::string ContactSetup::heading() const {
  const bool named = material.name != kNoMaterial;
  return (named ? fmt::format("{}, {} tip, {}", material.title, material.tip, material.medium) : material.title) +
         ": " + used_model();
}

std::span<const ContactParameter> contact_parameters() {
  static const auto parameters = make_parameters();
  return parameters;
}

const ContactParameter* find_contact_parameter(std::string_view option) {
  const auto parameters = contact_parameters();
  const auto at = std::find_if(parameters.begin(), parameters.end(),
                               [&](const ContactParameter& parameter) { return parameter.option == option; });
  return at == parameters.end() ? nullptr : &*at;
}

bool acts(const ContactParameter& parameter, const ModelName& model) {
  const std::string_view option = parameter.option;
  // for a moving lever only
  if (option == "resonance" || option == "quality-factor") return model.dynamic || model.driven;
  if (option == "temperature") return model.dynamic;
  if (model.automatic) return true;
  const LawTraits& law = physics::traits_of(model.law);
  if (option == "hamaker") return law.van_der_waals;
  // not used by a closed form
  if (option == "retardation") return law.van_der_waals && law.curve != nullptr;
  if (option == "humidity") return law.curve != nullptr;
  // all others influence the force or the position on the adhesion map
  return true;
}

bool changes_force(const ContactParameter& parameter, const ModelName& model) {
  if (!acts(parameter, model)) return false;
  if (model.automatic) return true;
  const std::string_view option = parameter.option;
  const LawTraits& law = physics::traits_of(model.law);
  if (option == "work-of-adhesion") return law.adhesion;
  if (option == "reduced-modulus") return law.modulus != physics::ModulusUse::Unused;
  if (option == "atomic-distance") return law.atomic_distance;
  return true;
}

core::Result<double> parse_parameter(const ContactParameter& parameter, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::WrongUsage, fmt::format("--{}: {}", parameter.option, why));
  };
  if (parameter.units.empty()) {
    double number = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) {
      return wrong(fmt::format("cannot read \"{}\" as {}; write a plain number", text.substr(0, 40), parameter.sort));
    }
    return number;
  }
  const auto parsed = physics::parse_si(text, parameter.sort, parameter.units, parameter.infinity);
  if (const auto* error = std::get_if<std::string>(&parsed)) return wrong(*error);
  return std::get<double>(parsed);
}

std::string format_parameter(const ContactParameter& parameter, double si) {
  return parameter.units.empty() ? fmt::format("{:.6g}", si) : physics::format_si(si, parameter.units, 6);
}

void override_parameter(ContactSetup& setup, const ContactParameter& parameter, double si, const std::string& written,
                        const std::string& source) {
  parameter.set(setup, si);
  auto& sources = setup.material.sources;
  const auto replaced = [&](const scene::SourcedValue& s) {
    return std::find(parameter.source_keys.begin(), parameter.source_keys.end(), s.key) != parameter.source_keys.end();
  };
  const auto first = std::find_if(sources.begin(), sources.end(), replaced) - sources.begin();
  std::erase_if(sources, replaced);
  sources.insert(sources.begin() + first, {std::string(parameter.source_keys.front()), written, source, false});
}

}  // namespace afm::curves
