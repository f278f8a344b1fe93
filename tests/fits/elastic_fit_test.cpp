// SPDX-License-Identifier: Apache-2.0
// Invariant: the 95 % interval of a modulus is right in 93 to 97 of 100 curves with white, low-passed or quantised
// noise
// Invariant: a curve without contact is refused or untrusted
#include "fits/elastic_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/deep.h"

namespace afm::fits {
namespace elastic_fit_test {

constexpr double kSpring = 0.05, kLevel = 0.1e-9;

enum class Noise { None, White, LowPass, Waves, Steps };

Indenter indenter(Shape shape) {
  const ShapeRow& row = row_of(shape);
  return {.shape = shape,
          .radius_m = row.has_radius ? 5e-6 : 0.0,
          .half_angle_rad = row.has_radius ? 0.0 : 0.4,
          .layer_m = row.has_layer ? 8e-6 : 0.0,
          .table = row.is_exact ? exact_table(shape, Base::Bonded, 0.4) : nullptr};
}

// An approach from 2 um above the contact to 1.5 um below, as in the lab's cases P25 to P27.
class Curves {
 public:
  explicit Curves(unsigned seed) : random_(seed) {}

  std::vector<Sample> approach(const Indenter& tip, double reduced_pa, Noise noise) {
    constexpr std::size_t kCount = 1000;
    constexpr double kRms = 15e-12, kLowPass = 0.9, kWave = 60e-12, kWaveLength = 0.35e-6, kStep = 20e-9 / 4096.0;
    std::vector<Sample> samples;
    const double phase = std::uniform_real_distribution<double>(0.0, 2.0 * std::numbers::pi)(random_);
    double slow = 0.0;
    for (std::size_t t = 0; t < kCount; ++t) {
      const double z_m = 2e-6 - 3.5e-6 * static_cast<double>(t) / static_cast<double>(kCount - 1);
      double force_n = kLevel + pushed_n(tip, reduced_pa, -z_m);
      const double white = kRms * white_(random_);
      if (noise == Noise::LowPass) {
        slow = t == 0 ? white : kLowPass * slow + std::sqrt(1.0 - kLowPass * kLowPass) * white;
        force_n += slow;
      } else if (noise != Noise::None) {
        force_n += white;
      }
      if (noise == Noise::Waves) force_n += kWave * std::sin(phase + 2.0 * std::numbers::pi * z_m / kWaveLength);
      if (noise == Noise::Steps) force_n = kStep * std::round(force_n / kStep);
      samples.push_back({z_m, force_n});
    }
    return samples;
  }

