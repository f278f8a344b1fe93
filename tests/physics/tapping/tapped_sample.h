// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "physics/random_interaction.h"
#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"

namespace afm::physics {

// Set-up in the units of the field: a DMT contact with the distance a0 = 0.165 nm, a lever of 300 kHz and its drive.
struct TappedSample {
  double k = 40.0;          // spring constant, N/m
  double q = 400.0;         // quality factor
  double ratio = 1.0;       // ratio of drive to resonance
  double a0_nm = 20.0;      // free amplitude
  double r_nm = 20.0;       // tip radius
  double h_zj = 64.0;       // Hamaker constant
  double e_gpa = 1.5;       // reduced modulus
  double eta_w0_mpa = 0.0;  // viscosity times w0
  double gap_nm = 0.165;    // distance of bodies in contact

  static constexpr double kResonance = 300e3;

  ContactParameters contact() const {
    ContactParameters c;
    c.tip_radius = Length(r_nm * 1e-9);
    c.spring_constant = Stiffness(k);
    c.sample_stiffness = Stiffness(HUGE_VAL);
    c.hamaker = Energy(h_zj * 1e-21);
    // F_ad = H R/(6 a0^2) = 2 pi R W, W twice the mean surface energy
    c.mean_surface_energy = SurfaceEnergy(h_zj * 1e-21 / (24.0 * std::numbers::pi * gap_nm * gap_nm * 1e-18));
    c.reduced_modulus = Pressure(e_gpa * 1e9);
    return c;
  }
  std::shared_ptr<const TapSurface> surface(Law law = Law::Dmt) const {
    const double w0 = 2.0 * std::numbers::pi * kResonance;
    return std::make_shared<const TapSurface>(law, contact(), LawOptions{}, Viscosity(eta_w0_mpa * 1e6 / w0));
  }
  DrivenLever lever() const {
    return driven_lever(Stiffness(k), {Frequency(kResonance), q, Temperature()},
                        {Length(a0_nm * 1e-9), Frequency(ratio * kResonance)});
  }
};

// Random set-ups in air and vacuum, evenly over the orders of magnitude of each number.
inline TappedSample random_tapped_sample(RandomInteraction& random) {
  return {.k = random.between(0.1, 50.0),
          .q = random.between(100.0, 800.0),
          .a0_nm = random.between(5.0, 60.0),
          .r_nm = random.between(5.0, 50.0),
          .h_zj = random.between(10.0, 200.0),
          .e_gpa = random.between(0.05, 100.0)};
}

constexpr double degrees_of(double rad) { return rad * 180.0 / std::numbers::pi; }
constexpr double nm_of(Length length) { return length.si * 1e9; }

}  // namespace afm::physics
