// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/curve_run.h"
#include "curves/tapping/tapping_run.h"
#include "instrument/held_base.h"
#include "instrument/instrument_settings.h"
#include "physics/imaging/scanner.h"
#include "physics/normal_generator.h"

namespace afm::fits {
struct SpectrumPoint;
}

namespace afm::instrument {

class Showcase;

// An atomic force microscope in simulated time, whose truth is known. The same seed and the same calls give the same
// results, bit for bit. Lengths in m of the sample's frame, z away from it; time in s. One thread; allocates.
class SimulatedInstrument {
 public:
  // Fails as curves::contact_setup() and imaging::scan_surface(). `sample` replaces the one drawn for the material.
  static core::Result<SimulatedInstrument> create(std::string assets_dir, std::uint64_t seed,
                                                  imaging::OwnSample sample = {});

  // Shows the following events in a showcase, which must outlive the object. Results do not depend on it.
  void show_in(Showcase& showcase);

  // Restarts as if created with this seed.
  core::Result<void> reset(std::uint64_t seed);

  const InstrumentSettings& settings() const noexcept { return settings_; }
  const curves::ContactSetup& setup() const noexcept { return setup_; }
  // Fails, without a change, for numbers that the contact's law or the scanner does not use.
  core::Result<void> change(const InstrumentSettings& settings);

  // Lowers the tip onto the sample until the setpoint is reached, or seems to be: Faults::false_engagement.
  void approach(double speed_m_per_s);
  void withdraw(double distance_m, double speed_m_per_s);
  void move_to(double x_m, double y_m, double speed_m_per_s);
  void wait(double time_s);

  // Moves the lever's base to a height above the mean level of the sample, with the feedback off: the tip follows its
  // law, at rest, with both jumps. In tapping mode only upwards. WrongUsage, without a change, for a lever that taps,
  // and if the tip would wear beyond what its law allows.
  core::Result<void> set_z(double z_m, double speed_m_per_s);

  // Force of the sample on the tip as the detector shows it; the setpoint while the feedback keeps it.
  double shown_force();

  struct Position {
    double x_m = 0, y_m = 0;
    double z_m = 0;        // height of the lever's base above the mean level of the sample
    bool engaged = false;  // true: the feedback holds the setpoint, as far as it can detect
    double time_s = 0;
  };
  const Position& position() const noexcept { return at_; }

  struct CurveRequest {
    std::optional<double> z_from_m{},
        z_to_m{};              // heights of the lever's base, zero at the surface; empty: defaults of touchafm curve
    std::size_t points = 500;  // number of points per branch, 2 to kMostCurvePoints; a jump adds two
    double speed_m_per_s = 1e-6;
  };
  static constexpr std::size_t kMostCurvePoints = 100'000;

  // A curve where the tip is; afterwards the tip is engaged or withdrawn as before. `shown_n` is what the
  // detector shows. Fails as curves::run_curve(), and if the tip would wear beyond what its law allows; then nothing
  // has changed.
  struct Curve {
    curves::CurveRun run;
    std::vector<double> shown_n;
  };
  core::Result<Curve> curve(const CurveRequest& request);

  // Tapping curve of the contact as it is, without noise; `watch` may end it. Fails as curves::run_tapping().
  core::Result<curves::TappingRun> tapping_curve(const std::optional<double>& z_from_m,
                                                 const std::optional<double>& z_to_m, std::size_t points,
                                                 const curves::TapWatch& watch = {});

  struct Frame {
    double width_m, height_m;
  };
  Frame frame() const;  // size of the next image

  // An image around the tip, in contact or tapping mode; a tip that wears while it taps is sharp until the next image.
  // Calls `taken` with each line and the time; the scan ends if it returns false. WrongUsage
  // unless the tip is engaged, and if it would wear beyond what its law allows; then nothing has changed.
  using TakeLine = std::function<bool(const physics::ScanLine& line, double time_s)>;
  core::Result<physics::ScanImage> scan(const TakeLine& taken);

  // One-sided spectrum of the free lever's first mode, as a lever that was calibrated under an end load shows it, in
  // m^2/Hz: the mean of `averages` periodograms (physics/flexural_modes.h, fits/thermal_fit.h).
  std::vector<fits::SpectrumPoint> thermal(std::size_t points, double most_hz, std::size_t averages);

  // True values, which no microscope shows.
  struct Truth {
    double tip_radius_m = 0;                // radius of the tip with its wear
    double tip_growth_m = 0;                // growth of the radius by wear since the start
    bool touching = false;                  // true: the tip touches; false after a false engagement
    bool second_apex = false;               // true: the tip has a second apex
    double surface_m = 0;                   // height of the sample below the apex
    double sample_x_m = 0, sample_y_m = 0;  // drift of the sample since the start
    double highest_force_n = 0;             // strongest push so far
    std::size_t state_flips = 0;            // changes of a swing between its two states in the newest image
  };
  Truth truth() const;

 private:
  SimulatedInstrument(std::string assets_dir, imaging::OwnSample sample);

  core::Result<void> build(const InstrumentSettings& settings, double growth_m);
  physics::ScanSettings scan_settings() const;
  physics::Scanner::Surface surface_now() const;
  double surface_below() const;
  double uniform();
  void pass(double time_s) noexcept;
  HeldBase* base();
  void release();
  void follow_base();
  double force_n() const;
  double shown(double force_n);
  void show_place() const;
  core::Result<void> wear(double force_n);
  core::Result<Curve> take_curve(const CurveRequest& request);
  core::Result<physics::ScanImage> take_image(const TakeLine& taken);
  void take_back_to(SimulatedInstrument before);
  struct Driven {
    curves::TappingOptions numbers;
    curves::ContactSetup setup;
  };
  core::Result<Driven> driven() const;
  core::Result<std::optional<physics::TappingDetector>> detector() const;  // empty: contact mode
  core::Result<void> after_line(const physics::ScanLine& line, physics::Scanner& scanner);
  curves::PathOptions path_of(const std::optional<double>& from, const std::optional<double>& to) const;

  std::string assets_dir_;
  imaging::OwnSample sample_;
  InstrumentSettings settings_;
  curves::ContactSetup setup_;                           // contact with the worn tip
  std::optional<physics::SweepPlan> usual_path_;         // default path of curves; empty: not computed yet
  std::shared_ptr<const imaging::ScanSurface> surface_;  // surface under a tip of radius surface_radius_m_
  double surface_radius_m_ = 0;
  double growth_m_ = 0, drift_x_m_ = 0, drift_y_m_ = 0, highest_force_n_ = 0;
  std::size_t state_flips_ = 0;
  bool touching_ = false, second_apex_ = false;
  Position at_;
  std::optional<HeldBase> base_;  // base held without feedback; empty: not needed yet
  std::mt19937_64 chance_;
  physics::NormalGenerator noise_;
  Showcase* showcase_ = nullptr;  // display of the instrument, not owned; null: none
};

}  // namespace afm::instrument
