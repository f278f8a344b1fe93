// SPDX-License-Identifier: Apache-2.0
// Sessions with particles: recorded, stored, and replayed bit for bit.
// Invariant: a replay finds and undoes the pushes of its session
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/whole_file.h"
#include "physics/manipulation/half_turn.h"
#include "servo/recorded_servo.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_particles_test {

using physics::EventKind;
using scene::ScaleMode;
using testing::HasSubstr;

// Lifts, goes before the row of particles, and pushes along it.
void push_through(Recording& recording, double beside_m = 0.0, double height_m = 0.001) {
  recording.arm();
  recording.go({-0.028, beside_m}, 0.03, 0.3);
  recording.run(500);
  recording.go({-0.028, beside_m}, height_m, 0.3);
  recording.run(500);
  recording.go({0.020, beside_m}, height_m, 1.5);
  recording.run(1800);
  recording.go({0.020, beside_m}, 0.05, 0.3);
  recording.run(600);
}

std::size_t count(const RecordedSession& session, EventKind kind) {
  return static_cast<std::size_t>(std::count_if(session.events.begin(), session.events.end(),
                                                [&](const scene::TipEvent& event) { return event.kind == kind; }));
}

TEST(ReplayOfParticles, GivesEveryBitAgainWhereverTheyLayBefore) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  recording.choose(test::kGold, ScaleMode::Particles);  // another session, with the particles where they are
  push_through(recording, 0.002);
  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) {
    EXPECT_GE(count(session, EventKind::ParticleTouched), 1U);
    EXPECT_EQ(scene::digest_of(session.particles->pages, session.particles->set.count),
              session.samples.front().push.digest);
    expect_same(session);
  }
  const RecordedSession& first = recording.sessions.front();
  EXPECT_GE(count(first, EventKind::ParticleGave), 1U);
  EXPECT_NE(first.samples.front().push.digest, first.samples.back().push.digest);
  EXPECT_EQ(recording.sessions[0].samples.back().push.digest, recording.sessions[1].samples.front().push.digest);
}

