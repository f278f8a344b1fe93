// SPDX-License-Identifier: Apache-2.0
// A simulated person pushes particles to their pattern through the servo's own code, in simulated time.
// Invariant: the score of a task is the same live, at any frame rate, and in a replay
#include "exhibit/state/particle_task.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "physics/manipulation/particle_friction.h"
#include "scene/samples/pattern_state.h"
#include "servo/live_picture.h"
#include "servo/recorded_servo.h"
#include "support/particles/particle_sets.h"

namespace afm::exhibit {
namespace particle_task_test {

constexpr int kStepTicks = 20;  // a command of the hand
constexpr double kStepS = 1e-3 * kStepTicks;
constexpr double kDelayS = 0.25;     // delay of the eye
constexpr double kTremorM = 0.3e-3;  // tremor of the hand, root mean square, each way along the sample
constexpr double kHeldTremor = 0.5;  // share of the tremor that is left after a step
constexpr double kSteerPerS = 2.0;   // share of the seen error that the hand corrects
constexpr double kPushMPerS = 6e-3;  // speed of the hand
constexpr double kWayMPerS = 60e-3;
constexpr double kLowM = 1.6e-3;  // height of the hand while it pushes
constexpr double kHighM = 16e-3;
constexpr double kBehindM = 50e-9;  // from the middle of the particle to the tip that comes down behind it
constexpr double kNearM = 10e-9;    // distance from a target that the person is content with

std::unique_ptr<scene::SharedModel> model_with(const scene::ParticleSet& set, std::uint32_t level) {
  auto model = std::make_unique<scene::SharedModel>(test::paper_model());
  model->particles = scene::shared_particles(set);
  model->particles.level.level = level;
  return model;
}

class Person {
 public:
  explicit Person(const scene::ParticleSet& set, unsigned seed, std::uint32_t level = 0)
      : set_(set), pattern_(scene::shared_pattern_of(set)), random_(seed), recording_(*model_with(set, level)) {
    recording_.choose(test::kMica, scene::ScaleMode::Particles);
    recording_.arm();
    m_per_m_ = recording_.state().active.scale.hand_m_per_m;
    go({0.0, 0.0}, kHighM, 0.5);
  }

  // Pushes what is farthest from its target until all are near, or for so long.
  void solve(double most_s) {
    for (const double end_s = time_s() + most_s; time_s() < end_s;) {
      rest(0.5);
      const auto pattern = scene::pattern_state(set_, pattern_, *places_of({.set = &set_, .pages = seen()}));
      std::size_t worst = 0;
      const auto off = [&](std::size_t i) { return glm::distance(target(i), place(pattern->match.particles[i])); };
      for (std::size_t i = 1; i < pattern_.targets.size(); ++i) worst = off(i) > off(worst) ? i : worst;
      if (off(worst) < kNearM) break;
      if (looks) look_at(pattern->match.particles[worst]);
      push(pattern->match.particles[worst], target(worst));
    }
    rest(1.0);
  }

  // Looks again at every particle that is not measured.
  void look() {
    for (std::size_t i = 0; i < set_.particles.size(); ++i) {
      if (recording_.picture->now().known[i] == servo::Known::Measured) continue;
      look_at(i);
    }
  }

  // Sees nothing and does nothing, as the sample drifts.
  void wait(double seconds) { recording_.run(static_cast<int>(1e3 * seconds)); }

  // Follows the moves of the set.
  void follow_plan() {
    const double low_m = 0.3 * scene::median_radius(set_).si;
    const auto reach = [&](const physics::LeverBase& to, double m_per_s) {
      go(m_per_m_ * glm::dvec2(to.position.x.si, to.position.y.si), m_per_m_ * std::max(low_m, to.z.si), m_per_s);
    };
    reach(set_.start, kWayMPerS);
    for (const scene::HandMove& move : set_.moves) reach(move.to, move.to.z.si > low_m ? kWayMPerS : kPushMPerS);
    rest(1.0);
  }

  // Comes down beside the particle and pushes it until it gives, seeing nothing.
  void push_by_feel(std::size_t particle, const glm::dvec2& along, double m_per_s) {
    beside(particle, along);
    double most_n = 0.0;
    for (int i = 0; i < 2000; ++i) {
      step(at_m_ + kStepS * m_per_s * along, kLowM);
      most_n = std::max(most_n, force_n());
      if (recording_.sessions.front().samples.back().push.state == physics::PushState::Slides) break;
    }
    felt_n_ = most_n;
    go(at_m_, kHighM, kWayMPerS);
    rest(1.0);
  }

