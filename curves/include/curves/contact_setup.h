// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "physics/adhesion_map.h"
#include "physics/friction/friction.h"
#include "physics/law.h"
#include "physics/quantity_text.h"
#include "scene/samples/material_library.h"

namespace afm::curves {

// A value of --model: auto, paper-rule, a computed law (physics/law.h), or dynamic- and one that can move a mass.
struct ModelName {
  std::string text;
  bool automatic = false;       // true: selects the law that suits the contact
  bool direction_rule = false;  // true: selects the law by the paper's flow chart
  bool dynamic = false;         // true: includes the lever's mass, damping and thermal noise
  bool driven = false;          // true: a drive swings the lever, as in tapping: resonance and damping act, not noise
  physics::Law law = physics::Law::Paper;

  static std::optional<ModelName> parse(std::string_view text);
};

// paper-rule must never drive a device. Tapped: laws on which a swing can be averaged (physics::has_averaged_swings()).
enum class ModelUse { Curve, Device, Tapped };

// List of the values of --model for help and messages: "auto, paper-rule, paper, ...".
std::string known_models(ModelUse use);

// The drive of a lever that taps under a hand.
struct FeltDrive {
  physics::Length free_amplitude;  // A0, amplitude zero-to-peak
  physics::Frequency frequency;
  physics::Viscosity viscosity;  // viscosity of the contact
  bool mean_force = false;       // true: the mean force is felt in place of the push, behind an energy tank
};

// One tip, lever, sample and medium, and the model for its curve.
struct ContactSetup {
  static constexpr std::string_view kNoMaterial = "none";  // name of the material of a contact given by numbers alone

  scene::MaterialEntry material;  // includes probe and overrides in its numbers, with their sources
  physics::LawOptions law_options;
  ModelName model;
  physics::FrictionLaw friction = physics::FrictionLaw::None;  // friction for the hand; not used for force curves
  std::optional<FeltDrive> drive = std::nullopt;               // drive under a hand; empty: the lever does not tap

  // The chosen friction law with the material's numbers; Amontons' law instead of a lattice if the material has none.
  physics::FrictionParameters felt_friction() const;

  // Returns whether W is known; without it the contact has no position on the adhesion map.
  bool has_work_of_adhesion() const;

  // Position on the map. Throws as physics::validate() does.
  std::optional<physics::LawChoice> place() const;

  // The law of `model`, or for auto the one that suits the position. Throws as physics::validate() does.
  physics::Law law() const;

  // Name of the model actually used: "dmt", "dynamic-dmt", "paper-rule".
  std::string used_model() const;

  // Heading of a plot: sample, tip and medium, as far as they have names, and the model.
  std::string heading() const;
};

// A parameter that users can set, sweep and find in results: as --option on the command line, as json_key in SI.
struct ContactParameter {
  std::string_view option;                        // option of the command line, "tip-radius"
  std::string_view json_key;                      // key in JSON, "tip_radius_m"
  std::span<const std::string_view> source_keys;  // keys in material files; the first one is the parameter's own
  std::string help;
  std::string_view sort;                 // quantity as messages name it, "a length"
  std::span<const physics::Unit> units;  // accepted units; empty for a plain number
  physics::Infinity infinity;
  std::optional<double> (*get)(const ContactSetup& setup);  // getter of the SI value; empty if not set
  void (*set)(ContactSetup& setup, double si);
};

std::span<const ContactParameter> contact_parameters();

// Parameter with that option; null if there is none.
const ContactParameter* find_contact_parameter(std::string_view option);

// Returns whether the parameter influences any output of this model.
bool acts(const ContactParameter& parameter, const ModelName& model);

// Returns whether the force depends on the parameter. One that only determines the position on the adhesion map acts,
// but does not change the force.
bool changes_force(const ContactParameter& parameter, const ModelName& model);

// Reads one value, in SI. WrongUsage names the option.
core::Result<double> parse_parameter(const ContactParameter& parameter, const std::string& text);

// Value for users: "50 nm".
std::string format_parameter(const ContactParameter& parameter, double si);

// Sets the parameter and records `source` as its origin.
void override_parameter(ContactSetup& setup, const ContactParameter& parameter, double si, const std::string& written,
                        const std::string& source);

}  // namespace afm::curves
