// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "haptics/scaling.h"
#include "physics/adhesion_map.h"
#include "physics/law_tables.h"
#include "scene/samples/material_library.h"
#include "scene/shared/shared_blocks.h"

namespace afm::curves {

// A material as it is felt and shown: what the files and the command line say of it, the parameters that hold now, the
// law that they are given, and what that comes to. Made again for other parameters; cheap to copy.
struct SampleModel {
  ContactSetup setup;                                // as loaded
  scene::SharedContact parameters;                   // parameters for the servo
  physics::LawChoice contact;                        // its place on the adhesion map, and the law that suits it
  std::shared_ptr<const physics::LawTables> tables;  // dynamic lever: tables of the same lever at rest
  haptics::Scaling scaling;                          // Fit, on the simulated hand

  const physics::CycleFigures& figures() const { return tables->figures; }
  bool dynamic() const { return parameters.dynamic != 0; }
};

// Takes milliseconds. Fails with one line that names the material if it has no such law, or cannot be felt.
core::Result<SampleModel> make_sample_model(const ContactSetup& setup);

// The same sample with other numbers, by which the law is chosen again where that was asked for.
core::Result<SampleModel> make_sample_model(const SampleModel& material, const ContactSetup& changed);

// With exactly these parameters, as a session recorded them; `curves` as in SharedModel.
core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry, const scene::SharedContact& parameters,
                                            std::span<const scene::SharedMeasuredCurve> curves);

// The recorded curve `curves[index]`; `entry` says what is known of its lever.
core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry,
                                            std::span<const scene::SharedMeasuredCurve> curves, std::uint32_t index);

// "dmt", "dynamic-dmt", "measured": the law that is felt.
std::string law_name(const scene::SharedContact& parameters);

}  // namespace afm::curves