 private:
  // Lever and contact in series, by bisection.
  static double pushed_n(const Indenter& tip, double reduced_pa, double way_m) {
    if (way_m <= 0.0) return 0.0;
    double low = 0.0, high = way_m;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (middle + reduced_pa * push_of(tip, middle).force / kSpring < way_m ? low : high) = middle;
    }
    return reduced_pa * push_of(tip, low).force;
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> white_;
};

FitSetup setup_of(const Indenter& tip) {
  FitSetup setup;
  setup.indenter = tip;
  setup.spring_n_per_m = kSpring;
  setup.starts = {0.3e-6};
  return setup;
}

ElasticFit fitted(const std::vector<Sample>& samples, const FitSetup& setup) {
  std::string why;
  auto found = fit(samples, setup, why);
  EXPECT_TRUE(found) << why;
  return found ? std::move(*found) : ElasticFit{};
}

bool has(const ElasticFit& fit, Doubt doubt) {
  return std::any_of(fit.doubts.begin(), fit.doubts.end(), [&](const Found& found) { return found.doubt == doubt; });
}

// Fit from a start 0.3 um off, without noise.
TEST(ElasticFit, FindsTheModulusOfACurveOfTheSameLaw) {
  for (const ShapeRow& row : kShapes) {
    if (row.is_adhesive) continue;
    for (const double reduced_pa : {400.0, 4e3, 1e5}) {
      const Indenter tip = indenter(row.shape);
      for (const AgainstName& against : kAgainst) {
        FitSetup setup = setup_of(tip);
        setup.against = against.against;
        const ElasticFit fit = fitted(Curves(1).approach(tip, reduced_pa, Noise::None), setup);
        EXPECT_NEAR(fit.reduced_modulus_pa, reduced_pa, 1e-6 * reduced_pa) << row.name << ", " << against.name;
        EXPECT_NEAR(fit.modulus_pa, 0.75 * fit.reduced_modulus_pa, 1e-9 * reduced_pa);
        EXPECT_NEAR(fit.level_n, kLevel, 1e-14);
      }
    }
  }
}

TEST(ElasticFit, FindsATiltIfAskedTo) {
  const Indenter tip = indenter(Shape::Sphere);
  std::vector<Sample> samples = Curves(2).approach(tip, 4e3, Noise::None);
  const double first_m = samples.front().z_m;
  for (Sample& sample : samples) sample.force_n += 2e-4 * (sample.z_m - first_m);
  FitSetup setup = setup_of(tip);
  setup.tilt = true;
  const ElasticFit fit = fitted(samples, setup);
  EXPECT_NEAR(fit.reduced_modulus_pa, 4e3, 0.01);
  EXPECT_NEAR(fit.tilt_n_per_m, 2e-4, 1e-9);
}

// Of what kind the noise is, how stiff the sample: up to 50 times the lever. Textbook intervals hold the truth in 0.31
// of the curves with low-passed noise (P26).
TEST(CoverageOfAFit, IsNinetyFivePercentWhateverTheNoise) {
  const Indenter tip = indenter(Shape::Paraboloid);
  const int curves = support::draws(1000);
  for (const double reduced_pa : {400.0, 4e3, 120e3, 1.2e6, 2.65e6}) {
    if (!support::deep() && reduced_pa != 4e3) continue;
    for (const Noise noise : {Noise::White, Noise::LowPass, Noise::Waves, Noise::Steps}) {
      Curves source(static_cast<unsigned>(reduced_pa) + static_cast<unsigned>(noise));
      int held = 0;
      double off = 0.0, deviations = 0.0;
      for (int i = 0; i < curves; ++i) {
        const ElasticFit fit = fitted(source.approach(tip, reduced_pa, noise), setup_of(tip));
        const double truth_pa = 0.75 * reduced_pa;
        if (fit.modulus_interval_pa.low <= truth_pa && truth_pa <= fit.modulus_interval_pa.high) ++held;
        off += std::log(fit.modulus_pa / truth_pa) / curves;
        deviations += std::log(fit.modulus_interval_pa.high / fit.modulus_interval_pa.low) / (2.0 * 1.96) / curves;
      }
      const double share = static_cast<double>(held) / curves;
      const double chance = 3.0 * std::sqrt(0.95 * 0.05 / curves);
      const std::string what = std::to_string(reduced_pa) + " Pa, noise " + std::to_string(static_cast<int>(noise)) +
                               ": " + std::to_string(share) + ", off by " + std::to_string(off / deviations);
      EXPECT_GT(share, 0.93 - (support::deep() ? 0.0 : chance)) << what;
      if (noise != Noise::Waves) {
        EXPECT_LT(share, 0.97 + (support::deep() ? 0.0 : chance)) << what;
      }
      EXPECT_LT(std::abs(off), (support::deep() ? 0.1 : 0.35) * deviations) << what;
    }
  }
}

// Blocks of residuals keep the noise's memory: the interval is as wide as that of the likelihood.
TEST(BootstrapOfAFit, IsAsWideAsTheProfileWhateverTheNoise) {
  const Indenter tip = indenter(Shape::Paraboloid);
  FitSetup setup = setup_of(tip);
  setup.bootstraps = 200;
  for (const Noise noise : {Noise::White, Noise::LowPass}) {
    Curves source(7);
    double ratio = 0.0;
    constexpr int kCurves = 8;
    for (int i = 0; i < kCurves; ++i) {
      const std::vector<Sample> samples = source.approach(tip, 4e3, noise);
      const ElasticFit fit = fitted(samples, setup);
      ASSERT_TRUE(fit.bootstrap);
      const Bootstrap& found = *fit.bootstrap;
      EXPECT_EQ(found.fits, 200U);
      EXPECT_GT(fit.modulus_pa, found.modulus_pa.low);
      EXPECT_LT(fit.modulus_pa, found.modulus_pa.high);
      ratio += std::log(found.modulus_pa.high / found.modulus_pa.low) /
               std::log(fit.modulus_interval_pa.high / fit.modulus_interval_pa.low) / kCurves;
      const ElasticFit again = fitted(samples, setup);
      EXPECT_EQ(again.bootstrap->modulus_pa.low, found.modulus_pa.low) << "the same bytes";
      if (noise == Noise::LowPass) {
        EXPECT_GT(found.block, 30U) << "longer than the noise remembers";
      }
    }
    EXPECT_GT(ratio, 0.8) << static_cast<int>(noise);
    EXPECT_LT(ratio, 1.2) << static_cast<int>(noise);
  }
  EXPECT_FALSE(fitted(Curves(7).approach(tip, 4e3, Noise::White), setup_of(tip)).bootstrap) << "only when asked for";
}

// Less than that of the profile: residuals are smaller than the noise, and a curve has few blocks.
TEST(CoverageOfABootstrap, IsThatOfTheManual) {
  const Indenter tip = indenter(Shape::Paraboloid);
  FitSetup setup = setup_of(tip);
  setup.bootstraps = 200;
  const int curves = support::draws(300);
  for (const Noise noise : {Noise::White, Noise::LowPass}) {
    Curves source(11);
    int held = 0;
    for (int i = 0; i < curves; ++i) {
      const ElasticFit fit = fitted(source.approach(tip, 4e3, noise), setup);
      const double truth_pa = 0.75 * 4e3;
      if (fit.bootstrap->modulus_pa.low <= truth_pa && truth_pa <= fit.bootstrap->modulus_pa.high) ++held;
    }
    const double share = static_cast<double>(held) / curves;
    const double known = noise == Noise::White ? 0.923 : 0.857;  // fraction of 300 curves
    EXPECT_NEAR(share, known, 3.0 * std::sqrt(known * (1.0 - known) / curves))
        << static_cast<int>(noise) << ": " << share;
  }
}

TEST(ElasticFit, IsTrustedWhereTheCurveIsTheShapes) {
  const Indenter tip = indenter(Shape::Sphere);
  const ElasticFit fit = fitted(Curves(3).approach(tip, 4e3, Noise::White), setup_of(tip));
  EXPECT_EQ(fit.trust, Trust::Trusted);
  EXPECT_TRUE(fit.doubts.empty());
}

TEST(ElasticFit, SaysWhyAModulusIsDoubtful) {
  const Indenter sphere = indenter(Shape::Sphere), cone = indenter(Shape::Cone);
  const std::vector<Sample> pushed = Curves(4).approach(sphere, 4e3, Noise::White);

  const ElasticFit wrong_shape = fitted(Curves(4).approach(cone, 40e3, Noise::White), setup_of(sphere));
  EXPECT_TRUE(has(wrong_shape, Doubt::NotLevel));
  EXPECT_EQ(wrong_shape.trust, Trust::Doubtful);

  const ElasticFit stiff = fitted(Curves(4).approach(sphere, 4e6, Noise::White), setup_of(sphere));
  EXPECT_TRUE(has(stiff, Doubt::LeverTooSoft));

  FitSetup sticking = setup_of(sphere);
  sticking.pull_off_n = 0.06 * pushed.back().force_n;
  EXPECT_TRUE(has(fitted(pushed, sticking), Doubt::Adhesive));
  EXPECT_EQ(fitted(pushed, sticking).trust, Trust::Doubtful);

  std::vector<Sample> flat(pushed);
  for (Sample& sample : flat) sample.force_n = std::min(sample.force_n, 5e-9);
  EXPECT_TRUE(has(fitted(flat, setup_of(sphere)), Doubt::Saturated));
  EXPECT_EQ(fitted(flat, setup_of(sphere)).trust, Trust::No);

  const std::vector<Sample> inside(pushed.begin() + 600, pushed.end());
  EXPECT_TRUE(has(fitted(inside, setup_of(sphere)), Doubt::ShortBaseline));

  Indenter thin = indenter(Shape::LayerSphere);
  thin.layer_m = 1e-6;
  EXPECT_TRUE(has(fitted(Curves(4).approach(thin, 4e3, Noise::White), setup_of(thin)), Doubt::BeyondLayer));
}

// A cone on a sphere's curve: a filter that takes the misfit for noise leaves residuals that look random.
TEST(ElasticFit, ThatLeavesTheCurveIsDoubtful) {
  const Indenter sphere = indenter(Shape::Sphere), cone = indenter(Shape::Cone);
  for (const double reduced_pa : {400.0, 4e3, 40e3}) {
    const ElasticFit fit = fitted(Curves(8).approach(sphere, reduced_pa, Noise::White), setup_of(cone));
    EXPECT_TRUE(has(fit, Doubt::Misfit)) << reduced_pa << ": " << fit.rms_n << " beside " << fit.noise_n;
    EXPECT_EQ(fit.trust, Trust::Doubtful) << reduced_pa;
  }
}

// Whatever the noise, and with a tenth of the points before contact.
TEST(ElasticFit, OfTheSameShapeDoesNotLeaveTheCurve) {
  const Indenter tip = indenter(Shape::Paraboloid);
  for (const double reduced_pa : {4e3, 120e3}) {
    for (const Noise noise : {Noise::White, Noise::LowPass, Noise::Waves, Noise::Steps}) {
      Curves source(7);
      for (int i = 0; i < support::draws(100); ++i) {
        std::vector<Sample> samples = source.approach(tip, reduced_pa, noise);
        if (i % 2 == 1) samples.erase(samples.begin(), samples.begin() + 500);
        const ElasticFit fit = fitted(samples, setup_of(tip));
        EXPECT_FALSE(has(fit, Doubt::Misfit))
            << reduced_pa << " Pa, noise " << static_cast<int>(noise) << ": " << fit.rms_n << " beside " << fit.noise_n;
      }
    }
  }
}

// Each row has its own limit and side, in the order of the doubts.
TEST(ElasticFit, HasItsDoubtsInOneTable) {
  for (std::size_t i = 0; i < kDoubts.size(); ++i) {
    EXPECT_EQ(kDoubts[i].doubt, static_cast<Doubt>(i));
    EXPECT_GT(kDoubts[i].limit, 0.0) << kDoubts[i].name;
  }
}

// Forces in steps as large as twice the noise, and so many points that each step lasts.
TEST(ElasticFit, OfADigitisedCurveIsTrusted) {
  const Indenter tip = indenter(Shape::Sphere);
  const auto digitised = [&](unsigned seed, double step_n, std::size_t repeated) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 2e-12);
    std::vector<Sample> samples;
    const std::vector<Sample> exact = Curves(seed).approach(tip, 4e3, repeated > 1 ? Noise::None : Noise::White);
    for (std::size_t t = 0; t + 1 < exact.size(); ++t) {
      for (std::size_t i = 0; i < repeated; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(repeated);
        const double force_n = std::lerp(exact[t].force_n, exact[t + 1].force_n, share) + noise(random);
        samples.push_back({std::lerp(exact[t].z_m, exact[t + 1].z_m, share), step_n * std::round(force_n / step_n)});
      }
    }
    return samples;
  };
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const auto& [step_n, repeated] : {std::pair(30e-12, 1U), std::pair(45e-12, 1U), std::pair(25e-12, 20U)}) {
      const ElasticFit fit = fitted(digitised(seed, step_n, repeated), setup_of(tip));
      EXPECT_FALSE(has(fit, Doubt::NotRandom)) << step_n;
      EXPECT_FALSE(has(fit, Doubt::Saturated)) << step_n;
      EXPECT_NE(fit.trust, Trust::No) << step_n;
      EXPECT_NEAR(fit.reduced_modulus_pa, 4e3, 20.0) << step_n;
    }
  }
}

