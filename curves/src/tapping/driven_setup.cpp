// SPDX-License-Identifier: Apache-2.0
#include "curves/tapping/driven_setup.h"

#include <fmt/format.h>

#include <utility>

#include "curves/curve_run.h"
#include "curves/tapping/tapping_run.h"
#include "physics/law.h"
#include "physics/quantity_text.h"
#include "physics/tapping/tapping_model.h"

namespace afm::curves {
namespace {

using core::wrong_usage;

// Options of the contact for a lever that swings, or the reason why the model cannot be tapped on.
core::Result<ContactOptions> driven_contact(const TappingChoice& choice, ContactOptions contact) {
  const bool automatic = contact.model == "auto";
  const auto law = physics::law_of(contact.model);
  if (contact.model == "paper-rule" || (law && !physics::has_dynamics(*law))) {
    return wrong_usage(fmt::format(
        "--mode {} needs the force as a function of the tip's height, which model {} does not give; choose {}",
        choice.mode, contact.model, known_models(ModelUse::Tapped)));
  }
  if (!automatic && !law && ModelName::parse(contact.model)) {
    return wrong_usage(fmt::format("--mode {} swings the lever by itself; write --model {}", choice.mode,
                                   contact.model.substr(contact.model.find('-') + 1)));
  }
  contact.driven = true;
  if (choice.contact_gap.empty()) return contact;
  if (law && (!physics::traits_of(*law).van_der_waals || !physics::traits_of(*law).adhesion)) {
    return wrong_usage(fmt::format("--contact-gap has no effect on model {}; remove it", contact.model));
  }
  std::string& work = contact.values["work-of-adhesion"];
  if (!work.empty() || contact.si_values.contains("work-of-adhesion"))
    return wrong_usage("--contact-gap and --work-of-adhesion exclude each other; remove one");
  work = "1mJ/m2";  // value that driven_setup() replaces once the Hamaker constant is known
  return contact;
}

}  // namespace

core::Result<ContactSetup> driven_setup(const TappingChoice& choice, const ContactOptions& contact) {
  const auto options = driven_contact(choice, contact);
  if (!options) return tl::unexpected(options.error());
  auto setup = contact_setup(*options);
  if (!setup || choice.contact_gap.empty()) return setup;
  const auto gap = physics::parse_quantity(choice.contact_gap, physics::kLengthUnits);
  if (!gap.value) return wrong_usage("--contact-gap: " + gap.error);
  const auto work = work_of_adhesion_for(*setup, *gap.value);
  if (!work) return tl::unexpected(work.error());
  override_parameter(*setup, *find_contact_parameter("work-of-adhesion"), work->si,
                     physics::format_quantity(*work, physics::kSurfaceEnergyUnits),
                     fmt::format("--contact-gap {} on the command line", choice.contact_gap));
  return setup;
}

core::Result<void> check_contact_mode(const TappedHand& hand) {
  const auto useless = [&](std::string_view option) {
    return wrong_usage(fmt::format("--{} has no effect on --mode {}; add --mode tapping", option, hand.choice.mode));
  };
  if (hand.model != "auto") return useless("model");
  if (hand.felt != "push") return useless("felt-force");
  for (const auto& [option, text] : hand.values) {
    if (!text.empty()) return useless(option);
  }
  return {};
}

core::Result<ContactSetup> tapped_setup(const scene::MaterialEntry& entry, const TappedHand& hand) {
  ContactOptions contact;
  contact.model = hand.model;
  const auto checked = driven_contact(hand.choice, contact);
  if (!checked) return tl::unexpected(checked.error());
  const auto model = ModelName::parse(hand.model);
  if (!model)
    return wrong_usage(fmt::format("--model {} is unknown; choose {}", hand.model, known_models(ModelUse::Tapped)));
  ContactSetup setup{entry, {}, *model};
  setup.model.driven = true;
  for (const auto& [option, text] : hand.values) {
    if (text.empty()) continue;
    const ContactParameter& parameter = *find_contact_parameter(option);
    const auto value = parse_parameter(parameter, text);
    if (!value) return tl::unexpected(value.error());
    override_parameter(setup, parameter, *value, text, fmt::format("--{} on the command line", option));
  }
  const auto driven = driven_sample(setup, hand.choice.numbers);
  if (!driven) return tl::unexpected(driven.error());
  const physics::Time relaxation = driven->lever.relaxation();
  if (relaxation > physics::kLongestFeltRelaxation) {
    return wrong_usage(fmt::format(
        "--quality-factor: the swing follows a hand within 2Q/w0 = {}; at most {} can be felt safely; give a "
        "lower one, or a higher --resonance",
        physics::format_quantity(relaxation, physics::kTimeUnits, 3),
        physics::format_quantity(physics::kLongestFeltRelaxation, physics::kTimeUnits, 3)));
  }
  setup.drive = FeltDrive{.free_amplitude = driven->lever.free_amplitude,
                          .frequency = driven->lever.ratio * driven->lever.resonance,
                          .viscosity = driven->viscosity,
                          .mean_force = hand.felt == "mean"};
  return setup;
}

core::Result<void> check_path(const TappingChoice& choice, const PathOptions& path) {
  if (!path.seed.empty()) return wrong_usage(fmt::format("--seed has no effect on --mode {}; remove it", choice.mode));
  if (choice.mode == "fm" && !path.speed.empty()) return wrong_usage("--speed has no effect on --mode fm; remove it");
  if (choice.numbers.at.empty()) return {};
  for (const auto& [name, text] :
       {std::pair{"from", &path.from}, {"to", &path.to}, {"step", &path.step}, {"speed", &path.speed}}) {
    if (!text->empty()) return wrong_usage(fmt::format("--{} has no effect with --at; remove one", name));
  }
  return {};
}

}  // namespace afm::curves
