// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/sample_model.h"
#include "exhibit/report/tapped_cycle.h"
#include "physics/curve_analysis.h"
#include "scene/shared/shared_blocks.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// The four numbers of the paper's Table 2 and Fig. 5, magnitudes in SI.
struct CycleEvents {
  double f_attr_n = 0;
  double f_ad_n = 0;
  double z_jtc_m = 0;
  double z_joc_m = 0;
};

// Results of a recorded cycle, with the values from the law and from the experiments.
struct Measurement {
  std::string material;
  std::string title;
  std::string law;          // word of the force law: "dmt"
  bool hysteretic = true;   // false: lever too stiff for jumps, so there is nothing to compare
  bool judged = true;       // false: jumps moved by inertia and noise of a dynamic lever, so their error is not judged
  CycleEvents measured;     // values from the events, which have the exact crossing of the folds within a tick
  CycleEvents calculation;  // folds of the law, solved with its tables; for a recording, results of its analysis
  bool recorded = false;    // true: an instrument's curve; without snap-in or pull-off their values are 0
  bool snaps_in = true;
  bool pulls_off = true;
  double fold_n = 0;                  // attraction of the calculation just before the jump to contact
  double loop_energy_j = 0;           // loop energy of the law as felt
  double recorded_loop_energy_j = 0;  // loop energy of the recording
  double sampled_f_attr_n = 0;        // tick values only: first in contact, strongest pull of the retract
  double sampled_f_ad_n = 0;
  std::optional<double> experiment_f_attr_n;
  std::optional<double> experiment_f_ad_n;
  std::optional<TappedCycle> tapped;  // figures of a lever in tapping mode, whose events have heights and no forces

  // Relative errors; for a jump to contact at Z = 0 (JKR), relative to Z_joc.
  CycleEvents error_vs_calculation() const;
  double error_of_loop_energy() const;  // relative error for a recording; otherwise 0
  std::optional<double> experiment_error_f_attr() const;
  std::optional<double> experiment_error_f_ad() const;
  double worst_error() const;  // largest relative error against the calculation; 0 if nothing is judged
  double error_bound() const;
};

// Largest accepted relative error. The second value is for a measured curve, whose noise is smoothed, the third for
// tapping mode, where jumps depend on the speed of the hand.
inline constexpr double kEventErrorBound = 1e-3;
inline constexpr double kRecordingErrorBound = 1e-2;
inline constexpr double kTappingErrorBound = 3e-2;

// Fails if the law has hysteresis but the cycle lacks one of its jumps. `material` is the one
// felt in the session; `recorded` is the analysis of an instrument's curve, otherwise null.
core::Result<Measurement> measure(const servo::RecordedSession& session, const curves::SampleModel& material,
                                  const physics::CurveFeatures* recorded = nullptr);

// Failed, with one line of text, if the error exceeds error_bound().
core::Result<void> check_accuracy(const Measurement& m);

}  // namespace afm::exhibit