// Eight bits: few digits of push, each at dozens of points, with noise between two of them.
TEST(ElasticFit, OfFewDigitsDoesNotLookSaturated) {
  std::mt19937_64 random(1);
  for (const auto& [digits, end] :
       {std::pair(2.0, 9.0), std::pair(3.0, 9.0), std::pair(5.0, 9.0), std::pair(10.0, 99.0), std::pair(40.0, 12.0)}) {
    for (const double noise_digits : {0.02, 0.1}) {
      std::normal_distribution<double> noise(0.0, noise_digits);
      std::vector<Sample> samples;
      for (int i = 0; i < 1000; ++i) {
        const double push = digits * std::pow(std::max(0.0, 0.002 * i - 1.0), 1.5);
        samples.push_back({-1e-9 * i, std::min(std::round(push + noise(random)), end)});
      }
      const bool ends = points_at_greatest_force(samples, 0.05) > row_of(Doubt::Saturated).limit;
      EXPECT_EQ(ends, end < digits) << digits << " digits, noise " << noise_digits << ", end " << end;
    }
  }
}

// The contact point against the tip position is where the undeflected tip touches, whatever the detector's zero.
TEST(ElasticFit, FindsTheContactPointWithoutTheDetectorsZero) {
  const Indenter tip = indenter(Shape::Sphere);
  FitSetup setup = setup_of(tip);
  setup.against = Against::Tip;
  setup.zero_n = kLevel;
  EXPECT_NEAR(fitted(Curves(6).approach(tip, 4e3, Noise::None), setup).contact_z_m, 0.0, 1e-12);
}