  // Presses the particle from the middle of the sample, with so much of the felt force, or of that of 1 nN.
  void press(std::size_t particle, double share, double seconds) {
    const glm::dvec2 along = glm::normalize(place(particle));
    beside(particle, along);
    const double wanted_n = share * (felt_n_ > 0.0 ? felt_n_ : 1e-9);
    for (int i = 0; i < 2000 && force_n() < wanted_n; ++i) step(at_m_ + kStepS * 0.002 * along, kLowM);
    const auto first = static_cast<std::ptrdiff_t>(recording_.sessions.front().samples.size());
    rest(seconds);
    const auto& samples = recording_.sessions.front().samples;
    double sum_n = 0.0;
    for (auto sample = samples.begin() + first; sample != samples.end(); ++sample) {
      sum_n += std::hypot(sample->push.lateral_n[0], sample->push.lateral_n[1]);
    }
    held_n_ = sum_n / static_cast<double>(samples.end() - samples.begin() - first);
    go(at_m_, kHighM, kWayMPerS);
    rest(1.0);
  }
  double held_n() const { return held_n_; }  // mean

  // Pushes the first particle so much of the way to the target, steering.
  void push_along_line(double share) {
    const scene::Pattern pattern = scene::shared_pattern_of(set_);
    const glm::dvec2 from_m = place(0);
    push(0, from_m + share * (target(0) + glm::dvec2(12e-9, 0.0) - from_m));
    rest(1.0);
  }

  bool looks = false;  // again, before each push

  double time_s() const { return 1e-9 * static_cast<double>(recording_.now_ns); }
  servo::Recording& recording() { return recording_; }

 private:
  void beside(std::size_t particle, const glm::dvec2& along) {
    go(m_per_m_ * (place(particle) - kBehindM * along), kHighM, kWayMPerS);
    go(at_m_, kLowM, kWayMPerS);
  }
  double force_n() const {
    const scene::TipSample& sample = recording_.sessions.front().samples.back();
    return std::hypot(sample.push.lateral_n[0], sample.push.lateral_n[1]);
  }
  glm::dvec2 target(std::size_t i) const {
    return {pattern_.targets[i].position.x.si, pattern_.targets[i].position.y.si};
  }
  glm::dvec2 place(std::size_t particle) const {
    const auto pose = pose_of({.set = &set_, .pages = seen()}, particle);
    return {pose->x_m, pose->y_m};
  }

  // The particles, or at a level the picture of them.
  std::span<const scene::ParticlePage> seen() const {
    return recording_.picture ? recording_.picture->shown() : recording_.pages();
  }

  void look_at(std::size_t particle) {
    go(m_per_m_ * place(particle), kHighM, kWayMPerS);
    ++recording_.looks;
    rest(3.6);
  }

  void push(std::size_t particle, const glm::dvec2& to_m) {
    const glm::dvec2 from_m = place(particle), along = glm::normalize(to_m - from_m);
    go(m_per_m_ * (from_m - kBehindM * along), kHighM, kWayMPerS);
    go(at_m_, kLowM, kWayMPerS);
    std::deque<glm::dvec2> late{place(particle)};
    const auto delay = static_cast<std::size_t>(std::lround(kDelayS / kStepS));
    const glm::dvec2 across(-along.y, along.x);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 there_m = late.front();
      if (glm::dot(to_m - there_m, along) < kPushMPerS / m_per_m_ * kDelayS) break;
      const glm::dvec2 left = glm::normalize(to_m - there_m), aside(-left.y, left.x);
      const double off_m = glm::dot(at_m_ - m_per_m_ * there_m, aside);
      if (std::abs(off_m) > m_per_m_ * kBehindM * 0.7) break;  // lost
      step(at_m_ + kStepS * (kPushMPerS * left - kSteerPerS * off_m * aside), kLowM);
      late.push_back(place(particle));
      if (late.size() > delay) late.pop_front();
    }
    go(at_m_, kHighM, kWayMPerS);
  }

  void rest(double seconds) {
    for (double s = 0.0; s < seconds; s += kStepS) step(at_m_, height_m_);
  }

