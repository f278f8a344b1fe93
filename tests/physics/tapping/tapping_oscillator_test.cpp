// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_oscillator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "physics/tapping/tapped_sample.h"
#include "support/deep.h"

namespace afm::physics {
namespace tapping_oscillator_test {

using namespace literals;
using support::deep;

constexpr double kPi = std::numbers::pi;

// Criterion: the result for a lever that touches nothing is exact for any step.
TEST(TappingOscillator, IsExactWithoutASample) {
  for (const double ratio : {0.5, 0.9, 1.0, 1.37, 1.5}) {
    for (const int steps : {8, 16, 100, 500}) {
      const TappedSample sample{.q = 3.0, .ratio = ratio, .h_zj = 0.001};
      const DrivenLever lever = sample.lever();
      TappingOscillator tip(sample.surface(Law::Hertz), lever, steps);
      tip.place(1_um, {});  // start from rest: the transient must die, too
      const DirectSwing swing = tip.settle();
      EXPECT_NEAR(swing.state.amplitude.si, 20e-9, 20e-18) << ratio << " " << steps;
      EXPECT_NEAR(swing.state.phase, lever.free_phase, 1e-9) << ratio << " " << steps;
    }
  }
}

struct DirectRow {
  TappedSample sample;
  double z_nm;
  bool from_rest;
  double amplitude_nm, phase_deg, mean_nn, peak_nn, depth_nm, deflection_nm;
};

// Results of RK4 with 1600 and 3200 steps per swing, which agree; from a solver independent of this program.
const DirectRow kDirectRows[] = {
    {{}, 18.5, true, 18.4434161, 112.75438, -0.390106, -0.000156, 0.106299, -0.009753},
    {{}, 17.5, true, 18.9237749, 71.11817, 0.308721, 10.183526, 1.595137, 0.007718},
    {{}, 12.0, true, 13.6164887, 42.90881, 0.711612, 13.579329, 1.789722, 0.01779},
    {{}, 8.0, true, 9.6160619, 28.73836, 0.841148, 13.593035, 1.790486, 0.021029},
    {{.k = 2, .q = 20, .r_nm = 10, .e_gpa = 1},
     20.0,
     false,
     19.8452449,
     97.11972,
     -0.125027,
     -6.7e-5,
     -0.005111,
     -0.062513},
    {{.k = 2, .q = 20, .r_nm = 10, .e_gpa = 1}, 14.0, false, 15.9530629, 52.98987, 0.597987, 9.85077, 2.201086, 0.299},
    {{.k = 2, .q = 20, .r_nm = 10, .e_gpa = 1},
     6.0,
     false,
     8.0749598,
     24.04084,
     0.904584,
     10.981254,
     2.319975,
     0.452298},
    {{.a0_nm = 10}, 5.0, false, 4.8190234, 151.18993, -0.454665, -0.002215, -0.016083, -0.011367},
    {{.k = 5, .q = 100, .a0_nm = 30, .r_nm = 10, .e_gpa = 0.1},
     20.0,
     false,
     27.3658289,
     65.81391,
     0.273225,
     4.874702,
     7.576257,
     0.054641},
    {{.k = 5, .q = 100, .a0_nm = 30, .r_nm = 10, .e_gpa = 0.01},
     20.0,
     false,
     21.64963,
     133.80605,
     -0.536704,
     -6.2e-5,
     1.829082,
     -0.107336},
    {{.k = 0.5, .q = 5, .h_zj = 10, .e_gpa = 0.5},
     15.0,
     false,
     16.8430888,
     58.29739,
     0.529514,
     8.323791,
     2.172687,
     1.059025},
    {{.k = 2, .q = 20, .ratio = 0.98, .r_nm = 10, .e_gpa = 1},
     14.0,
     false,
     15.6821376,
     37.60419,
     0.369791,
     7.473366,
     1.939801,
     0.184888},
    {{.k = 2, .q = 20, .ratio = 1.02, .r_nm = 10, .e_gpa = 1},
     14.0,
     false,
     17.0087541,
     42.07672,
     1.672017,
     20.238369,
     3.201805,
     0.836},
    {{.k = 2, .q = 20, .r_nm = 10, .e_gpa = 1, .eta_w0_mpa = 20},
     14.0,
     false,
     15.9340756,
     54.24208,
     0.580142,
     9.676173,
     2.181428,
     0.290077},
    {{.eta_w0_mpa = 50}, 15.0, true, 16.5319319, 58.71233, 0.502426, 12.105026, 1.704275, 0.01256}};

TEST(TappingOscillator, AgreesWithRungeKuttaAtRest) {
  for (const DirectRow& row : kDirectRows) {
    const auto surface = row.sample.surface();
    const DrivenLever lever = row.sample.lever();
    TappingOscillator tip(surface, lever);
    tip.place(Length(row.z_nm * 1e-9), row.from_rest ? TapState{} : TapState{lever.free_amplitude, lever.free_phase});
    const DirectSwing swing = tip.settle();
    SCOPED_TRACE(row.z_nm);
    EXPECT_NEAR(nm_of(swing.state.amplitude), row.amplitude_nm, 5e-4 * row.amplitude_nm);
    EXPECT_NEAR(degrees_of(swing.state.phase), row.phase_deg, 0.1);
    EXPECT_NEAR(swing.averages.mean.si * 1e9, row.mean_nn, 0.01 * std::abs(row.mean_nn));
    EXPECT_NEAR(swing.averages.peak.si * 1e9, row.peak_nn, 0.01 * std::abs(row.peak_nn));
    EXPECT_NEAR(nm_of(surface->zero_of_indentation() - swing.averages.lowest), row.depth_nm,
                0.01 * std::abs(row.depth_nm));
    EXPECT_NEAR(nm_of(swing.deflection), row.deflection_nm, 0.01 * std::abs(row.deflection_nm));
  }
}

TEST(TappingOscillator, CountsTheHarmonicsLossesOnlyInClevelandsEnergy) {
  for (const auto& [eta, lost_aj, cleveland_aj] : {std::array{0.0, 0.0, 0.08780182392}, {20.0, 1.39544, 1.480669995}}) {
    const TappedSample sample{.k = 2, .q = 20, .r_nm = 10, .e_gpa = 1, .eta_w0_mpa = eta};
    const DrivenLever lever = sample.lever();
    TappingOscillator tip(sample.surface(), lever);
    tip.place(14_nm, {lever.free_amplitude, lever.free_phase});
    const DirectSwing swing = tip.settle();
    const double error = 0.01 * cleveland_aj;
    EXPECT_NEAR(swing.averages.lost.si * 1e18, lost_aj, error);
    EXPECT_NEAR(cleveland_energy(lever, swing.state.amplitude, swing.state.phase).si * 1e18, cleveland_aj, error);
  }
}

// F07 of the table of cases: Cleveland's energy where the drive is at the resonance, sin(phi) = A/A0 + Q E/(pi k A A0).
TEST(TappingOscillator, F07InfersTheEnergyLostFromAmplitudeAndPhase) {
  const DrivenLever lever =
      driven_lever(Stiffness(40.0), {.resonance = Frequency(300e3), .quality_factor = 400.0, .temperature = {}},
                   {20_nm, Frequency(300e3)});
  const double lost_j = cleveland_energy(lever, 15_nm, std::numbers::pi / 3.0).si;
  EXPECT_NEAR(lost_j / 1.093513668e-17, 1.0, 1e-9);
  EXPECT_NEAR(lost_j / 1.602176634e-19 / 68.25175485, 1.0, 1e-9) << "in eV";
}

// Criterion: the identities of virial and energy, for any Q and in any state that repeats itself.
TEST(TappingDeep, IdentitiesOfVirialAndEnergyHold) {
  RandomInteraction random(13);
  const int wanted = deep() ? 100 : 5;
  int checked = 0;
  for (int i = 0; checked < wanted && i < 3 * wanted; ++i) {
    TappedSample sample = random_tapped_sample(random);
    sample.q = random.between(3.0, deep() ? 800.0 : 100.0);
    sample.eta_w0_mpa = i % 2 == 0 ? 0.0 : random.between(1.0, 50.0);
    const DrivenLever lever = sample.lever();
    const Length z(sample.a0_nm * 1e-9 * random.between(0.3, 1.0));
    // fine enough for the identities of continuous time
    TappingOscillator tip(sample.surface(), lever, 2048);
    tip.place(z, {lever.free_amplitude, lever.free_phase});
    const DirectSwing first = tip.settle(), swing = tip.settle();
    if (abs(first.state.amplitude - swing.state.amplitude) > 1e-7 * swing.state.amplitude) continue;  // not at rest
    if (swing.state.amplitude < 0.01 * lever.free_amplitude) continue;  // sticks, with next to no k A^2
    ++checked;
    const double k = sample.k, a = swing.state.amplitude.si, base = lever.base_amplitude.si;
    const double w0 = lever.angular_resonance(), bound = 1e-6 * k * a * a;
    // <F x> = k <x^2> - m <x'^2> - k A a cos(phi)/2, where <x^2> and <x'^2> sum all harmonics
    const double virial = k * swing.mean_square.si - k / (w0 * w0) * swing.mean_square_velocity_si -
                          0.5 * k * a * base * std::cos(swing.state.phase);
    EXPECT_NEAR(swing.full_virial.si, virial, bound) << i << " Q " << sample.q << " k " << k;
    // energy of the drive a swing = loss to the air of all harmonics + loss to the sample
    const double drive = kPi * k * a * base * std::sin(swing.state.phase);
    const double air = k / (w0 * sample.q) * swing.mean_square_velocity_si * 2.0 * kPi / lever.angular_drive();
    EXPECT_NEAR(drive, air + swing.averages.lost.si, bound) << i << " Q " << sample.q << " k " << k;
  }
  EXPECT_EQ(checked, wanted);
}

}  // namespace tapping_oscillator_test
}  // namespace afm::physics
