// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/sample_model.h"
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

// Results of a recorded cycle, with the values of the law and of the experiments.
struct Measurement {
  std::string material;
  std::string title;
  std::string law;          // "dmt"
  bool hysteretic = true;   // false: so stiff a lever jumps nowhere, and there is nothing to compare
  bool judged = true;       // false: inertia and noise move the jumps of a dynamic lever; no error is made of that
  CycleEvents measured;     // from the events: where the path crossed the folds inside a tick
  CycleEvents calculation;  // the folds of the law, solved when its tables were built; of a recording, its analysis
  bool recorded = false;    // an instrument's curve, which need not snap in or pull off: then those are 0
  bool snaps_in = true;
  bool pulls_off = true;
  double fold_n = 0;                  // attraction of the calculation just before the jump to contact
  double loop_energy_j = 0;           // of the law as it is felt
  double recorded_loop_energy_j = 0;  // of the recording
  double sampled_f_attr_n = 0;  // from the ticks alone: the first one in contact, the strongest pull of the retract
  double sampled_f_ad_n = 0;
  std::optional<double> experiment_f_attr_n;
  std::optional<double> experiment_f_ad_n;

  // Relative; that of a jump to contact at Z = 0 (JKR) relative to Z_joc.
  CycleEvents error_vs_calculation() const;
  double error_of_loop_energy() const;  // of a recording; else 0
  std::optional<double> experiment_error_f_attr() const;
  std::optional<double> experiment_error_f_ad() const;
  double worst_error() const;  // the largest relative error against the calculation; 0 where nothing is judged
  double error_bound() const;
};

// Required accuracy of a run; the second value is for a measured curve, whose noise is smoothed.
inline constexpr double kEventErrorBound = 1e-3;
inline constexpr double kRecordingErrorBound = 1e-2;

// Fails if the cycle of a law with hysteresis has no jump to contact or no jump off contact. `material` is what the
// session was felt with; `recorded`, where that is an instrument's curve, its analysis, else null.
core::Result<Measurement> measure(const servo::RecordedSession& session, const curves::SampleModel& material,
                                  const physics::CurveFeatures* recorded = nullptr);

// Failed, with one line, if it is worse than its error bound.
core::Result<void> check_accuracy(const Measurement& m);

}  // namespace afm::exhibit
