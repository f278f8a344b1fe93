// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/data_panel.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "curves/plot_units.h"
#include "exhibit/state/moment.h"
#include "exhibit/words/signed_text.h"
#include "haptics/energy_tank.h"
#include "panels/panel_conventions.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

namespace {

using physics::format_quantity;
using physics::Law;

// A value of the contact, with its source or, if it was changed, with its initial value.
template <class Q, class Text>
render::DataRow row(const curves::SampleModel& material, const Phrases& phrases, Phrase name, const char* option,
                    Q physics::ContactParameters::* member, const Text& text) {
  const Q now = material.parameters.contact.*member;
  const Q before = material.setup.material.contact.*member;
  render::DataRow row{phrases[name], phrases.number(text(now)), ""};
  if (now != before) {
    row.value = "\u2192 " + row.value;
    row.source = phrases.text<Phrase::ChangedFrom>(text(before));
    return row;
  }
  for (const std::string_view key : curves::find_contact_parameter(option)->source_keys) {
    const scene::SourcedValue* sourced = scene::find_source(material.setup.material.sources, key);
    if (sourced == nullptr) continue;
    const std::string source = phrases.word(sourced->source);
    const std::array values{source};
    row.source = sourced->estimated ? phrases.filled(Phrase::Estimated, values) : source;
    break;
  }
  return row;
}

std::string length_text(physics::Length q) { return format_quantity(q, physics::kLengthUnits, kDigits); }
std::string stiffness_text(physics::Stiffness q) { return fmt::format("{:.3g} N/m", q.si); }
std::string energy_text(physics::Energy q) { return format_quantity(q, physics::kEnergyUnits, kDigits); }
std::string surface_energy_text(physics::SurfaceEnergy q) { return fmt::format("{:.3f} mJ/m\u00b2", q.si * 1e3); }

std::string hysteresis_text(const physics::CycleFigures& figures, const Phrases& phrases) {
  const physics::Stiffness critical = figures.critical_stiffness;
  if (!physics::isfinite(critical)) return phrases[Phrase::HysteresisAlways];
  const std::string k = stiffness_text(critical);
  return figures.hysteretic ? phrases.text<Phrase::HysteresisBelow>(k) : phrases.text<Phrase::NoHysteresisAbove>(k);
}

// Reason for the law, from the Tabor parameter.
std::string law_text(const curves::SampleModel& material, const Phrases& phrases) {
  const Law law = material.parameters.law;
  if (law == Law::Measured) return phrases[Phrase::LawOfRecording];
  const std::string tabor = fmt::format("{:.2g}", material.contact.tabor);
  const std::string regime = phrases.word(std::string(physics::name_of(material.contact.regime)));
  if (law == material.contact.law) return phrases.text<Phrase::LawSuits>(tabor, regime);
  return phrases.text<Phrase::OtherLawSuits>(tabor, regime,
                                             law_word(std::string(physics::name_of(material.contact.law)), phrases));
}

// Adds the values that the law uses.
void add_contact_rows(const curves::SampleModel& material, const Phrases& phrases, render::DataPanel& panel) {
  using enum Phrase;
  using physics::ContactParameters;
  const auto add = [&](Phrase name, const char* option, auto member, const auto& text) {
    panel.rows.push_back(row(material, phrases, name, option, member, text));
  };
  const auto pressure_text = [&](physics::Pressure q) {
    return physics::isfinite(q) ? format_quantity(q, physics::kPressureUnits, kDigits) : phrases[Rigid];
  };
  const physics::LawTraits& traits = physics::traits_of(material.parameters.law);
  add(TipRadius, "tip-radius", &ContactParameters::tip_radius, length_text);
  add(SpringConstant, "spring-constant", &ContactParameters::spring_constant, stiffness_text);
  if (traits.van_der_waals) add(HamakerConstant, "hamaker", &ContactParameters::hamaker, energy_text);
  if (traits.adhesion) {
    add(SurfaceEnergy, "work-of-adhesion", &ContactParameters::mean_surface_energy, surface_energy_text);
  }
  if (traits.modulus != physics::ModulusUse::Unused) {
    add(ReducedModulus, "reduced-modulus", &ContactParameters::reduced_modulus, pressure_text);
  }
  if (traits.atomic_distance) {
    add(AtomicDistance, "atomic-distance", &ContactParameters::atomic_distance, length_text);
  }
}

// Text for the deflection. An attraction bends the lever down, towards the sample: the deflection is then positive.
std::string bend_text(double deflection_m, const Phrases& phrases) {
  constexpr double kUnseenM = 0.005e-9;  // deflection written as 0.00 nm
  if (std::abs(deflection_m) < kUnseenM) return phrases[Phrase::LeverStraight];
  const std::string amount = fmt::format("{:.2f} nm", std::abs(deflection_m) * curves::kNmPerM);
  return deflection_m < 0 ? phrases.text<Phrase::LeverBentUp>(amount) : phrases.text<Phrase::LeverBentDown>(amount);
}

}  // namespace

