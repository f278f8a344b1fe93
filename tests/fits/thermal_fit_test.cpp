// SPDX-License-Identifier: Apache-2.0
// Invariant: the 95 % interval of a thermal area is right in 93 to 97 of 100 spectra for Q from 1.5 to 500, even with a
// window
// Invariant: a spectrum that shows no resonance is refused
#include "fits/thermal_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "least_squares.h"
#include "support/deep.h"

namespace afm::fits {
namespace thermal_fit_test {

using Spectrum = std::vector<SpectrumPoint>;

Spectrum exact(const Oscillator& oscillator, double low_hz, double high_hz, std::size_t count) {
  Spectrum spectrum;
  for (std::size_t i = 0; i < count; ++i) {
    const double hz = std::lerp(low_hz, high_hz, static_cast<double>(i) / static_cast<double>(count - 1));
    spectrum.push_back({hz, density_at(oscillator, hz)});
  }
  return spectrum;
}

Spectrum averaged(Spectrum spectrum, double averages, std::mt19937_64& random) {
  std::gamma_distribution<double> mean(averages, 1.0 / averages);
  for (SpectrumPoint& point : spectrum) point.density *= mean(random);
  return spectrum;
}

ThermalFit fitted(const Spectrum& spectrum) {
  std::string why;
  const auto fit = fit_thermal(spectrum, {}, why);
  EXPECT_TRUE(fit) << why;
  return fit.value_or(ThermalFit{});
}

bool has(const ThermalFit& fit, SpectrumDoubt doubt) {
  return std::any_of(fit.doubts.begin(), fit.doubts.end(), [&](const auto& found) { return found.doubt == doubt; });
}

// The lab's cases K02 and K03: densities at 0.9, 1 and 1.1 f0 and the area, by the fluctuation-dissipation theorem.
TEST(Oscillator, HasTheSpectrumOfFluctuationAndDissipation) {
  struct Row {
    Oscillator oscillator;
    double below, at, above;
  };
  for (const Row& row :
       {Row{{70e3, 150.0, 2.058202497e-21, 0.0}, 3.453336087e-27, 2.807769439e-24, 2.826253135e-27},
        Row{{300e3, 450.0, 1.029101248e-22, 0.0}, 1.344154341e-29, 9.827193037e-26, 1.100289654e-29}}) {
    const double f0 = row.oscillator.resonance_hz;
    EXPECT_NEAR(density_at(row.oscillator, 0.9 * f0), row.below, 1e-9 * row.below);
    EXPECT_NEAR(density_at(row.oscillator, f0), row.at, 1e-9 * row.at);
    EXPECT_NEAR(density_at(row.oscillator, 1.1 * f0), row.above, 1e-9 * row.above);
  }
}

TEST(Oscillator, HasTheAreaOfItsSpectrum) {
  const Oscillator oscillator{12e3, 2.5, 4e-20, 0.0};
  constexpr double kStep = 10.0;
  double sum = 0.0;
  for (double hz = 0.5 * kStep; hz < 2e6; hz += kStep) sum += density_at(oscillator, hz) * kStep;
  EXPECT_NEAR(sum, oscillator.area, 1e-6 * oscillator.area);
}

// The lab's case K04: at Q = 2.5 a Lorentzian is 8 % off in frequency and 5 % in Q, and the oscillator in neither.
TEST(ThermalFit, FindsWhatALorentzianMisses) {
  const Spectrum spectrum = exact({12e3, 2.5, 4e-20, 0.0}, 6e3, 18e3, 2001);
  const auto peak = std::max_element(spectrum.begin(), spectrum.end(),
                                     [](const auto& a, const auto& b) { return a.density < b.density; });
  EXPECT_NEAR(peak->frequency_hz / 12e3, 0.9591663, 0.001);

  // ln height, centre over f0, half width over f0; residuals are relative
  std::vector<double> lorentzian{std::log(peak->density), 0.95, 0.2};
  const double squares = least_squares(
      [&](std::span<const double> at, std::span<double> residuals, std::span<double> jacobian) {
        for (std::size_t i = 0; i < spectrum.size(); ++i) {
          const double off = spectrum[i].frequency_hz / 12e3 - at[1], width = at[2];
          const double below = off * off + width * width;
          const double ratio = std::exp(at[0]) * width * width / below / spectrum[i].density;
          if (!residuals.empty()) residuals[i] = ratio - 1.0;
          if (jacobian.empty()) continue;
          jacobian[i] = ratio;
          jacobian[spectrum.size() + i] = ratio * 2.0 * off / below;
          jacobian[2 * spectrum.size() + i] = ratio * (2.0 / width - 2.0 * width / below);
        }
      },
      spectrum.size(), lorentzian);
  ASSERT_TRUE(std::isfinite(squares));
  EXPECT_NEAR(lorentzian[1], 0.91802, 0.01 * 0.91802);
  EXPECT_NEAR(lorentzian[1] / (2.0 * std::abs(lorentzian[2])) / 2.5, 0.94808, 0.01 * 0.94808);

  const ThermalFit fit = fitted(spectrum);
  EXPECT_NEAR(fit.oscillator.resonance_hz, 12e3, 1e-3);
  EXPECT_NEAR(fit.oscillator.quality_factor, 2.5, 1e-6);
}

TEST(ThermalFit, FindsItsOwnSpectrum) {
  for (const double quality : {1.0, 1.5, 2.5, 10.0, 100.0, 500.0}) {
    for (const double floor_share : {0.0, 0.01, 0.3}) {
      Oscillator oscillator{30e3, quality, 1.2e-5, 0.0};
      oscillator.floor = floor_share * density_at(oscillator, 30e3);
      const ThermalFit fit = fitted(exact(oscillator, 2e3, 90e3, 8000));
      EXPECT_NEAR(fit.oscillator.resonance_hz, 30e3, 0.03) << quality;
      EXPECT_NEAR(fit.oscillator.quality_factor, quality, 1e-6 * quality);
      EXPECT_NEAR(fit.oscillator.area, 1.2e-5, 1e-11) << quality;
      EXPECT_NEAR(fit.oscillator.floor, oscillator.floor, 1e-6 * density_at(oscillator, 30e3));
      EXPECT_FALSE(fit.seen_averages);
      EXPECT_TRUE(fit.doubts.empty());
    }
  }
}

// Q from 1.5 to 500, evenly in its logarithm, with a floor: the lab's criterion 21.
TEST(CoverageOfAThermalFit, IsNinetyFivePercentAndTheAreaUnbiased) {
  const int spectra = support::draws(1000);
  for (const double averages : {20.0, 100.0}) {
    std::mt19937_64 random(static_cast<unsigned>(averages));
    std::uniform_real_distribution<double> log_quality(std::log(1.5), std::log(500.0)), share(0.001, 0.1);
    int held = 0;
    double bias = 0.0, deviation = 0.0;
    for (int i = 0; i < spectra; ++i) {
      Oscillator truth{40e3, std::exp(log_quality(random)), 1.2e-5, 0.0};
      truth.floor = share(random) * density_at(truth, truth.resonance_hz);
      const double reach_hz = std::min(0.95 * truth.resonance_hz, 30.0 * truth.resonance_hz / truth.quality_factor);
      const Spectrum spectrum = exact(truth, truth.resonance_hz - reach_hz, truth.resonance_hz + 2.0 * reach_hz, 2000);
      const ThermalFit fit = fitted(averaged(spectrum, averages, random));
      if (fit.area.low <= truth.area && truth.area <= fit.area.high) ++held;
      // bias of the spring constant
      bias += (truth.area / fit.oscillator.area - 1.0) / spectra;
      deviation += fit.area_deviation / spectra;
    }
    const double covered = static_cast<double>(held) / spectra;
    const double chance = support::deep() ? 0.0 : 3.0 * std::sqrt(0.95 * 0.05 / spectra);
    EXPECT_GT(covered, 0.93 - chance) << averages;
    EXPECT_LT(covered, 0.97 + chance) << averages;
    EXPECT_LT(std::abs(bias), support::deep() ? 0.005 : 0.005 + 4.0 * deviation / std::sqrt(spectra)) << averages;
  }
}

// A Hann window adds a quarter of either neighbour's amplitude, with the other sign, to a half of each.
TEST(CoverageOfAThermalFit, HoldsBehindAWindow) {
  const int spectra = support::draws(1000);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const Oscillator truth{40e3, 20.0, 1.2e-5, 1e-13};
  const Spectrum spectrum = exact(truth, 20e3, 80e3, 1500);
  constexpr int kAverages = 10;
  int held = 0;
  for (int i = 0; i < spectra; ++i) {
    Spectrum seen(spectrum);
    for (SpectrumPoint& point : seen) point.density = 0.0;
    for (int average = 0; average < 2 * kAverages; ++average) {  // real and imaginary parts
      std::vector<double> amplitudes;
      for (const SpectrumPoint& point : spectrum) amplitudes.push_back(std::sqrt(0.5 * point.density) * normal(random));
      for (std::size_t at = 0; at < seen.size(); ++at) {
        const double below = at > 0 ? amplitudes[at - 1] : 0.0, above = at + 1 < seen.size() ? amplitudes[at + 1] : 0.0;
        seen[at].density += std::pow(0.5 * amplitudes[at] - 0.25 * (below + above), 2) / 0.375 / kAverages;
      }
    }
    seen.erase(seen.begin());
    seen.pop_back();
    const ThermalFit fit = fitted(seen);
    EXPECT_GT(fit.neighbour_factor, 1.4);
    EXPECT_FALSE(has(fit, SpectrumDoubt::Correlated)) << fit.neighbour_factor;
    if (fit.area.low <= truth.area && truth.area <= fit.area.high) ++held;
  }
  const double covered = static_cast<double>(held) / spectra;
  const double chance = support::deep() ? 0.0 : 3.0 * std::sqrt(0.95 * 0.05 / spectra);
  EXPECT_GT(covered, 0.93 - chance);
  EXPECT_LT(covered, 0.97 + chance);
}

TEST(ThermalFit, SaysWhyAnAreaIsDoubtful) {
  std::mt19937_64 random(4);
  const Oscillator oscillator{70e3, 150.0, 1.2e-5, 1e-12};
  const Spectrum good = averaged(exact(oscillator, 50e3, 90e3, 2000), 50.0, random);
  EXPECT_TRUE(fitted(good).doubts.empty());

  Spectrum with_drift(good);
  for (SpectrumPoint& point : with_drift) point.density += 1e-10 * std::pow(50e3 / point.frequency_hz, 2);
  EXPECT_TRUE(has(fitted(with_drift), SpectrumDoubt::OtherShape));

  const Spectrum coarse = averaged(exact({70e3, 2000.0, 1.2e-5, 1e-12}, 1e3, 200e3, 2000), 50.0, random);
  EXPECT_TRUE(has(fitted(coarse), SpectrumDoubt::TooCoarse));

  const Spectrum weak = averaged(exact({70e3, 20.0, 1.2e-5, 4e-9}, 50e3, 90e3, 500), 5.0, random);
  EXPECT_TRUE(has(fitted(weak), SpectrumDoubt::Unknown));

  // a spectrum that was interpolated to four times as many points
  Spectrum dense;
  for (std::size_t i = 0; i + 1 < good.size(); ++i) {
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      dense.push_back({std::lerp(good[i].frequency_hz, good[i + 1].frequency_hz, share),
                       std::lerp(good[i].density, good[i + 1].density, share)});
    }
  }
  EXPECT_TRUE(has(fitted(dense), SpectrumDoubt::Correlated));
  EXPECT_FALSE(has(fitted(good), SpectrumDoubt::Correlated));