// Lab case K10: E ~ 1/sensitivity with the k of a thermal tune, where the sample gives way much more than the lever.
TEST(ElasticFit, HasTheShareOfEachError) {
  const Indenter tip = indenter(Shape::Cone);
  FitSetup setup = setup_of(tip);
  setup.uncertainties = {{Given::SpringConstant, 0.05}, {Given::Sensitivity, 0.03}, {Given::HalfAngle, 0.02}};
  const ElasticFit fit = fitted(Curves(8).approach(tip, 40.0, Noise::None), setup);
  ASSERT_EQ(fit.systematic.size(), 3U);
  EXPECT_NEAR(fit.systematic[0].modulus_share, 0.05, 1e-5);
  EXPECT_NEAR(fit.systematic[1].modulus_share, 0.03, 1e-3);
  // d ln tan(a)/d ln a = a/(sin(a) cos(a))
  EXPECT_NEAR(fit.systematic[2].modulus_share, 0.02 * 0.4 / (std::sin(0.4) * std::cos(0.4)), 1e-4);
  EXPECT_TRUE(fitted(Curves(8).approach(tip, 40.0, Noise::None), setup_of(tip)).systematic.empty());
}

// Both with a fitted tilt and without.
TEST(ElasticFit, OfATiltedBaselineAloneIsNotTrusted) {
  for (const double tilt_n_per_m : {-1e-3, -5e-4, 5e-4, 1e-3}) {
    for (const unsigned seed : {20U, 21U, 22U}) {
      std::vector<Sample> samples = Curves(seed).approach(indenter(Shape::Sphere), 4e3, Noise::White);
      samples.resize(550);  // part before contact
      for (Sample& sample : samples) sample.force_n += tilt_n_per_m * sample.z_m;
      FitSetup setup = setup_of(indenter(Shape::Sphere));
      setup.tilt = true;
      std::string why;
      const auto found = fit(samples, setup, why);
      if (found) {
        EXPECT_EQ(found->trust, Trust::No) << tilt_n_per_m << ", " << seed << ": " << found->modulus_pa;
      }
      setup.tilt = false;
      const auto without = fit(samples, setup, why);
      if (without) {
        EXPECT_NE(without->trust, Trust::Trusted) << tilt_n_per_m << ", " << seed;
      }
    }
  }
}

