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
  std::string seed{};        // integer seed of the noise; empty: the usual one; dynamic models only
  bool events_only = false;  // no samples requested: models at rest need few
};

// How a dynamic model moved.
struct Motion {
  physics::Velocity speed;
  double slow_motion = 1.0;  // time stretch that a 1 kHz servo needs for its physics
  std::uint64_t seed = 0;    // seed of the noise
};

// One cycle with everything that it was made from.
struct CurveRun {
  ContactSetup setup;
  std::string model;                        // computed model: "dmt"
  std::optional<physics::LawChoice> place;  // position on the adhesion map; none if the work of adhesion is unknown
  physics::SweepPlan plan;
  physics::CycleFigures figures;  // law at rest, without noise and inertia
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