  void go(const glm::dvec2& to_m, double height_m, double m_per_s) {
    const glm::dvec3 from(at_m_, height_m_), to(to_m, height_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / m_per_s / kStepS)));
    for (int i = 1; i <= steps; ++i) {
      const glm::dvec3 next = from + (to - from) * (static_cast<double>(i) / steps);
      step(glm::dvec2(next), next.z);
    }
  }

  void step(const glm::dvec2& to_m, double height_m) {
    at_m_ = to_m;
    height_m_ = height_m;
    const double fresh = kTremorM * std::sqrt(1.0 - kHeldTremor * kHeldTremor);
    tremor_m_ = kHeldTremor * tremor_m_ + fresh * glm::dvec2(noise_(random_), noise_(random_));
    recording_.go(at_m_ + tremor_m_, height_m_, kStepS);
    recording_.run(kStepTicks);
  }

  const scene::ParticleSet& set_;
  scene::Pattern pattern_;
  std::mt19937 random_;
  std::normal_distribution<double> noise_;
  servo::Recording recording_;
  double m_per_m_ = 0.0;
  glm::dvec2 at_m_{0.0}, tremor_m_{0.0};  // intended place, and the error of the tremor
  double height_m_ = 0.06;
  double felt_n_ = 0.0, held_n_ = 0.0;
};

// The score as a live window keeps it, which sees the particles once a frame.
scene::TaskScore live_score(const scene::ParticleSet& set, const servo::RecordedSession& session, std::size_t frame) {
  ParticleTask task(set);
  std::size_t tick = 0;
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& now) {
    for (const scene::TipEvent& event : now.events) task.add(event);
    task.add(now.sample, now.picture == nullptr);
    if (++tick % frame == 0) task.look(now.pages, now.picture);
  });
  EXPECT_TRUE(replayed && replayed->identical());
  return task.score();
}

TEST(ParticleTask, IsSolvedByAPersonWithDelayAndTremorAndScoredAlikeLiveAndInAReplay) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  Person person(set, 11);
  person.solve(300.0);
  ASSERT_EQ(person.recording().sessions.size(), 1U);
  const servo::RecordedSession& session = person.recording().sessions.front();
  ParticleTask task(set);
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& tick) { task.hear(tick); });
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->identical());
  const scene::TaskScore score = task.score();
  EXPECT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  EXPECT_LT(score.time_s, 300.0);
  EXPECT_LE(score.rms_m, scene::median_radius(set).si);
  EXPECT_GE(score.strokes, 4U);
  EXPECT_GT(score.work_j, 10e-18);
  EXPECT_EQ(score.undos, 0U);
  EXPECT_EQ(score.truth, 1U) << "without a picture the particles themselves are shown";
  EXPECT_EQ(live_score(set, session, 17), score) << "at 60 frames a second";
  EXPECT_EQ(live_score(set, session, 450), score) << "at two frames a second";
}

// The score of a replay, which is that of a live window at any frame rate.
scene::TaskScore replayed_score(const scene::ParticleSet& set, const servo::RecordedSession& session) {
  ParticleTask task(set);
  bool was_dark = false;
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& tick) {
    task.hear(tick);
    was_dark = was_dark || task.dark();
    if (tick.sample.push.particle != scene::kNoParticle && task.score().state != scene::TaskState::Done) {
      EXPECT_TRUE(task.dark());
    }
  });
  EXPECT_TRUE(replayed && replayed->identical());
  EXPECT_EQ(was_dark, set.blind.has_value());
  EXPECT_FALSE(task.score().state == scene::TaskState::Done && task.dark()) << "the picture is back";
  EXPECT_EQ(live_score(set, session, 17), task.score()) << "at 60 frames a second";
  EXPECT_EQ(live_score(set, session, 450), task.score()) << "at two frames a second";
  return task.score();
}

TEST(BlindTask, ComparesTheForceThatAHandHoldsWithTheThresholdThatItFelt) {
  const scene::ParticleSet set = test::particle_set("threshold-by-feel");
  Person person(set, 5);
  person.push_by_feel(0, {1.0, 0.0}, 0.004);
  person.press(1, 0.5, 4.0);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  ASSERT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  const physics::ParticleSpecies& gold = set.setup.species.front();
  EXPECT_NEAR(score.threshold_n / physics::sliding_threshold(gold, gold.law, physics::Force(0.0)).si, 1.0, 0.02)
      << "that of the file, and a little more under the tip that presses it down";
  EXPECT_NEAR(score.answer_n, person.held_n(), 0.1 * score.threshold_n) << "within the tremor of the hand";
  EXPECT_EQ(score.rms_m, 0.0);
  EXPECT_EQ(score.truth, 0U) << "nobody saw the particles";
  EXPECT_EQ(score.strokes, 1U);
}

