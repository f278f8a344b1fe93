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

// A name that --model takes: auto, paper-rule, a computed law (physics/law.h), and dynamic- before one that can move a
// mass.
struct ModelName {
  std::string text;
  bool automatic = false;       // selects the law that suits the contact
  bool direction_rule = false;  // selects the law by the paper's flow chart
  bool dynamic = false;         // includes the lever's mass, damping and heat
  physics::Law law = physics::Law::Paper;

  static std::optional<ModelName> parse(std::string_view text);
};

// paper-rule must never drive a device.
enum class ModelUse { Curve, Device };

// "auto, paper-rule, paper, ...", for help and messages.
std::string known_models(ModelUse use);

// One tip, lever, sample and medium, and how its curve is to be computed.
struct ContactSetup {
  scene::MaterialEntry material;  // includes probe and overrides in its numbers, with their sources
  physics::LawOptions law_options;
  ModelName model;
  physics::FrictionLaw friction = physics::FrictionLaw::None;  // friction to be felt; force curves do not use it

  // The chosen law with the material's numbers; Amontons' where atoms were asked for that lie in no lattice.
  physics::FrictionParameters felt_friction() const;

  // Whether W is known; without it the contact has no place on the adhesion map.
  bool has_work_of_adhesion() const;

  // The place on the map. Throws as physics::validate() does.
  std::optional<physics::LawChoice> place() const;

  // The law of `model`, or the one that suits the place. Throws as physics::validate() does.
  physics::Law law() const;

  // "dmt", "dynamic-dmt", "paper-rule": what was computed in the end.
  std::string used_model() const;
};

// One number that a person may give, sweep and read in results: as --option on the command line, under json_key in SI.
struct ContactParameter {
  std::string_view option;                        // "tip-radius"
  std::string_view json_key;                      // "tip_radius_m"
  std::span<const std::string_view> source_keys;  // keys in material files; the first one is that of the number itself
  std::string help;
  std::string_view sort;                 // "a length"
  std::span<const physics::Unit> units;  // empty for a plain number
  physics::Infinity infinity;
  std::optional<double> (*get)(const ContactSetup& setup);  // SI; none where it is not set
  void (*set)(ContactSetup& setup, double si);
};

std::span<const ContactParameter> contact_parameters();

// Null if there is none.
const ContactParameter* find_contact_parameter(std::string_view option);

// Whether the number changes anything that is printed for this model.
bool acts(const ContactParameter& parameter, const ModelName& model);

// Whether the force changes with it. A number that only places the contact on the adhesion map acts, without that.
bool changes_force(const ContactParameter& parameter, const ModelName& model);

// Reads one value, in SI. WrongUsage names the option.
core::Result<double> parse_parameter(const ContactParameter& parameter, const std::string& text);

// As people read it: "50 nm".
std::string format_parameter(const ContactParameter& parameter, double si);

// Sets the number and puts `source` in the place of where it came from.
void override_parameter(ContactSetup& setup, const ContactParameter& parameter, double si, const std::string& written,
                        const std::string& source);

}  // namespace afm::curves
