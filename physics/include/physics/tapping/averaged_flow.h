// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"
#include "physics/units.h"

namespace afm::physics {

class SwingShape;

// Amplitude and phase of a swing, as in physics/tapping/driven_lever.h.
struct TapState {
  Length amplitude;    // A, amplitude zero-to-peak
  double phase = 0.0;  // phi, lag behind the drive, rad
};

// A swing that repeats itself at one height of the base.
struct RestingTap {
  TapState state;
  Length deflection;  // x0, mean deflection
  SwingAverages averages;
  bool stable = false;
};

// The slow motion of amplitude and phase, averaged over a swing (Bogoliubov & Mitropolsky 1961; with the virial V and
// the energy E lost in the sample per swing, San Paulo & Garcia 2001, 2002), time in 1/w0:
//
//   A' = -A/2Q + (a/2r) sin(phi) - E/(2 pi k r A)
//   phi' = (r^2 - 1)/2r + (a/2rA) cos(phi) + V/(r k A^2)
//
// V and E are those of the swing with its higher harmonics, whose loss to the air is in E, and which answer like a
// spring (tapping/swing_shape.h); where a contact is so stiff that they find no shape, those of a harmonic swing
// shifted as its lowest point is (SwingAverages). Good for Q of 100 and more; below kLeastQuality integrate directly
// (physics/tapping/tapping_oscillator.h).
//
// One thread. Only the constructor, resting_at() and settle() allocate.
class AveragedFlow {
 public:
  static constexpr double kLeastQuality = 100.0;

  // AsFelt: as sessions of a hand have it, which replay bit for bit. At the resonance, and with Harmonics::AtResonance,
  // its loss of the harmonics is too large for swings far smaller than the mean deflection.
  enum class Search { Exact, AsFelt };

  AveragedFlow(std::shared_ptr<const TapSurface> surface, const DrivenLever& lever, Search search = Search::Exact);
  ~AveragedFlow();

  // One step of the midpoint rule over the angle w0 dt with the base at `z`; keep it below 0.1 * 2Q.
  void step(TapState& state, Length z, double angle) noexcept;

  // Longest angle for step(): a tenth of the relaxation, 2Q.
  double longest_step() const noexcept { return 0.2 * lever_.quality_factor; }

  // Follows a swing until it rests at `z`: on its branch, or where the flow leads if the branch has ended. If it does
  // not rest within 30 relaxations, returns the nearest stable swing, or the last one if there is none. May allocate.
  RestingTap settle(const TapState& from, Length z);

  // Moves a resting swing to the one on the same stable branch at `z`, by Newton's method. Returns false, and changes
  // nothing, if there is none nearby.
  bool follow(TapState& state, Length z) noexcept;

  // A resting swing in full.
  RestingTap describe(const TapState& state, Length z) noexcept;

  // True if the newest averages are those of a swing with its harmonics: not over a contact so stiff that they find no
  // shape.
  bool has_shape() const noexcept { return has_shape_; }

  // Averages of a swing of this amplitude, to some 1e-4. The reference is valid until the next call.
  const SwingAverages& averages(Length amplitude, Length z) noexcept;

  // Energy that the newest of these swings loses beside its own to the air: in the sample, and by its harmonics to the
  // air. E of the equations above.
  Energy lost() const noexcept;

  // Every resting swing at `z`, the smallest amplitude first, stable or not; also that of a tip that sticks to the
  // sample.
  std::vector<RestingTap> resting_at(Length z) { return resting_at(z, Roots::Quick); }

  const DrivenLever& lever() const noexcept { return lever_; }
  bool is_as_felt() const noexcept { return search_ == Search::AsFelt; }
  // True if sessions from before Harmonics::OfTheDrive have these swings.
  bool is_of_older_sessions() const noexcept { return is_as_felt() && !answers_at_drive_; }

 private:
  struct Rate {
    double amplitude, phase;  // rates of change per unit of w0 t
  };
  // Averages of the swing with its shift and shape, which are searched from those of the previous call.
  const SwingAverages& averages_at(double amplitude, double z, double coarseness = 1.0) noexcept;
  bool bent_averages_at(double amplitude, double z, double coarseness) noexcept;  // false: no shape was found
  void straight_averages_at(double amplitude, double z) noexcept;
  Rate rate(const TapState& state, double z) noexcept;
  // The flow about a swing, to first order.
  struct Linear {
    Rate rate;
    double amplitude_by_amplitude, amplitude_by_phase, phase_by_amplitude, phase_by_phase;

    double determinant() const {
      return amplitude_by_amplitude * phase_by_phase - amplitude_by_phase * phase_by_amplitude;
    }
    bool stable() const { return amplitude_by_amplitude + phase_by_phase < 0.0 && determinant() > 0.0; }
  };
  Linear linear(const TapState& state, double z) noexcept;
  // Amount by which a swing misses sin^2 + cos^2 = 1 for the phase that would hold it: negative if the drive is
  // stronger than needed, zero at rest.
  double imbalance(double amplitude, double z) noexcept;
  double imbalance_of(double amplitude) const noexcept;  // imbalance of the newest averages
  // The imbalance of the swing with this lowest height.
  struct Sample {
    double lowest, imbalance;
  };
  Sample sample_at(double lowest, double z) noexcept;
  Sample rough_sample_at(double lowest, double z) noexcept;
  // Search for states. Both kinds find the same to some 1e-9; a session replays those of the slow one bit for bit.
  enum class Roots { Quick, Slow };
  std::vector<RestingTap> resting_at(Length z, Roots roots);
  std::vector<Sample> samples_at(double z, Roots roots);  // samples from the highest one down
  RestingTap root_between(Sample one, Sample other, double z) noexcept;
  Sample turn_between(const Sample& left, const Sample& middle, const Sample& right, double z) noexcept;
  std::optional<RestingTap> stuck_at(double z) noexcept;
  double amplitude_at_lowest(double lowest, double z) noexcept;
  double sine_of_rest(double amplitude) const noexcept;
  double cosine_of_rest(double amplitude) const noexcept;

  std::shared_ptr<const TapSurface> surface_;
  DrivenLever lever_;
  Search search_;
  bool answers_at_drive_;  // not at the resonance
  double k_, a_, r_, q_;
  double harmonics_ratio_;             // ratio of drive to resonance in the harmonics' response
  std::unique_ptr<SwingShape> shape_;  // shape of the previous swing
  bool has_shape_ = true;
  double shift_ = 0.0;  // shift of the lowest point in the previous swing
  SwingAverages averages_;
};

}  // namespace afm::physics
