// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/result.h"
#include "fits/indenter.h"
#include "physics/imaging/tip_shape.h"
#include "physics/quantity_text.h"

namespace afm::curves {

// Inputs of a synthetic curve, in SI. Numbers are those of kSyntheticFields; zero: none, or not used.
struct SyntheticSetup {
  fits::Shape shape = fits::Shape::Paraboloid;  // shape of the indenter, not Auto
  fits::Base base = fits::Base::Bonded;         // support of an exact layer
  std::uint32_t seed = 1;
  std::size_t points = 1000;  // number of points in each branch
  double modulus_pa = 0;      // Young's modulus
  double poisson = 0.5;
  double radius_m = 1e-6, half_angle_rad = physics::TipShape{}.half_angle_rad, layer_m = 0;
  double work_j_per_m2 = 0;
  double atomic_distance_m = fits::Indenter{}.atomic_distance_m;
  double spring_n_per_m = 0.1;
  double most_force_n = 1e-9;      // true force at which the base turns
  double contact_m = 0;            // height of the base at which the approach meets the sample
  double clearance_m = 0;          // height above contact_m at which the curve begins; zero: chosen automatically
  double speed_m_per_s = 1e-6;     // velocity of the base
  double sensitivity_m_per_v = 0;  // deflection per volt of the optical lever
  double noise_n = 0;              // rms of the force
  double noise_memory = 0;         // correlation of the noise from point to point
  double bits = 0;                 // resolution of the digitiser over kDetectorRangeV
  double level_n = 0;              // baseline at the first point
  double tilt_n_per_m = 0;         // slope of the baseline
  double drift_m_per_s = 0;        // upward velocity of the sample
  double wave_n = 0;               // amplitude of a wave of interference
  double wave_period_m = 0;        // period of the wave in the height of the base
};

inline constexpr double kDetectorRangeV = 10.0;  // limit in either direction
inline constexpr std::size_t kFewestSyntheticPoints = 50;

// Use of a number by a set-up.
enum class FieldUse { Required, Optional, None };

// Description of one number for options, checks and truths.
struct SyntheticField {
  std::string_view option;    // option, without its dashes
  std::string_view json_key;  // key in JSON, with its unit
  std::string_view help;
  double smallest, largest;  // legal range, SI, both ends included
  const physics::Units* units;
  double SyntheticSetup::* member;
  FieldUse (*use)(const SyntheticSetup& setup);
};

inline constexpr std::size_t kSyntheticFieldCount = 21;
extern const std::array<SyntheticField, kSyntheticFieldCount> kSyntheticFields;

// A number that a person gave.
struct GivenNumber {
  const SyntheticField* field;
  double si;
};

// Sets the numbers and checks all of the set-up. WrongUsage, naming the option, for a number that is missing or not
// used, and for what the law does not know.
core::Result<void> apply(std::span<const GivenNumber> given, SyntheticSetup& setup);

}  // namespace afm::curves