TEST(BlindTask, IgnoresAPressBeforeTheThresholdWasFeltAndOneThatIsShort) {
  const scene::ParticleSet set = test::particle_set("threshold-by-feel");
  Person person(set, 5);
  person.press(1, 0.5, 4.0);
  person.push_by_feel(0, {1.0, 0.0}, 0.004);
  person.press(1, 0.1, 0.2);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  EXPECT_EQ(score.state, scene::TaskState::Running) << scene::text_of(score);
  EXPECT_GT(score.threshold_n, 0.0);
  EXPECT_EQ(score.answer_n, 0.0);
}

TEST(BlindTask, MeasuresTheDistanceFromTheLineOfAPushThatIsFarEnough) {
  const scene::ParticleSet set = test::particle_set("blind-line");
  Person person(set, 7);
  person.push_along_line(0.5);
  EXPECT_EQ(replayed_score(set, person.recording().sessions.front()).state, scene::TaskState::Running) << "half way";
  person.push_along_line(1.0);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  ASSERT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  const auto places = places_of({.set = &set, .pages = person.recording().pages()});
  EXPECT_NEAR(score.rms_m, std::abs((*places)[0].position.y.si), 1e-15) << "the line is along x";
  EXPECT_LT(score.rms_m, scene::median_radius(set).si);
  EXPECT_EQ(score.truth, 0U);
  EXPECT_EQ(score.answer_n, 0.0);
}

TEST(ParticleTask, IsJudgedByMeasuredPlacesAlone) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  Person person(set, 11, 1);
  person.solve(300.0);
  const auto score_now = [&] {
    ParticleTask task(set);
    const auto replayed = servo::replay(person.recording().sessions.front(), {},
                                        [&](const servo::ReplayedTick& tick) { task.hear(tick); });
    EXPECT_TRUE(replayed && replayed->identical());
    return task.score();
  };
  const scene::TaskScore pushed = score_now();
  EXPECT_EQ(pushed.state, scene::TaskState::Running) << "the pattern is done, but only computed";
  person.look();
  const scene::TaskScore looked = score_now();
  EXPECT_EQ(looked.state, scene::TaskState::Done) << scene::text_of(looked);
  EXPECT_LT(looked.time_s, 300.0);
  EXPECT_LE(looked.rms_m, scene::median_radius(set).si);
  EXPECT_EQ(looked.strokes, pushed.strokes);
  EXPECT_EQ(looked.truth, 0U);
  EXPECT_LT(looked.time_s, pushed.time_s) << "up to the last lift, without the looks";
  EXPECT_EQ(live_score(set, person.recording().sessions.front(), 17), looked) << "at 60 frames a second";
}

// After ten minutes of drift the picture is off by more than a radius.
TEST(ParticleTaskOfAStudent, FailsByAnOldPictureAndIsSolvedByLooks) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  for (const bool looks : {false, true}) {
    Person person(set, 11, 2);
    person.looks = looks;
    person.wait(600.0);
    person.solve(600.0);
    person.look();
    ParticleTask task(set);
    const auto replayed = servo::replay(person.recording().sessions.front(), {},
                                        [&](const servo::ReplayedTick& tick) { task.hear(tick); });
    ASSERT_TRUE(replayed && replayed->identical());
    EXPECT_EQ(task.score().state == scene::TaskState::Done, looks) << scene::text_of(task.score());
    if (looks) {
      EXPECT_LE(task.score().rms_m, scene::median_radius(set).si);
    }
  }
}

TEST(ParticleTaskOfAStudent, LaysARodAcrossItsPadsInThreeMinutes) {
  const scene::ParticleSet set = test::particle_set("tube-and-electrodes");
  Person person(set, 3);
  const double begun_s = person.time_s();
  person.follow_plan();
  EXPECT_LT(person.time_s() - begun_s, 180.0);
  const auto state = scene::pattern_state(set, scene::shared_pattern_of(set),
                                          *places_of({.set = &set, .pages = person.recording().pages()}));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->touched, 2U);
  EXPECT_TRUE(state->done());
}

}  // namespace particle_task_test
}  // namespace afm::exhibit
