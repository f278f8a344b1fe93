// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/pitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/scaling.h"

namespace afm::exhibit {

namespace {

constexpr double kNoteOfA = 69, kHzOfA = 440, kNotesInOctave = 12;
constexpr double kLevelWithoutForce = 0.2;
constexpr double kFarSide = 0.75;  // farthest position, at which neither ear is silent

}  // namespace

double note_hz(double note) { return kHzOfA * std::exp2((note - kNoteOfA) / kNotesInOctave); }

Ear::Ear(double bend_n, double strongest_n, double free_amplitude_m)
    : bend_n_(bend_n), whole_(std::asinh(strongest_n / bend_n)), free_amplitude_m_(free_amplitude_m) {}

Ear::Ear(const physics::LawTables& tables, double free_amplitude_m)
    : Ear(haptics::compression_bend_n(tables), haptics::strongest_force_n(tables), free_amplitude_m) {}

double Ear::share(double force_n) const { return std::asinh(std::abs(force_n) / bend_n_) / whole_; }

double Ear::hz(double force_n) const {
  return note_hz(kLowestNote + std::min(kNotesToPull * share(force_n), kNotesToPull + kNotesBeyond));
}

Tone Ear::tone(double force_n) const {
  const double turn = std::tanh(force_n / bend_n_);  // continuous from side to side at zero force
  return {.hz = hz(force_n),
          .level = kLevelWithoutForce + (1.0 - kLevelWithoutForce) * std::min(1.0, share(force_n)),
          .side = kFarSide * turn,
          .edge = std::max(0.0, turn)};
}

Tone Ear::tone(double force_n, const scene::Swing& swing) const {
  if (!(free_amplitude_m_ > 0.0) || !(swing.amplitude_m > 0.0)) return tone(force_n);
  const double octaves = swing.phase_rad / (0.5 * std::numbers::pi) - 1.0;
  return {.hz = kHzOfA * std::exp2(std::clamp(octaves, -1.0, 1.0)),
          .level = std::min(1.0, swing.amplitude_m / free_amplitude_m_),
          .side = 0.0,
          .edge = std::clamp(-octaves, 0.0, 1.0)};
}

}  // namespace afm::exhibit
