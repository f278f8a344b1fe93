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

// The path of the lever's base, as typed.
struct PathOptions {
  std::string
      from{};  // start; empty: a tenth above the jump off contact, and 5 nm above the jump to contact, in whole nm
  std::string to{};          // turning point; empty: -5 nm, or deeper if the sample still pulls there
  std::string step{};        // step of the path; empty: 0.01 nm, or a twenty-thousandth of a longer path
  std::string speed{};       // speed of the base; empty: 1 um/s; used only by dynamic models
  std::string seed{};        // integer seed of the noise; empty: the default; used only by dynamic models
  bool events_only = false;  // true: no samples requested, of which models at rest need few
};

// Motion of a dynamic model.
struct Motion {
  physics::Velocity speed;
  double slow_motion = 1.0;  // factor by which a 1 kHz servo must slow down the physics
  std::uint64_t seed = 0;    // seed of the noise
};

// One cycle with all of its inputs.
struct CurveRun {
  ContactSetup setup;
  std::string model;                        // name of the computed model: "dmt"
  std::optional<physics::LawChoice> place;  // position on the adhesion map; empty if the work of adhesion is unknown
  physics::SweepPlan plan;
  physics::CycleFigures figures;  // figures of the law at rest, without noise and inertia
  physics::ForceCurve curve;
  std::optional<Motion> motion;
};

// Chooses the law and sweeps. WrongUsage for malformed texts and values, and for values without such a law.
core::Result<CurveRun> run_curve(const ContactSetup& setup, const PathOptions& path);

// The event of the curve, or null.
const physics::ModelEvent* find_event(const physics::ForceCurve& curve, physics::EventKind kind);

// Energy dissipated by the cycle; empty if the sweep does not close the loop.
std::optional<physics::Energy> loop_energy(const CurveRun& run);

}  // namespace afm::curves
