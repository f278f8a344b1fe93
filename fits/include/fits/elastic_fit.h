// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fits/indenter.h"
#include "fits/interval.h"
#include "fits/uncertainty.h"
#include "physics/rows_of_enum.h"

// Fit of an elastic contact to the approach of a force curve, or of a law of adhesion to both branches (docs/fits.md).
// Any thread; allocates.
namespace afm::fits {

// Variable of which the force is a function.
enum class Against {
  Z,    // height of the lever's base: lever and contact in series, and only the force is noisy
  Tip,  // tip position Z + F/k, as in nanite and AtomicJ: its noise is also that of the force
};

struct AgainstName {
  Against against;
  std::string_view name;
};
inline constexpr std::array kAgainst{AgainstName{Against::Z, "z"}, AgainstName{Against::Tip, "tip"}};
static_assert(physics::has_row_for_each(kAgainst, &AgainstName::against));

// One point, in the order of recording.
struct Sample {
  double z_m = 0;       // height of the lever's base; smaller is deeper
  double force_n = 0;   // force of the lever, positive away from the sample, with an arbitrary zero
  bool sticks = false;  // touches the sample; only for a law of adhesion, whose force is not a function of the height
};

struct FitSetup {
  Indenter indenter;
  double poisson = 0.5;                  // Poisson's ratio of the sample, 0 to 0.5
  double spring_n_per_m = 0;             // stiffness of the lever, positive
  double pull_off_n = 0;                 // strongest pull of the retract, a magnitude; 0: unknown, or none
  std::optional<double> pull_off_z_m{};  // height of the base at which the recorded tip jumps off
  double zero_n = 0;                     // force of the free lever, only for Against::Tip
  Against against = Against::Z;
  bool tilt = false;           // true: fits a slope of the baseline as well
  bool white = false;          // true: assumes white noise: ordinary least squares, as in nanite and AtomicJ
  bool interval = true;        // false: no intervals, to measure their cost
  std::vector<double> starts;  // contact points from which the fit begins, m; the best result counts
  std::vector<Uncertainty> uncertainties{};  // uncertainties of the inputs
  std::size_t bootstraps = 0;                // number of fits to resampled residuals; 0: none
};

// Reasons not to trust a modulus, in the order of kDoubts.
enum class Doubt {
  NeverPushed,
  Saturated,
  LeverTooSoft,
  Unknown,
  FewPoints,
  Shallow,
  Adhesive,
  BeyondTip,
  BeyondLayer,
  NotLevel,
  NotRandom,
  Misfit,
  ShortBaseline,
  PullOffForce,
  PullOffPlace,
  BeyondDmt,
  BelowJkr,
};

// Comparison behind a doubt.
struct DoubtRow {
  enum class Side { Above, Below };

  Doubt doubt;
  bool fatal;  // true: the modulus is meaningless
  Side side;   // side of the limit on which a figure is doubtful
  double limit;
  std::string_view name;  // name of the doubt with its figure, in reports
};
extern const std::array<DoubtRow, 17> kDoubts;

const DoubtRow& row_of(Doubt doubt);

// Points in a row at the greatest force, over those that a usual force lasts: the figure of Doubt::Saturated. At least
// one sample, in the order of time; forces within the tolerance count as one.
double points_at_greatest_force(std::span<const Sample> samples, double tolerance_n);

enum class Trust { Trusted, Doubtful, No };
std::string_view name_of(Trust trust);

struct Found {
  Doubt doubt;
  double figure;                 // value compared with the limit of the doubt's row
  std::optional<Shape> advised;  // law of adhesion to try instead
};

// Results of a law of adhesion in addition to the modulus.
struct Adhesion {
  double work_j_per_m2 = 0;  // work of adhesion
  Interval work_interval;    // 95 % interval of the work, J/m^2
  double pull_off_n = 0;     // strongest pull of the model, a magnitude
  double pull_off_z_m = 0;   // height of the base at which the model's tip jumps off with this lever
  double tabor = 0;          // Tabor's parameter, for the setup's atomic distance
  std::size_t rounds = 0;    // number of fits of Shape::Auto until the law stayed the same; 0: the law was given
};

// Intervals by a bootstrap of moving blocks of residuals.
struct Bootstrap {
  Interval modulus_pa{};     // Young's modulus
  Interval work_j_per_m2{};  // work of adhesion, for a law of adhesion
  std::size_t fits = 0;      // number of fits that converged
  std::size_t block = 0;     // number of samples in a block
};

struct ElasticFit {
  Shape shape = Shape::Paraboloid;  // shape of the setup; with Auto the law that was chosen
  double modulus_pa = 0;            // Young's modulus for the setup's Poisson ratio
  double reduced_modulus_pa = 0;    // reduced modulus, E/(1 - nu^2)
  Interval modulus_interval_pa;     // interval by the profile likelihood of the whitened fit, within a factor of 148
  double contact_z_m = 0;           // height of the base, or of the tip with Against::Tip, at contact
  double level_n = 0;               // baseline at the first sample
  double tilt_n_per_m = 0;
  double depth_m = 0;      // largest depth of the model's tip
  double noise_n = 0;      // rms of the residuals before contact, or of all residuals if these are few
  double rms_n = 0;        // rms of all residuals
  std::size_t points = 0;  // total number of samples
  std::size_t in_contact = 0;
  std::optional<std::size_t> noise_order;       // autoregressive order, 0 to 4; empty: noise assumed white, or no noise
  std::vector<double> noise;                    // autoregressive coefficients of the noise
  double runs_p = 1;                            // probability of as few runs of the whitened residuals, or fewer
  std::optional<double> half_depth_modulus_pa;  // modulus from the upper half of the depth
  Trust trust = Trust::Trusted;
  std::vector<Found> doubts;
  std::optional<Adhesion> adhesion;
  std::vector<Systematic> systematic;  // effect of each of the setup's uncertainties; NaN where no fit was found
  std::optional<Bootstrap> bootstrap;  // intervals by a bootstrap; empty: not requested, or too few fits converged
  std::vector<double> model_n;         // force of the model at each sample, including the baseline
};

// Fits reduced modulus, contact point, level, the tilt if requested and, for a law of adhesion, the work of adhesion to
// all samples. Empty, with the reason in `why`, if there are fewer than 10 samples, one is not finite, all have the
// same Z, or no start leads to a modulus; for a law of adhesion also without a pull, or with fewer than 10 free or 10
// sticking samples.
std::optional<ElasticFit> fit(std::span<const Sample> samples, const FitSetup& setup, std::string& why);

}  // namespace afm::fits
