// SPDX-License-Identifier: Apache-2.0
#include "exhibit/data_panel.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "curves/plot_units.h"
#include "exhibit/frame_builder.h"
#include "panel_conventions.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

namespace {

using physics::format_quantity;
using physics::Law;

// With a typographic minus, and no sign on what rounds to zero.
std::string signed_text(double value, int decimals, const char* unit) {
  const double tiny = 0.5 * std::pow(10.0, -decimals);
  const char* sign = value >= tiny ? "+" : value <= -tiny ? "\u2212" : "";
  return fmt::format("{}{:.{}f} {}", sign, std::abs(value), decimals, unit);
}

// A number of the contact: with where it comes from, or, marked, what it was before it was changed.
template <class Q, class Text>
render::DataRow row(const curves::SampleModel& material, const char* name, const char* option,
                    Q physics::ContactParameters::* member, const Text& text) {
  const Q now = material.parameters.contact.*member;
  const Q before = material.setup.material.contact.*member;
  render::DataRow row{name, text(now), ""};
  if (now != before) {
    row.value = "\u2192 " + row.value;
    row.source = "changed from " + text(before);
    return row;
  }
  for (const std::string_view key : curves::find_contact_parameter(option)->source_keys) {
    const scene::SourcedValue* sourced = scene::find_source(material.setup.material.sources, key);
    if (sourced == nullptr) continue;
    row.source = (sourced->estimated ? "estimated: " : "") + sourced->source;
    break;
  }
  return row;
}

std::string length_text(physics::Length q) { return format_quantity(q, physics::kLengthUnits, kDigits); }
std::string stiffness_text(physics::Stiffness q) { return fmt::format("{:.3g} N/m", q.si); }
std::string energy_text(physics::Energy q) { return format_quantity(q, physics::kEnergyUnits, kDigits); }
std::string surface_energy_text(physics::SurfaceEnergy q) { return fmt::format("{:.3f} mJ/m\u00b2", q.si * 1e3); }
std::string pressure_text(physics::Pressure q) {
  return physics::isfinite(q) ? format_quantity(q, physics::kPressureUnits, kDigits) : "rigid";
}

std::string hysteresis_text(const physics::CycleFigures& figures) {
  const physics::Stiffness critical = figures.critical_stiffness;
  if (!physics::isfinite(critical)) return "hysteresis with any lever";
  return fmt::format("{} {}", figures.hysteretic ? "hysteresis vanishes at k =" : "no hysteresis: k is above",
                     stiffness_text(critical));
}

}  // namespace

render::DataPanel data_panel(const curves::SampleModel& material, const scene::Tip& tip) {
  using physics::ContactParameters;
  const physics::CycleFigures& figures = material.figures();
  const Law law = material.parameters.law;
  render::DataPanel panel;
  panel.title = material.setup.material.title;
  panel.subtitle = law == Law::Measured
                       ? material.setup.material.note
                       : fmt::format("{} tip, in {}", material.setup.material.tip, material.setup.material.medium);
  panel.rows = {
      row(material, "Tip radius R", "tip-radius", &ContactParameters::tip_radius, length_text),
      row(material, "Spring constant k", "spring-constant", &ContactParameters::spring_constant, stiffness_text)};
  const physics::LawTraits& traits = physics::traits_of(law);
  if (traits.van_der_waals) {
    panel.rows.push_back(row(material, "Hamaker constant A", "hamaker", &ContactParameters::hamaker, energy_text));
  }
  if (traits.adhesion) {
    panel.rows.push_back(row(material, "Surface energy \u221a(\u03b3\u03b3)", "work-of-adhesion",
                             &ContactParameters::mean_surface_energy, surface_energy_text));
  }
  if (traits.modulus != physics::ModulusUse::Unused) {
    panel.rows.push_back(
        row(material, "Reduced modulus E*", "reduced-modulus", &ContactParameters::reduced_modulus, pressure_text));
  }
  if (traits.atomic_distance) {
    panel.rows.push_back(
        row(material, "Atomic distance z0", "atomic-distance", &ContactParameters::atomic_distance, length_text));
  }
  panel.rows.push_back({"Law of force", curves::law_name(material.parameters), curves::law_reason(material)});
  if (figures.hysteretic) {
    panel.rows.push_back({"Snap-in / pull-off",
                          fmt::format("{:.3f} / {:.3f} nN", std::abs(figures.force_after_jtc.si) * curves::kNnPerN,
                                      std::abs(figures.force_before_joc.si) * curves::kNnPerN),
                          fmt::format("at Z = {:.2f} nm / {:.2f} nm", figures.z_jtc.si * curves::kNmPerM,
                                      figures.z_joc.si * curves::kNmPerM)});
  }
  panel.rows.push_back({"Energy of the loop", fmt::format("{:.3g} aJ", figures.loop_energy.si * curves::kAjPerJ),
                        hysteresis_text(figures)});
  panel.rows.push_back({"Force on the tip", signed_text(tip.force_n * curves::kNnPerN, 3, "nN"),
                        fmt::format("lever bent by {}", signed_text(tip.deflection_m * curves::kNmPerM, 2, "nm"))});
  return panel;
}

render::DataPanel results_panel(std::span<const CycleResult> results) {
  render::DataPanel panel;
  panel.title = "What was felt";
  panel.subtitle = "jump to contact / jump off contact";
  for (const CycleResult& result : results) {
    if (!result.hysteretic) {
      panel.rows.push_back({result.title, "no jumps", fmt::format("law {}, a lever too stiff for them", result.law)});
      continue;
    }
    panel.rows.push_back(
        {result.title,
         fmt::format("{:.3f} / {:.3f} nN", result.f_attr_n * curves::kNnPerN, result.f_ad_n * curves::kNnPerN),
         fmt::format("at {:.2f} nm / {:.2f} nm, law {}", result.z_jtc_m * curves::kNmPerM,
                     result.z_joc_m * curves::kNmPerM, result.law)});
  }
  return panel;
}

}  // namespace afm::exhibit
