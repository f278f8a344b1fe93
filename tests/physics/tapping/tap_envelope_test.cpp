// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_envelope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tapped_sample.h"

namespace tap_envelope_test {

using namespace afm::physics;

// Sessions replay bit for bit, so a step must not depend on the cells of the table that earlier steps have left behind.
TEST(TapEnvelope, StepsFromAStateAsACopyThatHasNoPast) {
  for (const double least_nm : {-35.0, 0.0}) {
    const TappedSample sample{.eta_w0_mpa = 20.0};
    const auto surface = sample.surface();
    AveragedFlow flow(surface, sample.lever());
    const TapEnvelope fresh(flow, surface->contact_height());
    TapEnvelope walked = fresh;
    std::mt19937_64 random(7);
    const auto within = [&random](double most) {
      return most * (static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0);
    };
    const double a0 = sample.a0_nm * 1e-9;
    double u = 0.0, v = a0, gap_m = 20e-9;
    for (int i = 0; i < 20'000; ++i) {
      // small ways within a cell and over its edges, and some long ones
      const double way = i % 50 == 0 ? 1.0 : 1e-3;
      u = std::clamp(u + way * within(a0), -a0, a0);
      v = std::clamp(v + way * within(a0), -a0, a0);
      gap_m = std::clamp(gap_m + way * within(20e-9), least_nm * 1e-9, 45e-9);
      const double to_m = i % 3 == 0 ? gap_m : gap_m + within(0.1e-9);
      TapEnvelope without_past = fresh;
      for (TapEnvelope* each : {&walked, &without_past}) {
        each->place(u, v, gap_m);
        each->advance(gap_m, to_m, 60.0);
      }
      ASSERT_EQ(walked.amplitude_m(), without_past.amplitude_m()) << "step " << i << ", gap " << gap_m;
      ASSERT_EQ(walked.phase_rad(), without_past.phase_rad()) << "step " << i << ", gap " << gap_m;
    }
  }
}

}  // namespace tap_envelope_test