// Trusted nowhere, and an exception nowhere.
TEST(ElasticFit, OfACurveThatIsNoneIsRefusedOrNotTrusted) {
  const Indenter tip = indenter(Shape::Sphere);
  const std::vector<Sample> pushed = Curves(5).approach(tip, 4e3, Noise::White);
  std::vector<Sample> without(pushed.begin(), pushed.begin() + 500), turned(pushed), dead(pushed), nan(pushed),
      still(pushed);
  for (Sample& sample : turned) sample.force_n = -sample.force_n;
  for (Sample& sample : dead) sample.force_n = 1e-9;
  for (Sample& sample : nan) sample.force_n = std::numeric_limits<double>::quiet_NaN();
  for (Sample& sample : still) sample.z_m = 1e-6;
  const std::vector<Sample> five(pushed.begin(), pushed.begin() + 5);
  for (const auto& samples : {without, turned, dead, nan, still, five, std::vector<Sample>{}}) {
    std::string why;
    const auto found = fit(samples, setup_of(tip), why);
    if (found) {
      EXPECT_EQ(found->trust, Trust::No) << samples.size() << ": " << found->modulus_pa;
      for (const Found& doubt : found->doubts) EXPECT_FALSE(std::isnan(doubt.figure)) << row_of(doubt.doubt).name;
    } else {
      EXPECT_NE(why, "");
    }
  }
}

}  // namespace elastic_fit_test
}  // namespace afm::fits
