// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "curves/curve_run.h"
#include "curves/tapping/tapping_options.h"
#include "physics/adhesion_map.h"
#include "physics/tapping/frequency_shift.h"
#include "physics/tapping/tapping_curve.h"

namespace afm::curves {

// A lever under its drive over a sample.
struct DrivenSample {
  std::shared_ptr<const physics::TapSurface> surface;
  physics::DrivenLever lever;
  physics::Viscosity viscosity;  // viscosity of the contact
};

// Lever and surface for the setup of driven_setup(). WrongUsage, naming the option, for a value that it cannot have.
core::Result<DrivenSample> driven_sample(const ContactSetup& setup, const TappingOptions& options);

// One resting swing at a height.
struct TapStateRow {
  std::string start;  // start of a direct integration, "free swing" or "rest"; empty if averaged
  physics::RestingTap tap;
  physics::Energy cleveland;
  std::optional<physics::DirectSwing> swing;  // direct integration; averaged: of a state without averages
};

// A tapping curve, or the states at one height, with all inputs.
struct TappingRun {
  ContactSetup setup;
  std::string model;  // name of the law, "dmt"
  std::optional<physics::LawChoice> place;
  physics::DrivenLever lever;
  physics::Viscosity viscosity;
  physics::TapMethod method = physics::TapMethod::Averaged;
  std::optional<physics::Length> averages_lost_at;  // height integrated directly because averages failed
  physics::TapPath path;
  physics::TappingCurve curve;
  std::optional<physics::Length> at;
  std::vector<TapStateRow> states;  // states at the height `at`
};

// Heights between which a tapping curve goes unless others are given, for a free amplitude.
struct UsualTapPath {
  physics::Length from, to;
};
UsualTapPath usual_tap_path(physics::Length free_amplitude);

// A curve of the frequency shift at constant amplitude, or its value at one height.
struct FrequencyShiftRun {
  ContactSetup setup;
  std::string model;
  std::optional<physics::LawChoice> place;
  physics::Length amplitude;
  physics::Viscosity viscosity;
  physics::SweepPlan plan;
  physics::FrequencyShiftCurve curve;  // curve, or one point if `at` is given
  std::optional<physics::Length> at;
};

// The work of adhesion for which DMT and Maugis-Dugdale have this distance a0 of two bodies in contact: that at which
// the van der Waals attraction is F_ad (physics/van_der_waals.h). UnphysicalValue's text as WrongUsage.
core::Result<physics::SurfaceEnergy> work_of_adhesion_for(const ContactSetup& setup, physics::Length contact_gap);

// Called after each height of a curve with the number of those that are done and of all; false ends it. The count
// begins again where a curve that has lost its averages is integrated directly.
using TapWatch = std::function<bool(std::size_t done, std::size_t all)>;

// Both take setups whose model is `driven`. WrongUsage for malformed texts and values, for a law that gives no force as
// a function of the height, and for a path that is too long to compute. Failed for a curve that `watch`, if there is
// one, has ended.
core::Result<TappingRun> run_tapping(const ContactSetup& setup, const PathOptions& path, const TappingOptions& options,
                                     const TapWatch& watch = {});
core::Result<FrequencyShiftRun> run_frequency_shift(const ContactSetup& setup, const PathOptions& path,
                                                    const TappingOptions& options);

}  // namespace afm::curves