// Pushes, two of them taken back, all put back, and that taken back, too; with force in between.
// Spheres that stick to the tip: recorded and stored with what the tip holds.
TEST(ReplayOfParticles, GivesEveryBitAgainOfSpheresThatStick) {
  scene::SharedModel model = test::model_with_particles();
  model.particles.species[0].sticks = 1;
  model.particles.species[0].scatter_seed = 7;
  Recording recording(model);
  recording.choose(test::kMica, ScaleMode::Particles);
  recording.arm();
  recording.go({-0.028, 0.0}, 0.045, 0.3);
  recording.run(500);
  recording.go({-0.028, 0.0}, 0.001, 0.3);
  recording.run(500);
  recording.go({-0.016, 0.0}, 0.001, 1.0);
  recording.run(1200);
  recording.go({-0.045, 0.0}, 0.001, 1.0);
  recording.run(1200);
  recording.go({-0.045, 0.0}, 0.05, 0.5);
  recording.run(800);
  recording.choose(test::kGold, ScaleMode::Particles);
  ASSERT_EQ(recording.sessions.size(), 1U);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_GE(count(session, EventKind::ParticleDragged), 1U);
  EXPECT_TRUE(std::any_of(session.samples.begin(), session.samples.end(),
                          [](const scene::TipSample& sample) { return sample.push.normal_n < 0.0; }));
  expect_same(session);
  const support::ScratchFolder folder;
  const std::string path = folder.file("sticks.afms");
  saved_and_replayed(session, path);

  // a program that does not know adhesion refuses the version
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x09");
  RecordedSession plain = session;
  plain.particles->set.species[0].sticks = 0;
  ASSERT_TRUE(save_session(plain, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x07");
  EXPECT_TRUE(load_session(path));
}

// Push, grip, push: a session each, stored with particles that stick or do not.
TEST(ReplayOfParticles, GivesEveryBitAgainWithBothTools) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  recording.choose(test::kMica, ScaleMode::Particles, {.tool = scene::PushTool::Grip});
  push_through(recording, 0.001);
  recording.go({-0.045, 0.001}, 0.001, 1.0);
  recording.run(1200);
  recording.go({-0.045, 0.001}, 0.05, 0.5);
  recording.run(800);
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  ASSERT_EQ(recording.sessions.size(), 3U);
  const support::ScratchFolder folder;
  for (std::size_t i = 0; i < 3; ++i) {
    const RecordedSession& session = recording.sessions[i];
    EXPECT_EQ(scene::has_hold(session.particles->set), i == 1) << i;
    EXPECT_GE(count(session, EventKind::ParticleTouched), 1U);
    expect_same(session);
    const std::string path = folder.file("tool.afms");
    ASSERT_TRUE(save_session(session, path));
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    expect_same(*loaded);
  }
  EXPECT_EQ(recording.sessions[0].samples.back().push.digest, recording.sessions[1].samples.front().push.digest);
  EXPECT_EQ(recording.sessions[1].samples.back().push.digest, recording.sessions[2].samples.front().push.digest);
}

// A sphere that is picked up, carried and set down on a pad, and one that hangs when the force is removed.
TEST(ReplayOfParticles, GivesEveryBitAgainOfASphereOnTheTip) {
  scene::SharedModel model = test::model_with_particles();
  model.particles = test::particles_to_lift({{0.0, 0.0}, {120e-9, 0.0}});
  Recording recording(model);
  recording.choose(test::kMica, ScaleMode::Particles);
  recording.arm();
  constexpr double kHighM = 180e-9;
  const double m_per_m = recording.state().active.scale.hand_m_per_m;
  const auto go = [&](double x_m, double y_m, double z_m) {
    recording.go(m_per_m * glm::dvec2(x_m, y_m), m_per_m * z_m, 1.0);
    recording.run(1300);
  };
  const auto pick_up = [&] {
    go(-45e-9, 0.0, kHighM);
    go(-45e-9, 0.0, 10e-9);
    go(-26e-9, 0.0, 10e-9);
    go(-26e-9, 0.0, kHighM);
  };
  pick_up();
  go(200e-9, 50e-9, kHighM);
  go(200e-9, 50e-9, 25e-9);
  go(200e-9, 50e-9, kHighM);
  recording.release(test::kMica, ScaleMode::Particles);
  recording.run(500);
  ++recording.taken_back;
  recording.run(100);
  recording.arm();
  pick_up();
  recording.release(test::kMica, ScaleMode::Particles);
  recording.run(500);
  recording.choose(test::kGold, ScaleMode::Particles);
  ASSERT_EQ(recording.sessions.size(), 1U);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_EQ(count(session, EventKind::ParticleLifted), 2U);
  EXPECT_EQ(count(session, EventKind::ParticleSetDown), 1U);
  EXPECT_EQ(count(session, EventKind::ParticleTorn), 1U);
  EXPECT_EQ(count(session, EventKind::PushTakenBack), 1U);
  expect_same(session);

  const support::ScratchFolder folder;
  const std::string path = folder.file("carried.afms");
  saved_and_replayed(session, path);
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x0c");

  // pads alone need the version, and so does a tip that lifts
  RecordedSession other = session;
  other.particles->set.species[0].sticks = 0;
  ASSERT_TRUE(save_session(other, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x0c");
  EXPECT_TRUE(load_session(path));
  other.particles->set.pads = {};
  ASSERT_TRUE(save_session(other, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x07");
  other.particles->set.species[0].sticks = 1;
  ASSERT_TRUE(save_session(other, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x0c");
  EXPECT_TRUE(load_session(path));
  other.particles->set.pads = session.particles->set.pads;
  other.particles->set.pads[0].half_width_m = -1.0;
  ASSERT_TRUE(save_session(other, path));
  EXPECT_FALSE(load_session(path));
}

TEST(ReplayOfParticles, TakesPushesBackAsTheHandHadThemTakenBack) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  const auto order = [&](std::uint32_t& orders) {
    recording.release(test::kMica, ScaleMode::Particles);
    recording.run(500);
    ++orders;
    recording.run(100);
  };
  push_through(recording);
  order(recording.taken_back);
  push_through(recording);
  order(recording.put_back);
  order(recording.taken_back);
  push_through(recording, 0.001);
  order(recording.taken_back);
  ASSERT_EQ(recording.sessions.size(), 1U);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_EQ(count(session, EventKind::PushTakenBack), 3U);
  EXPECT_EQ(count(session, EventKind::ParticlesPutBack), 1U);
  expect_same(session);
  const auto ended = replay_particles(session, session.samples.back().time_ns);
  ASSERT_TRUE(ended) << ended.error().message;
  EXPECT_EQ(ended->pages, recording.pages());
}

TEST(ReplayOfParticles, NoticesAPoseThatIsOther) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  RecordedSession session = recording.sessions.front();
  session.particles->pages[0].poses[2].x_m *= 1.0 + 1e-15;
  const auto other = replay(session);
  ASSERT_TRUE(other) << other.error().message;
  ASSERT_TRUE(other->first);
  EXPECT_EQ(other->first->index, 0U);
  EXPECT_EQ(other->first->quantity, "particle_digest");
}

TEST(ReplayOfParticles, IsThatOfTheFile) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  RecordedSession& session = recording.sessions.front();
  session.hand_m_per_m = recording.state().active.scale.hand_m_per_m;
  session.hand_n_per_n = recording.state().active.scale.hand_n_per_n;
  const support::ScratchFolder folder;
  const std::string path = folder.file("pushed.afms");
  ASSERT_TRUE(save_session(session, path));
  EXPECT_EQ(core::read_beginning(path, 5).value(), "AFMS\x07");
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->particles);
  EXPECT_EQ(loaded->particles->pages, session.particles->pages);
  EXPECT_EQ(loaded->particles->set.count, 3U);
  expect_same(*loaded);

  // no particles: the version from before them
  session.particles.reset();
  ASSERT_TRUE(save_session(session, path));
  EXPECT_EQ(core::read_beginning(path, 5).value(), "AFMS\x06");
  EXPECT_EQ(load_session(path)->samples.back().push.digest, 0U);
}

TEST(ReplayOfParticles, PlacesThemAsTheyLayAtAnyTime) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  RecordedSession& session = recording.sessions.front();
  const auto begun = replay_particles(session, session.samples.front().time_ns);
  ASSERT_TRUE(begun) << begun.error().message;
  EXPECT_EQ(begun->pages, session.particles->pages);
  for (std::size_t i = 100; i < session.samples.size(); i += 311) {
    const auto then = replay_particles(session, session.samples[i].time_ns);
    ASSERT_TRUE(then) << then.error().message;
    EXPECT_EQ(scene::digest_of(then->pages, session.particles->set.count), session.samples[i].push.digest);
    EXPECT_EQ(then->push.normal_n, session.samples[i].push.normal_n);
  }
  const auto ended = replay_particles(session, session.samples.back().time_ns);
  ASSERT_TRUE(ended) << ended.error().message;
  EXPECT_EQ(ended->pages, recording.pages());

  session.particles->pages[0].poses[2].x_m *= 1.0 + 1e-15;
  const auto elsewhere = replay_particles(session, session.samples.back().time_ns);
  ASSERT_FALSE(elsewhere);
  EXPECT_THAT(elsewhere.error().message, HasSubstr("cannot be placed at"));
}

TEST(ReplayOfParticles, RefusesAFileWhoseParticlesCannotBe) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  recording.run(50);
  const support::ScratchFolder folder;
  const std::string path = folder.file("bad.afms");
  RecordedSession session = recording.sessions.front();
  session.hand_m_per_m = session.hand_n_per_n = 1.0;
  session.particles->set.particles[1].x_m = session.particles->set.particles[0].x_m + 1e-9;
  ASSERT_TRUE(save_session(session, path));
  const auto overlap = load_session(path);
  ASSERT_FALSE(overlap);
  EXPECT_THAT(overlap.error().message, HasSubstr("particles 1 and 2 overlap"));
  session = recording.sessions.front();
  session.hand_m_per_m = session.hand_n_per_n = 1.0;
  session.particles->pages.clear();
  ASSERT_TRUE(save_session(session, path));
  const auto no_pages = load_session(path);
  ASSERT_FALSE(no_pages);
  EXPECT_THAT(no_pages.error().message, HasSubstr("its particles are damaged"));
}

// A rod across the path of the tip, off its middle.
scene::SharedModel model_with_a_rod() {
  scene::SharedModel model = test::model_with_particles();
  model.particles = test::particles_at({{0.0, 30e-9}}, test::constant_species(3e-9, 0.5));
  model.particles.length_m[0] = 200e-9;
  model.particles.angle_rad[0] = 1.5;
  return model;
}

TEST(ReplayOfParticles, KeepsTheDirectionsOfRods) {
  Recording recording(model_with_a_rod());
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording);
  recording.choose(test::kGold, ScaleMode::Particles);
  push_through(recording, 0.001);
  ASSERT_EQ(recording.sessions.size(), 2U);
  EXPECT_GE(count(recording.sessions[0], EventKind::ParticleGave), 1U);
  for (const RecordedSession& session : recording.sessions) {
    const scene::ParticlePose& pose = session.particles->pages[0].poses[0];
    EXPECT_EQ(pose.rod, 1U);
    EXPECT_EQ(scene::digest_of(session.particles->pages, 1), session.samples.front().push.digest);
    expect_same(session);
    // another direction has another digest, and another replay
    RecordedSession turned = session;
    scene::set_turn(turned.particles->pages[0].poses[0], physics::half_turn(1.4));
    EXPECT_NE(scene::digest_of(turned.particles->pages, 1), session.samples.front().push.digest);
  }
  const scene::ParticlePose& last = recording.sessions[1].particles->pages[0].poses[0];
  EXPECT_GT(std::abs(physics::angle_rad(scene::turn_of(last)) - 1.5), 0.05) << "the first push has turned it";

  const support::ScratchFolder folder;
  const std::string path = folder.file("rod.afms");
  const RecordedSession& session = recording.sessions[1];
  ASSERT_TRUE(save_session(session, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x08");
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->particles->set, session.particles->set);
  EXPECT_EQ(loaded->particles->pages, session.particles->pages);
  expect_same(*loaded);

  RecordedSession damaged = session;
  damaged.particles->pages[0].poses[0].rod = 0;
  ASSERT_TRUE(save_session(damaged, path));
  EXPECT_THAT(load_session(path).error().message, HasSubstr("the poses of its rods or islands are impossible"));
  damaged = session;
  damaged.particles->set.angle_rad[0] = std::nan("");
  ASSERT_TRUE(save_session(damaged, path));
  EXPECT_FALSE(load_session(path));
}

TEST(ReplayOfParticles, KeepsTheTurnsOfIslands) {
  scene::SharedModel model = test::model_with_particles();
  model.particles = test::islands_at({{0.0, 30e-9}, {0.0, 400e-9}});
  Recording recording(model);
  recording.choose(test::kMica, ScaleMode::Particles);
  push_through(recording, 0.0, 0.0);
  ASSERT_EQ(recording.sessions.size(), 1U);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_GE(count(session, EventKind::ParticleGave), 1U);
  EXPECT_NE(session.samples.front().push.digest, session.samples.back().push.digest);
  EXPECT_EQ(session.particles->pages[0].poses[0].rod, 1U);
  expect_same(session);

  const support::ScratchFolder folder;
  const std::string path = folder.file("island.afms");
  ASSERT_TRUE(save_session(session, path));
  EXPECT_EQ(core::read_file(path)->substr(4, 1), "\x0d") << "a program without islands refuses the version";
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->particles->set, session.particles->set);
  EXPECT_EQ(loaded->particles->pages, session.particles->pages);
  expect_same(*loaded);

  RecordedSession damaged = session;
  damaged.particles->pages[0].poses[0].rod = 0;
  ASSERT_TRUE(save_session(damaged, path));
  EXPECT_THAT(load_session(path).error().message, HasSubstr("the poses of its rods or islands are impossible"));
  damaged = session;
  damaged.particles->set.island_radius_m[0] = -1e-7;
  ASSERT_TRUE(save_session(damaged, path));
  EXPECT_FALSE(load_session(path));
}

}  // namespace replay_particles_test
}  // namespace afm::servo
