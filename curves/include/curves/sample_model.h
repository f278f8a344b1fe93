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

struct FeltMap;
struct MapCurve;

// A material as it is felt and shown: its entries in files and on the command line, the current parameters, the
// resulting law and the derived figures. A new one is created for other parameters; cheap to copy.
struct SampleModel {
  ContactSetup setup;                                // setup as loaded
  scene::SharedContact parameters;                   // parameters for the servo
  physics::LawChoice contact;                        // position on the adhesion map, and the law that suits it
  std::shared_ptr<const physics::LawTables> tables;  // tables of the law; dynamic lever: at rest; tapping: of the push
  haptics::Scaling scaling;                          // scale Fit on the simulated hand
  std::shared_ptr<const MapCurve> pixel;             // pixel of a force map (curves/curve_map.h); null: none
  std::shared_ptr<const FeltMap> felt_map;           // map that is felt whole (curves/fitting/felt_map.h); null: none

  const physics::CycleFigures& figures() const { return tables->figures; }
  bool dynamic() const { return parameters.dynamic != 0; }
  bool taps() const { return scene::taps(parameters); }
};

// Takes milliseconds. Fails with one line that names the material if no such law exists for it or it cannot be felt.
core::Result<SampleModel> make_sample_model(const ContactSetup& setup);

// The sample with other numbers. Chooses the law again if that is automatic.
core::Result<SampleModel> make_sample_model(const SampleModel& material, const ContactSetup& changed);

// Sample with exactly these parameters, as recorded in a session; `curves` as in SharedModel.
core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry, const scene::SharedContact& parameters,
                                            std::span<const scene::SharedMeasuredCurve> curves);

// Sample with the recorded curve `curves[index]`; `entry` describes its lever as far as known.
core::Result<SampleModel> make_sample_model(const scene::MaterialEntry& entry,
                                            std::span<const scene::SharedMeasuredCurve> curves, std::uint32_t index);

// Name of the felt law: "dmt", "dynamic-dmt", "tapping-dmt", "measured".
std::string law_name(const scene::SharedContact& parameters);

}  // namespace afm::curves
