// SPDX-License-Identifier: Apache-2.0
#include "curves/synthetic_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "curves/angle_units.h"

namespace afm::curves {

namespace {

using physics::Unit;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array kPerVolt{Unit{"um/V", 1e6, true}, Unit{"\u00b5m/V", 1e6, false}, Unit{"\u03bcm/V", 1e6, false},
                              Unit{"nm/V", 1e9, true}, Unit{"pm/V", 1e12, true}};
constinit const physics::Units kSensitivityUnits{"a sensitivity", kPerVolt};

const fits::ShapeRow& law_of(const SyntheticSetup& setup) { return fits::row_of(setup.shape); }

FieldUse required(const SyntheticSetup&) { return FieldUse::Required; }
FieldUse optional(const SyntheticSetup&) { return FieldUse::Optional; }
FieldUse required_if(bool is_used) { return is_used ? FieldUse::Required : FieldUse::None; }
FieldUse optional_if(bool is_used) { return is_used ? FieldUse::Optional : FieldUse::None; }

FieldUse of_radius(const SyntheticSetup& setup) { return optional_if(law_of(setup).has_radius); }
FieldUse of_angle(const SyntheticSetup& setup) { return optional_if(!law_of(setup).has_radius); }
FieldUse of_layer(const SyntheticSetup& setup) { return required_if(law_of(setup).has_layer); }
FieldUse of_work(const SyntheticSetup& setup) { return required_if(law_of(setup).is_adhesive); }
FieldUse of_distance(const SyntheticSetup& setup) { return optional_if(setup.shape == fits::Shape::Maugis); }
FieldUse of_memory(const SyntheticSetup& setup) { return optional_if(setup.noise_n > 0.0); }
FieldUse of_bits(const SyntheticSetup& setup) { return optional_if(setup.sensitivity_m_per_v > 0.0); }
FieldUse of_period(const SyntheticSetup& setup) { return required_if(setup.wave_n > 0.0); }

// Option that makes a number of this use meaningful.
std::string remedy(const SyntheticField& field, const SyntheticSetup& setup) {
  const char* const other = field.use == of_memory   ? "--noise"
                            : field.use == of_bits   ? "--sensitivity"
                            : field.use == of_period ? "--wave"
                                                     : nullptr;
  if (other != nullptr) return fmt::format("it needs {}; give both, or neither", other);
  return fmt::format("--law {} has no use for it; leave it out", law_of(setup).name);
}

}  // namespace

const std::array<SyntheticField, kSyntheticFieldCount> kSyntheticFields{{
    {"modulus", "modulus_Pa", "Young's modulus of the sample", 1.0, 1e12, &physics::kPressureUnits,
     &SyntheticSetup::modulus_pa, required},
    {"poisson", "poisson_ratio", "Poisson's ratio of the sample; default: 0.5", 0.0, 0.5, &physics::kPlainNumber,
     &SyntheticSetup::poisson, optional},
    {"radius", "radius_m", "radius of the tip; default: 1um", 1e-10, 1e-3, &physics::kLengthUnits,
     &SyntheticSetup::radius_m, of_radius},
    {"half-angle", "half_angle_rad",
     "angle between the axis of the tip and its edge (cone) or face (pyramid); default: 17.189 deg", kDegree,
     88.0 * kDegree, &kAngleUnits, &SyntheticSetup::half_angle_rad, of_angle},
    {"layer", "layer_m", "thickness of the sample on a rigid base", 1e-10, 1e-1, &physics::kLengthUnits,
     &SyntheticSetup::layer_m, of_layer},
    {"work-of-adhesion", "work_of_adhesion_J_per_m2", "work of adhesion, of dmt, jkr and maugis", 1e-6, 10.0,
     &physics::kSurfaceEnergyUnits, &SyntheticSetup::work_j_per_m2, of_work},
    {"atomic-distance", "atomic_distance_m",
     "equilibrium distance z0 of the surfaces, for the stress of maugis; default: 0.3nm", 0.05e-9, 5e-9,
     &physics::kLengthUnits, &SyntheticSetup::atomic_distance_m, of_distance},
    {"spring-constant", "spring_constant_N_per_m", "stiffness of the lever; default: 0.1N/m", 1e-4, 1e4,
     &physics::kStiffnessUnits, &SyntheticSetup::spring_n_per_m, optional},
    {"most-force", "most_force_N", "true force at which the base turns; default: 1nN", 1e-13, 1e-2,
     &physics::kForceUnits, &SyntheticSetup::most_force_n, optional},
    {"contact", "contact_z_m", "height of the base at which the approach meets the sample; default: 0nm", -1e-3, 1e-3,
     &physics::kLengthUnits, &SyntheticSetup::contact_m, optional},
    {"clearance", "clearance_m",
     "height above the contact at which the curve begins; default: as far as the base goes below, and three times as "
     "far as the pull-off",
     1e-10, 1e-3, &physics::kLengthUnits, &SyntheticSetup::clearance_m, optional},
    {"speed", "speed_m_per_s", "speed of the base; default: 1um/s", 1e-10, 1.0, &physics::kVelocityUnits,
     &SyntheticSetup::speed_m_per_s, optional},
    {"sensitivity", "sensitivity_m_per_V", "sensitivity of the optical lever, written into the file", 1e-12, 1e-3,
     &kSensitivityUnits, &SyntheticSetup::sensitivity_m_per_v, optional},
    {"noise", "noise_N", "rms of the force's noise, white without --noise-memory", 1e-18, 1e-3, &physics::kForceUnits,
     &SyntheticSetup::noise_n, optional},
    {"noise-memory", "noise_memory",
     "low pass of the noise: its correlation from point to point; the rms does not change", 0.0, 0.999,
     &physics::kPlainNumber, &SyntheticSetup::noise_memory, of_memory},
    {"bits", "bits", "digitise the detector's signal of -10 to 10 V with this number of bits; beyond, it saturates",
     4.0, 32.0, &physics::kPlainNumber, &SyntheticSetup::bits, of_bits},
    {"level", "level_N", "force of the free lever at the first point", -1e-3, 1e-3, &physics::kForceUnits,
     &SyntheticSetup::level_n, optional},
    {"tilt", "tilt_N_per_m", "tilt of the baseline, positive where the force grows with the height", -100.0, 100.0,
     &physics::kStiffnessUnits, &SyntheticSetup::tilt_n_per_m, optional},
    {"drift", "drift_m_per_s", "drift of the sample, positive upwards; at most half the speed", -1.0, 1.0,
     &physics::kVelocityUnits, &SyntheticSetup::drift_m_per_s, optional},
    {"wave", "wave_N", "amplitude of a wave of interference in the force; its phase follows from the seed", 1e-18, 1e-3,
     &physics::kForceUnits, &SyntheticSetup::wave_n, optional},
    {"wave-period", "wave_period_m", "period of the wave in the height of the base", 1e-10, 1e-3,
     &physics::kLengthUnits, &SyntheticSetup::wave_period_m, of_period},
}};

core::Result<void> apply(std::span<const GivenNumber> given, SyntheticSetup& setup) {
  const fits::ShapeRow& law = law_of(setup);
  if (setup.shape == fits::Shape::Auto) {
    return core::wrong_usage("--law auto chooses a law for a measured curve; name dmt, jkr or maugis");
  }
  if (!law.is_exact && setup.base != fits::Base::Bonded) {
    return core::wrong_usage(fmt::format("--law {} has no use for --base; leave it out", law.name));
  }
  for (const GivenNumber& number : given) setup.*number.field->member = number.si;
  for (const SyntheticField& field : kSyntheticFields) {
    const bool is_given =
        std::any_of(given.begin(), given.end(), [&](const GivenNumber& number) { return number.field == &field; });
    const FieldUse use = field.use(setup);
    if (use == FieldUse::Required && !is_given) {
      const std::string by = field.use == of_period ? "--wave" : fmt::format("--law {}", law.name);
      return core::wrong_usage(fmt::format("{} needs --{}, {}", by, field.option, field.help));
    }
    if (use == FieldUse::None && is_given) {
      return core::wrong_usage(fmt::format("--{}: {}", field.option, remedy(field, setup)));
    }
  }
  if (law.has_layer && !law.is_exact && setup.poisson != 0.5) {
    return core::wrong_usage(
        fmt::format("--law {} needs a Poisson's ratio of 0.5; leave --poisson out, or choose layer-exact-sphere or "
                    "layer-exact-cone",
                    law.name));
  }
  if (setup.bits != std::floor(setup.bits)) return core::wrong_usage("--bits is a whole number, such as 12");
  if (std::abs(setup.drift_m_per_s) > 0.5 * setup.speed_m_per_s) {
    return core::wrong_usage(
        fmt::format("--drift {}: the sample would move faster than half the base's {}; lower it, or raise --speed",
                    physics::format_si(setup.drift_m_per_s, physics::kVelocityUnits.units),
                    physics::format_si(setup.speed_m_per_s, physics::kVelocityUnits.units)));
  }
  return {};
}

}  // namespace afm::curves
