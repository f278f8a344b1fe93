// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <string>

#include "app/bench/servo_latency.h"
#include "app/bench/servo_reaction.h"
#include "app/bench/servo_work.h"
#include "physics/law.h"
#include "support/places.h"
#include "support/stall_watch.h"

// Proves that the servo's benchmarks measure something; how much is left to people.
namespace afm::app {
namespace servo_benchmarks_test {

const std::string kProgram = support::built("bin/touchafm");

TEST(ServoBenchmarks, TimeATickOfEachLawWithTheForceOn) {
  const auto figures = measure_servo_work(2000, largest_measured_surface());
  ASSERT_TRUE(figures) << figures.error().message;
  // each computed law, the paper's three times, a dynamic one, a map of laws, a lever that taps, a scratch, and ink
  EXPECT_EQ(figures->size(), physics::laws_with(&physics::LawTraits::computed).size() + 7);
  EXPECT_EQ(figures->at(2).name, "measured 1024 x 1024");
  EXPECT_EQ(figures->at(2).p99_bar_us, 20.0);
  for (const WorkFigure& figure : *figures) {
    EXPECT_GT(figure.us.p50, 0.0) << figure.name;
    EXPECT_LE(figure.us.p50, figure.us.p99) << figure.name;
    EXPECT_LE(figure.us.p99, figure.us.p999) << figure.name;
    EXPECT_LE(figure.us.p999, figure.us.max) << figure.name;
  }
}

TEST(ServoBenchmarks, CountTheServosWakeUpsBesideAPlainLoop) {
  int frames = 0;
  const auto wake = measure_servo_wake(kProgram, 0.5, [&] { ++frames; });
  ASSERT_TRUE(wake) << wake.error().message;
  EXPECT_EQ(wake->servo.rate_hz, 1000.0);
  EXPECT_GT(wake->servo.ticks, 0U);
  EXPECT_GT(wake->plain.ticks, 0U);
  EXPECT_EQ(wake->frames, static_cast<std::uint64_t>(frames));
}

// After the renderer's death a fade of 20 ms; after 250 ms without a heartbeat one of 90 ms; Stop is at once.
TEST(ServoBenchmarks, SeeTheHandReleasedAfterTheRenderersEndAndByStop) {
  constexpr std::array kAtLeastMs{10.0, 100.0, 0.0};
  ASSERT_EQ(kReleases.size(), kAtLeastMs.size());
  for (std::size_t i = 0; i < kReleases.size(); ++i) {
    SCOPED_TRACE(kReleases[i].name);
    support::expect_within(support::Milliseconds(2.0 * kReleases[i].bar_ms), [&] {
      support::Timed seen;
      seen.stalled = support::timed([&] {
                       const auto lasted_ms = measure_reaction(kProgram, kReleases[i], 1);
                       ASSERT_TRUE(lasted_ms) << lasted_ms.error().message;
                       ASSERT_EQ(lasted_ms->size(), 1U);
                       EXPECT_GE(lasted_ms->front(), kAtLeastMs[i]);
                       seen.took = support::Milliseconds(lasted_ms->front());
                     }).stalled;
      return seen;
    });
  }
}

}  // namespace servo_benchmarks_test
}  // namespace afm::app
