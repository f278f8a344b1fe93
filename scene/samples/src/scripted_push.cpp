// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/scripted_push.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "physics/manipulation/sample_drift.h"
#include "physics/manipulation/tip_meeting.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/pattern_state.h"
#include "scene/samples/pattern_task.h"

namespace afm::scene {
namespace {

using physics::Frequency;
using physics::Length;
using physics::LeverBase;
using physics::OperatorsPicture;
using physics::ParticlePlace;
using physics::PushTick;
using physics::Sideways;

constexpr std::size_t kMostChanges = 10'000;

std::vector<ParticlePlace> places_of(const physics::PushedParticles& particles) {
  std::vector<ParticlePlace> places;
  places.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) places.push_back({particles.position(i), particles.turn(i)});
  return places;
}

// Keeps the score of the scripted hand, as a live window does for a person, except that a touch too weak to be felt
// (FeltParticles::kFeltN) can also end in a loss.
class ScriptedTask {
 public:
  explicit ScriptedTask(const ParticleSet& set)
      : normal_n_per_m_(set.setup.springs.normal.si),
        blind_(set.blind),
        task_(set, pattern_of(set)),
        meeting_(set.setup) {
    meeting_.begin(set.start);
  }

  void follow(const physics::PushedParticles& particles, double time_s, const OperatorsPicture* picture) {
    const PushTick& tick = particles.last();
    const auto events = meeting_.follow(particles, tick.normal.si != 0.0);
    for (const auto& event : events.all()) task_.add(event.kind, event.before.si);
    if (tick.yields > yields_) task_.add(physics::EventKind::ParticleGave, tick.gave_at.si);
    yields_ = tick.yields;
    if (!particles.moved().empty()) ++places_;
    add(particles, time_s, picture);
  }

  // The hand stays where its last move ended, as long as it takes to end the task.
  TaskScore end(const physics::PushedParticles& particles, double time_s, const OperatorsPicture* picture) {
    const TaskScore ended = task_.score();
    add(particles, time_s + 1e-9 * static_cast<double>(PatternTask::kRestNs), picture);
    return task_.score().state == TaskState::Done ? task_.score() : ended;
  }

 private:
  void add(const physics::PushedParticles& particles, double time_s, const OperatorsPicture* picture) {
    const PushTick& tick = particles.last();
    const bool touches = tick.particle != physics::kNoParticle;
    // of the particles alone, without what a lever that presses on the bare sample would have
    const double lift_n = tick.lift.si + normal_n_per_m_ * std::min(0.0, tick.base.z.si);
    const auto lateral = touches ? tick.lateral : Sideways<physics::Force>{};
    task_.add({.time_ns = std::llround(1e9 * time_s),
               .base_m = {tick.base.position.x.si, tick.base.position.y.si, tick.base.z.si},
               .lateral_n = {lateral.x.si, lateral.y.si},
               .lift_n = touches ? lift_n : 0.0,
               .places = places_,
               .particle = touches ? static_cast<std::int32_t>(tick.particle) : kNoParticle,
               .carries = tick.state == physics::PushState::Carried,
               .truth = picture == nullptr && !blind_});
    if (!task_.unjudged()) return;
    if (picture == nullptr) return task_.judge(places_of(particles));
    if (picture->all_measured()) task_.judge(picture->shown());
  }