  std::string why;
  const auto fewer = fit_thermal(good, 500.0, why);
  ASSERT_TRUE(fewer);
  EXPECT_TRUE(has(*fewer, SpectrumDoubt::FewerAverages));
}

TEST(ThermalFit, RefusesWhatIsNoSpectrumOfALever) {
  std::mt19937_64 random(5);
  const Spectrum good = exact({70e3, 150.0, 1.2e-5, 1e-12}, 50e3, 90e3, 500);
  Spectrum zero(good), nan(good), falling(good), level(good), growing(good);
  zero[7].density = 0.0;
  nan[7].density = std::numeric_limits<double>::quiet_NaN();
  falling[7].frequency_hz = falling[6].frequency_hz;
  for (SpectrumPoint& point : level) point.density = 3.0;
  for (SpectrumPoint& point : growing) point.density = std::exp(point.frequency_hz / 300.0);
  const Spectrum few(good.begin(), good.begin() + 19), before(good.begin(), good.begin() + 200);
  for (const Spectrum& spectrum : {zero, nan, falling, level, growing, few, before, Spectrum{}}) {
    std::string why;
    EXPECT_FALSE(fit_thermal(spectrum, {}, why)) << spectrum.size();
    EXPECT_NE(why, "");
  }
}

}  // namespace thermal_fit_test
}  // namespace afm::fits
