// SPDX-License-Identifier: Apache-2.0
// A session with 200 spheres, which a deep test makes ten minutes long.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "servo/recorded_servo.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "session_records.h"
#include "support/deep.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_crowd_test {

TEST(ReplayOfParticles, GivesEveryBitOfTwoHundredAgain) {
  std::vector<test::PlaceM> places;
  for (int i = 0; i < 200; ++i) places.push_back({(i % 20 - 9.5) * 80e-9, (i / 20 - 4.5) * 80e-9});
  scene::SharedModel model = test::paper_model();
  model.particles = test::particles_at(places);
  Recording recording(model);
  recording.choose(test::kMica, scene::ScaleMode::Particles);
  recording.arm();
  const double m_per_m = recording.state().active.scale.hand_m_per_m;
  const std::size_t ticks = support::deep() ? 600'000 : 20'000;
  for (int row = 0; recording.sessions.empty() || recording.sessions.back().samples.size() < ticks; ++row) {
    const double y_m = (row % 10 - 4.5) * 80e-9 + 3e-9, x_m = row % 2 == 0 ? 850e-9 : -850e-9;
    recording.go(m_per_m * glm::dvec2(-x_m, y_m), 0.03, 0.3);
    recording.run(500);
    recording.go(m_per_m * glm::dvec2(-x_m, y_m), 0.0005, 0.3);
    recording.run(500);
    recording.go(m_per_m * glm::dvec2(x_m, y_m), 0.0005, 3.0);
    recording.run(3300);
    recording.go(m_per_m * glm::dvec2(x_m, y_m), 0.03, 0.3);
    recording.run(500);
  }
  ASSERT_EQ(recording.sessions.size(), 1U);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_NE(session.samples.front().push.digest, session.samples.back().push.digest);
  expect_same(session);
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(session, folder.file("crowd.afms")));
  const auto loaded = load_session(folder.file("crowd.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->samples.size(), session.samples.size());
  // a film needs the file alone
  const auto end = replay_particles(*loaded, loaded->samples.back().time_ns);
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_EQ(end->pages, recording.pages());
}

// A long session consists of thousands of parts: copying the samples before for each would take minutes.
TEST(SamplesOfAPart, CopyThoseBeforeThemOnlyAsOftenAsTheirNumberDoubles) {
  std::string part;
  put_samples(part, std::vector<scene::TipSample>(100), sizeof(scene::TipSample));
  std::vector<scene::TipSample> samples;
  int copies = 0;
  for (int i = 0; i < 1000; ++i) {
    const scene::TipSample* const before = samples.data();
    std::string_view bytes = part;
    ASSERT_TRUE(take_samples(bytes, samples, sizeof(scene::TipSample)));
    if (samples.data() != before) ++copies;
  }
  EXPECT_EQ(samples.size(), 100'000U);
  EXPECT_LE(copies, 17) << "log2 of their number";
}

}  // namespace replay_crowd_test
}  // namespace afm::servo