render::DataPanel data_panel(const curves::SampleModel& material, const scene::Tip& tip, const Phrases& phrases) {
  const physics::CycleFigures& figures = material.figures();
  const scene::MaterialEntry& entry = material.setup.material;
  render::DataPanel panel;
  panel.title = phrases.word(entry.title);
  if (material.parameters.law != Law::Measured) {
    panel.subtitle = phrases.text<Phrase::TipAndMedium>(phrases.word(entry.tip), phrases.word(entry.medium));
  } else if (!entry.note.empty()) {
    panel.subtitle = phrases.text<Phrase::RecordedBy>(entry.note);
  }
  add_contact_rows(material, phrases, panel);
  panel.rows.push_back({phrases[Phrase::ForceLaw], law_word(curves::law_name(material.parameters), phrases),
                        law_text(material, phrases)});
  // tapping: the figures are those of the push on the hand
  if (figures.hysteretic && !material.taps()) {
    panel.rows.push_back(
        {phrases[Phrase::SnapInAndPullOff],
         phrases.number(fmt::format("{:.3f} / {:.3f} nN", std::abs(figures.force_after_jtc.si) * curves::kNnPerN,
                                    std::abs(figures.force_before_joc.si) * curves::kNnPerN)),
         phrases.text<Phrase::AtHeights>(fmt::format("{:.2f} nm", figures.z_jtc.si * curves::kNmPerM),
                                         fmt::format("{:.2f} nm", figures.z_joc.si * curves::kNmPerM))});
  }
  if (!material.taps()) {
    panel.rows.push_back({phrases[Phrase::LoopEnergy],
                          phrases.number(fmt::format("{:.3g} aJ", figures.loop_energy.si * curves::kAjPerJ)),
                          hysteresis_text(figures, phrases)});
  }
  panel.rows.push_back({phrases[Phrase::ForceOnTip],
                        phrases.number(signed_text(tip.force_n * curves::kNnPerN, 3, "nN")),
                        bend_text(tip.deflection_m, phrases)});
  if (material.parameters.felt_mean_force != 0) {
    panel.rows.push_back(
        {phrases[Phrase::FeltForce], phrases[Phrase::FeltMeanForce],
         phrases.text<Phrase::FeltBehindTank>(fmt::format("{:.0f} mJ", haptics::EnergyTank::kFullJ * 1e3),
                                              fmt::format("{:.0f} mW", haptics::EnergyTank::kRefillW * 1e3))});
  }
  for (render::DataRow& each : panel.rows) each.detail = true;
  panel.details = false;
  return panel;
}

render::DataPanel results_panel(std::span<const CycleResult> results, const Phrases& phrases) {
  render::DataPanel panel;
  const bool tapped = !results.empty() && results.front().taps;
  panel.title = phrases[tapped ? Phrase::PlotTitleTapping : Phrase::Results];
  panel.subtitle = phrases[tapped ? Phrase::JumpsOfSwing : Phrase::SnapInAndPullOff];
  for (const CycleResult& result : results) {
    const std::string title = phrases.word(result.title);
    if (result.taps) {
      panel.rows.push_back({title,
                            result.hysteretic
                                ? phrases.number(fmt::format("{:.2f} / {:.2f} nm", result.z_jtc_m * curves::kNmPerM,
                                                             result.z_joc_m * curves::kNmPerM))
                                : phrases[Phrase::NoJumps],
                            law_word(result.law, phrases)});
      continue;
    }
    if (!result.hysteretic) {
      panel.rows.push_back(
          {title, phrases[Phrase::NoJumps], phrases.text<Phrase::NoJumpsBecause>(law_word(result.law, phrases))});
      continue;
    }
    panel.rows.push_back(
        {title,
         phrases.number(
             fmt::format("{:.3f} / {:.3f} nN", result.f_attr_n * curves::kNnPerN, result.f_ad_n * curves::kNnPerN)),
         phrases.text<Phrase::ResultHeights>(fmt::format("{:.2f} nm", result.z_jtc_m * curves::kNmPerM),
                                             fmt::format("{:.2f} nm", result.z_joc_m * curves::kNmPerM),
                                             law_word(result.law, phrases))});
  }
  return panel;
}

}  // namespace afm::exhibit
