// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/session_file.h"
#include "core/result.h"
#include "scene/material_library.h"
#include "scene/shared_blocks.h"

namespace afm::app {

// The four numbers of the paper's Table 2 and Fig. 5, magnitudes in SI.
struct CycleEvents {
  double f_attr_n = 0;
  double f_ad_n = 0;
  double z_jtc_m = 0;
  double z_joc_m = 0;
};

// What a recorded cycle gave, beside what the equations and the experiments say.
struct Measurement {
  std::string material;
  std::string title;
  CycleEvents measured;         // from the events: where the path crossed the folds inside a tick
  CycleEvents calculation;      // equations (3.4) to (3.10)
  double sampled_f_attr_n = 0;  // from the ticks alone: the first one in contact, the strongest pull of the retract
  double sampled_f_ad_n = 0;
  double experiment_f_attr_n = 0;  // NaN where none is known, as are its errors
  double experiment_f_ad_n = 0;

  CycleEvents error_vs_calculation() const;  // relative
  double experiment_error_f_attr() const;    // relative
  double experiment_error_f_ad() const;      // relative
  double worst_error() const;                // the largest relative error against the calculation
};

// The accuracy that a run must reach (design, section 6).
inline constexpr double kEventErrorBound = 1e-3;

// Fails if the cycle has no jump to contact or no jump off contact.
core::Result<Measurement> measure(const RecordedSession& session, const scene::MaterialEntry& material);

struct Percentiles {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
};

Percentiles percentiles(std::vector<double> values);

// Of a histogram of 1 us bins, microseconds: the upper edge of the bin that the percentile falls into.
Percentiles percentiles(std::span<const std::uint32_t> bins, std::uint32_t max_us);

}  // namespace afm::app
