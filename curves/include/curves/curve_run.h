// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/result.h"
#include "curves/contact_setup.h"
#include "physics/adhesion_map.h"
#include "physics/cycle_figures.h"
#include "physics/force_curve.h"

namespace afm::curves {

// The path of the lever's base, as it was written.
struct PathOptions {
  std::string
      from{};        // empty: above jump-off-contact by a tenth, and above jump-to-contact by 5 nm, in whole nanometres
  std::string to{};  // empty: -5 nm, or deeper where the sample is still pulling there
  std::string step{};        // empty: 0.01 nm, or a twenty-thousandth of a longer way
  std::string speed{};       // empty: 1 um/s; acts on dynamic models only
  std::string seed{};        // of the noise, a whole number; empty: the usual one; acts on dynamic models only
  bool events_only = false;  // the samples are not asked for: models at rest need few
};

// How a dynamic model moved.
struct Motion {
  physics::Velocity speed;
  double slow_motion = 1.0;  // how much longer than its physics a servo of 1 kHz needs for it
  std::uint64_t seed = 0;    // of the noise
};

// One cycle with everything that it was made from.
struct CurveRun {
  ContactSetup setup;
  std::string model;                        // what was computed: "dmt"
  std::optional<physics::LawChoice> place;  // on the adhesion map; none where the work of adhesion is not known
  physics::SweepPlan plan;
  physics::CycleFigures figures;  // of the law at rest, without noise and inertia
  physics::ForceCurve curve;
  std::optional<Motion> motion;
};

// Chooses the law and sweeps. Wrong texts and values, and values that have no such law, are errors of wrong usage.
core::Result<CurveRun> run_curve(const ContactSetup& setup, const PathOptions& path);

// The event of the curve, or null.
const physics::ModelEvent* find_event(const physics::ForceCurve& curve, physics::EventKind kind);

// What the cycle dissipates; none where the sweep leaves the loop open.
std::optional<physics::Energy> loop_energy(const CurveRun& run);

}  // namespace afm::curves
