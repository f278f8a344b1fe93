// SPDX-License-Identifier: Apache-2.0
#include "app/tapping/tapping_command.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "curves/svg_plot.h"
#include "curves/tapping/driven_setup.h"
#include "curves/tapping/tapping_output.h"
#include "curves/tapping/tapping_run.h"
#include "curves/tapping/tapping_sweep.h"

namespace afm::app {
namespace {

using core::wrong_usage;

// One option of the vibrating modes.
struct TappingOption {
  const char* name;
  std::string& (*text)(curves::TappingChoice& choice);
  bool tapping, fm;  // modes in which it has an effect
  const char* type;
  const char* help;
};

const std::array kOptions{
    TappingOption{"--free-amplitude", [](curves::TappingChoice& c) -> std::string& { return c.numbers.free_amplitude; },
                  true, false, "LENGTH",
                  "tapping: free amplitude A0 at the drive frequency, zero-to-peak, 10 pm to 10 um, in m, mm, um, nm "
                  "or pm"},
    TappingOption{"--drive", [](curves::TappingChoice& c) -> std::string& { return c.numbers.drive; }, true, false,
                  "FREQUENCY",
                  "tapping: frequency of the drive, 0.5 to 1.5 times the resonance, in MHz, kHz or Hz; default: at the "
                  "resonance"},
    TappingOption{"--method", [](curves::TappingChoice& c) -> std::string& { return c.numbers.method; }, true, false,
                  "METHOD",
                  "tapping: averaged over a swing (quality factor of at least 100), or direct integration; default: "
                  "averaged where it can be"},
    TappingOption{"--amplitude", [](curves::TappingChoice& c) -> std::string& { return c.numbers.amplitude; }, false,
                  true, "LENGTH", "fm: amplitude that is kept, zero-to-peak, 1 pm to 10 um, in m, mm, um, nm or pm"},
    TappingOption{"--contact-gap", [](curves::TappingChoice& c) -> std::string& { return c.contact_gap; }, true, true,
                  "LENGTH",
                  "tapping and fm: distance a0 of bodies in contact, 10 pm to 5 nm, instead of --work-of-adhesion, for "
                  "models dmt and maugis: the attraction at a0 is the pull-off force"},
    TappingOption{"--viscosity", [](curves::TappingChoice& c) -> std::string& { return c.numbers.viscosity; }, true,
                  true, "VISCOSITY",
                  "tapping and fm: viscosity of a Kelvin-Voigt contact, 0 to 1e6 Pa*s, in Pa*s, mPa*s or uPa*s; "
                  "default: 0Pa*s"},
    TappingOption{
        "--at", [](curves::TappingChoice& c) -> std::string& { return c.numbers.at; }, true, true, "LENGTH",
        "tapping and fm: all states at this height of the base instead of a path; by direct integration those "
        "reached from the free swing and from rest"},
};

void add_felt_drive(OptionList& command, curves::TappedHand& hand) {
  command
      .add_option("--mode", hand.choice.mode,
                  "contact; or tapping, in which a drive swings the lever and the hand feels how much the sample takes "
                  "of its amplitude")
      .one_of({"contact", "tapping"})
      .type_name("MODE")
      .show_default();
  for (const TappingOption& option : kOptions) {
    const std::string_view name = option.name;
    if (name != "--free-amplitude" && name != "--drive" && name != "--viscosity") continue;
    command.add_option(option.name, option.text(hand.choice), option.help).type_name(option.type);
  }
}

void add_felt_lever(OptionList& command, curves::TappedHand& hand, const std::string& more_on_spring) {
  for (const std::string_view option : {"spring-constant", "resonance", "quality-factor"}) {
    command
        .add_option(fmt::format("--{}", option), hand.values[std::string(option)],
                    "tapping: " + curves::find_contact_parameter(option)->help +
                        (option == "spring-constant" ? more_on_spring : ""))
        .type_name("VALUE");
  }
}

template <class Run>
core::Result<std::string> text_of_run(const Run& run, const std::string& format, std::string (*csv)(const Run&),
                                      nlohmann::ordered_json (*json)(const Run&),
                                      std::vector<curves::SvgPlot> (*plots)(const Run&)) {
  if (format == "csv") return csv(run);
  if (format == "json") return json(run).dump(2) + "\n";
  if (run.at) return wrong_usage("--at is written as csv or json, not svg");
  return curves::svg(std::span<const curves::SvgPlot>(plots(run)));
}

}  // namespace

void add_tapping_options(OptionList& command, curves::TappingChoice& choice) {
  command
      .add_option("--mode", choice.mode,
                  "contact; tapping, driven with a constant swing: amplitude and phase; fm, with a constant amplitude: "
                  "frequency shift")
      .one_of({"contact", "tapping", "fm"})
      .type_name("MODE")
      .show_default();
  for (const TappingOption& option : kOptions) {
    Option added = command.add_option(option.name, option.text(choice), option.help);
    added.type_name(option.type);
    if (option.name == std::string_view("--method")) added.one_of({"averaged", "direct"});
  }
}

void add_tapped_scan_options(OptionList& command, curves::TappingChoice& choice) {
  command
      .add_option("--mode", choice.mode,
                  "contact, which keeps the force; or tapping, which keeps the amplitude of a vibrating lever, with "
                  "channels for amplitude error, phase, energy dissipated and peak force")
      .one_of({"contact", "tapping"})
      .type_name("MODE")
      .show_default();
  for (const TappingOption& option : kOptions) {
    const std::string_view name = option.name;
    if (!option.tapping || name == "--method" || name == "--at") continue;
    command.add_option(option.name, option.text(choice), option.help).type_name(option.type);
  }
}

void add_tapped_view_options(OptionList& command, curves::TappedHand& hand) {
  add_felt_drive(command, hand);
  command
      .add_option("--model", hand.model,
                  "tapping: law of force; auto chooses it by the contact's Tabor parameter; one of " +
                      curves::known_models(curves::ModelUse::Tapped))
      .type_name("NAME")
      .show_default();
  command
      .add_option(
          "--felt-force", hand.felt,
          "tapping: what the hand feels: push, the lost amplitude; or mean, the mean force on the tip, as far as an "
          "energy tank of 30 mJ and 50 mW pays for it")
      .one_of({"push", "mean"})
      .type_name("FORCE")
      .show_default();
  add_felt_lever(command, hand, "; with --force-map, that of the lever that recorded it, instead of the file's");
}

void add_tapped_demo_options(OptionList& command, curves::TappedHand& hand) {
  add_felt_drive(command, hand);
  add_felt_lever(command, hand, "");
}

core::Result<void> check_tapped_view(const curves::TappedHand& hand, bool alone) {
  if (const auto checked = check_tapping_options(hand.choice); !checked) return checked;
  if (hand.choice.mode == "contact") return curves::check_contact_mode(hand);
  if (alone) return {};
  return wrong_usage("--mode tapping is felt without --particles, --force-map and --friction; remove them");
}

core::Result<void> check_tapping_options(const curves::TappingChoice& choice) {
  curves::TappingChoice given = choice;
  for (const TappingOption& option : kOptions) {
    if (option.text(given).empty()) continue;
    if ((choice.mode == "tapping" && option.tapping) || (choice.mode == "fm" && option.fm)) continue;
    const bool vibrates = choice.mode != "contact", amplitude = std::string_view(option.name).ends_with("amplitude");
    const char* const of_mode = choice.mode == "fm" ? "--amplitude" : "--free-amplitude";
    const std::string instead = vibrates && amplitude ? fmt::format("give {} instead", of_mode) : "remove it";
    return wrong_usage(fmt::format("{} has no effect on --mode {}; {}, or take --mode {}", option.name, choice.mode,
                                   instead, option.tapping ? "tapping" : "fm"));
  }
  if (choice.mode == "tapping" && choice.numbers.free_amplitude.empty()) {
    return wrong_usage("--mode tapping needs --free-amplitude, such as --free-amplitude 20nm");
  }
  if (choice.mode == "fm" && choice.numbers.amplitude.empty()) return wrong_usage("--mode fm needs --amplitude");
  return {};
}

core::Result<std::string> tapping_text(const curves::TappingChoice& choice, const curves::ContactOptions& contact,
                                       const curves::PathOptions& path, const std::string& format) {
  if (format != "csv" && format != "json" && format != "svg") {
    return wrong_usage(fmt::format("--mode {} is written as csv, json or svg, not {}", choice.mode, format));
  }
  if (const auto checked = curves::check_path(choice, path); !checked) return tl::unexpected(checked.error());
  const auto setup = curves::driven_setup(choice, contact);
  if (!setup) return tl::unexpected(setup.error());
  if (choice.mode == "fm") {
    const auto run = curves::run_frequency_shift(*setup, path, choice.numbers);
    if (!run) return tl::unexpected(run.error());
    return text_of_run(*run, format, curves::frequency_shift_csv, curves::frequency_shift_json,
                       curves::frequency_shift_plots);
  }
  const auto run = curves::run_tapping(*setup, path, choice.numbers);
  if (!run) return tl::unexpected(run.error());
  return text_of_run(*run, format, curves::tapping_csv, curves::tapping_json, curves::tapping_plots);
}

core::Result<std::string> tapping_sweep_text(const curves::TappingChoice& choice, const curves::ContactOptions& contact,
                                             const std::vector<std::string>& sweeps, const std::string& format) {
  if (format != "csv" && format != "json" && format != "svg") {
    return wrong_usage(fmt::format("a sweep of --mode {} is written as csv, json or svg, not {}", choice.mode, format));
  }
  const auto setup = curves::driven_setup(choice, contact);
  if (!setup) return tl::unexpected(setup.error());
  const auto sweep = curves::run_tapping_sweep(*setup, choice, sweeps);
  if (!sweep) return tl::unexpected(sweep.error());
  if (format == "csv") return curves::tapping_sweep_csv(*sweep);
  if (format == "json") return curves::tapping_sweep_json(*sweep).dump(1) + "\n";
  return curves::svg(curves::tapping_sweep_plot(*sweep));
}

}  // namespace afm::app