  double normal_n_per_m_;
  bool blind_;
  PatternTask task_;
  physics::TipMeeting meeting_;
  std::uint64_t places_ = 0;
  std::uint64_t yields_ = 0;
};

// Setup of the particles themselves: at level 2, the pull-offs of spheres that stick scatter.
physics::PushSetup true_setup(const ParticleSet& set, const PushScript& script) {
  physics::PushSetup setup = set.setup;
  if (script.level < 2) return setup;
  for (physics::ParticleSpecies& species : setup.species) {
    if (species.sticks && species.scatter_seed == 0) species.scatter_seed = static_cast<std::uint16_t>(script.seed);
  }
  return setup;
}

LeverBase moved(const LeverBase& base, const Sideways<Length>& by) { return {base.position + by, base.z}; }

// Plays the hand, the particles below it, and their picture, tick by tick.
class Player {
 public:
  Player(const ParticleSet& set, const PushScript& script)
      : script_(script),
        period_(1.0 / script.rate.si),
        all_ticks_(static_cast<std::size_t>(all_ticks(set, script.rate))),
        drift_(physics::kUsualDrift, static_cast<std::uint64_t>(script.seed)),
        particles_(true_setup(set, script), set.particles, set.start) {
    if (has_task(set)) task_.emplace(set);
    if (script.level > 0) played_.picture.emplace(set.setup, set.particles, set.start, script.level > 1, script.looks);
    now_.tick = particles_.last();
    played_.samples.push_back(now_);
    played_.least_margin_j = margin_j(now_.tick);
  }

  void move(const LeverBase& from, const HandMove& move) {
    const std::size_t ticks = ticks_of(from, move, script_.rate);
    for (std::size_t i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(ticks);
      go_to(on_the_way(from, move, share));
    }
    for (std::size_t i = 0; i < waiting_ticks(move, script_.rate); ++i) go_to(move.to);
    played_.ends.push_back(now_);
  }

  ScriptedPush end() {
    played_.seconds = now_.time_s;
    if (task_) played_.score = task_->end(particles_, played_.seconds, picture());
    played_.at = places_of(particles_);
    for (ParticlePlace& place : played_.at) place.position = place.position + played_.drift;
    return std::move(played_);
  }

 private:
  const OperatorsPicture* picture() const { return played_.picture ? &*played_.picture : nullptr; }

  void go_to(const LeverBase& written) {
    const PushTick before = now_.tick;
    const LeverBase base = played_.picture ? moved(written, played_.picture->found()) : written;
    now_.time_s = static_cast<double>(++played_.ticks) * period_.si;
    if (script_.level < 2) {
      now_.tick = particles_.move_to(base, period_);
    } else {
      played_.drift = drift_.after(physics::Time(now_.time_s));
      now_.tick = particles_.move_to(moved(base, played_.drift * -1.0), period_);
      now_.tick.base = moved(now_.tick.base, played_.drift);
      now_.tick.apex = moved(now_.tick.apex, played_.drift);
    }
    if (played_.picture) played_.picture->follow(base, period_, particles_, played_.drift);
    if (task_) task_->follow(particles_, now_.time_s, picture());
    if (now_.tick.lagging) ++played_.lagging;
    played_.least_margin_j = std::min(played_.least_margin_j, margin_j(now_.tick));
    if (now_.tick.state != before.state || now_.tick.particle != before.particle) {
      played_.more_changes = played_.changes.size() == kMostChanges;
      if (!played_.more_changes) played_.changes.push_back(now_);
    }
    // the sample of this tick: the k-th of N is the tick k/(N - 1) of the way
    const auto sample_count = static_cast<std::size_t>(script_.samples);
    if (played_.ticks * (sample_count - 1) >= played_.samples.size() * all_ticks_) played_.samples.push_back(now_);
  }

  PushScript script_;
  physics::Time period_;
  std::size_t all_ticks_;
  physics::SampleDrift drift_;
  physics::PushedParticles particles_;
  std::optional<ScriptedTask> task_;
  ScriptedPush played_;
  PushMoment now_;
};

}  // namespace

bool ScriptedPush::judged() const { return !picture || picture->all_measured(); }

std::vector<ParticlePlace> ScriptedPush::judged_places() const {
  return picture ? std::vector<ParticlePlace>(picture->shown().begin(), picture->shown().end()) : at;
}

double margin_j(const PushTick& tick) { return (tick.given - tick.lost - tick.stored).si; }

ScriptedPush play(const ParticleSet& set, const PushScript& script) {
  Player player(set, script);
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    player.move(from, move);
    from = move.to;
  }
  return player.end();
}

}  // namespace afm::scene
