// SPDX-License-Identifier: Apache-2.0
#include "servo/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/check.h"
#include "haptics/safety.h"
#include "haptics/sample_axes.h"
#include "haptics/servo_loop.h"
#include "scene/shared/shared_segment.h"
#include "servo/live_picture.h"

namespace afm::servo {

namespace {

using haptics::DeviceSample;
using haptics::SafetyGovernor;
using scene::RendererLink;
using scene::TipEvent;
using scene::TipSample;

// Plays the hand of one sample after another. The motors' heat at the start of a session is unknown, so the recorded
// heat is reported as if measured by the device: the governor uses the larger of that and its own estimate, which
// starts cold and is never larger.
class RecordedHand final : public haptics::HapticDevice {
 public:
  explicit RecordedHand(const RecordedSession& session) : spec_(haptics::spec_of(session.device)) {}

  void show(const TipSample& sample, bool healthy) {
    const auto& [x, y, z] = sample.hand_from_contact_m;
    now_ = {.position_m = glm::dvec3(x, y, z),
            .turn_on = sample.turn_on != 0,
            .healthy = healthy,
            .motor_heat = sample.motor_heat};
  }

  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t /*now_ns*/) noexcept override { return now_; }
  void write(const haptics::ForceCommand& /*command*/) noexcept override {}

 private:
  haptics::DeviceSpec spec_;
  DeviceSample now_;
};

std::array<double, 3> array_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// First value in which two records differ.
template <class Record>
std::optional<Difference> difference(std::size_t index, const Record& recorded, const Record& replayed) {
  std::optional<Difference> first;
  const auto compare = [&]<class Value>(const char* quantity, const Value& was, const Value& is) {
    // bit for bit: -0.0 differs from 0.0, and NaNs are equal only with equal bits
    using Bytes = std::array<std::byte, sizeof(Value)>;
    if (first || std::bit_cast<Bytes>(was) == std::bit_cast<Bytes>(is)) return;
    first = Difference{index, quantity, static_cast<double>(was), static_cast<double>(is)};
  };
  for_each_result(
      [&]<class Value>(const char* quantity, const Value& was, const Value& is) {
        if constexpr (scene::Described<Value>) {
          for_each_leaf(compare, was, is);
        } else {
          compare(quantity, was, is);
        }
      },
      recorded, replayed);
  return first;
}

bool lives(RendererLink link) { return link == RendererLink::Alive || link == RendererLink::Unseen; }

// True if a heartbeat in this tick reproduces what the servo saw: the last one before a hang must be just old enough at
// the time the hang was noticed.
bool beats(std::span<const TipSample> from_here) {
  const std::int64_t now_ns = from_here.front().time_ns;
  if (!lives(from_here.front().renderer)) return false;
  for (const TipSample& sample : from_here) {
    if (sample.time_ns - now_ns > SafetyGovernor::kHangNs) break;
    if (sample.renderer == RendererLink::Hung) return false;
  }
  return true;
}

// Servo with its own segment, in the session's time.
class Player {
 public:
  static core::Result<std::unique_ptr<Player>> create(const RecordedSession& session) {
    auto segment = scene::SharedSegment::create(*model_of(session), 0, session.topography);
    if (!segment) return tl::unexpected(segment.error());
    std::unique_ptr<Player> player(new Player(session, std::move(*segment)));
    player->lay_particles();
    auto loop = haptics::ServoLoop::create(player->segment_, player->hand_,
                                           {.rate_hz = session.rate_hz, .dead_man = session.dead_man});
    if (!loop) return core::failure(core::ErrorCategory::BadInputFile, loop.error().message);
    player->loop_ = std::move(*loop);
    if (session.particles && session.particles->set.level.level > 0) {
      auto picture = LivePicture::create(session.particles->set, session.device, session.particles->picture);
      if (!picture) return core::failure(core::ErrorCategory::BadInputFile, picture.error().message);
      player->picture_ = std::move(*picture);
    }
    player->lay_sample();
    return player;
  }

  // Runs the tick of this sample; false if the servo produced none.
  bool play(std::size_t index) {
    const TipSample& sample = session_.samples[index];
    order_what_came(sample.time_ns);
    const bool was_stopped = index > 0 && session_.samples[index - 1].renderer == RendererLink::Stopped;
    const bool goes_on = was_stopped && lives(sample.renderer);
    if (goes_on || beats(std::span(session_.samples).subspan(index))) {
      beat({.unseen = sample.renderer == RendererLink::Unseen ? 1U : 0U});
    }
    if (sample.renderer == RendererLink::Stopped) beat({.stop = 1});
    if (sample.renderer == RendererLink::Leaving) beat({.leaving = 1});
    if (sample.renderer == RendererLink::Died) loop_->renderer_died();
    // visible in the tick after
    const bool changes = index + 1 < session_.samples.size() && session_.samples[index + 1].changing != 0;
    if (changes != (chosen_ != 0)) choose(changes ? 1 : 0);
    turn_to(sample);
    lead(sample.scan);
    plan(sample.plan);
    hand_.show(sample, sample.device_healthy != 0);
    loop_->tick(sample.time_ns, sample.wake_us);
    while (const auto event = renderer_.pop_event()) events_.push_back(*event);
    const auto given = renderer_.pop_sample();
    if (given) sample_ = *given;
    take_pages();
    if (picture_) draw(sample);
    return given.has_value();
  }

  // Particles after the newest tick.
  ReplayedParticles particles() {
    ReplayedParticles now{.pages = pages_,
                          .tiles = tiles_,
                          .push = renderer_.tip_push().value_or(scene::TipPush{}),
                          .plan = sample_.plan,
                          .picture = std::nullopt};
    if (!picture_) return now;
    now.pages.assign(picture_->shown().begin(), picture_->shown().end());
    now.picture = picture_->now();
    return now;
  }

  const TipSample& sample() const { return sample_; }
  const std::vector<TipEvent>& events() const { return events_; }

  // Passes the newest tick on, whose sample has this index.
  void tell(std::size_t index, const HearTick& hear) const {
    if (hear) hear({.sample = session_.samples[index], .events = came(), .pages = pages_, .picture = picture_.get()});
  }

 private:
  Player(const RecordedSession& session, scene::SharedSegment segment)
      : session_(session), segment_(std::move(segment)), renderer_(segment_.renderer_side()), hand_(session) {
    if (!session.particles) return;
    pages_ = session.particles->pages;
    tiles_ = session.particles->tiles;
  }

  // Events since the tick before the newest.
  std::span<const TipEvent> came() const {
    return std::span(session_.events).subspan(first_event_, next_event_ - first_event_);
  }

  void draw(const TipSample& sample) {
    for (const TipEvent& event : came()) picture_->add(event);
    picture_->add(sample, pages_);
  }

  void beat(scene::RendererHeartbeat heartbeat) {
    heartbeat.frame = ++frame_;
    heartbeat.look = looked_;
    heartbeat.take_back = taken_back_;
    heartbeat.put_back = put_back_;
    renderer_.store(heartbeat);
  }

  // An order that took effect is known by its event; it came with a heartbeat of the same tick.
  void order_what_came(std::int64_t now_ns) {
    first_event_ = next_event_;
    for (; next_event_ < session_.events.size() && session_.events[next_event_].time_ns <= now_ns; ++next_event_) {
      if (session_.events[next_event_].kind == physics::EventKind::PushTakenBack) ++taken_back_;
      if (session_.events[next_event_].kind == physics::EventKind::ParticlesPutBack) ++put_back_;
      if (session_.events[next_event_].kind == physics::EventKind::LookedAgain) ++looked_;
    }
  }

  void take_pages() {
    if (sample_.push.digest == digest_) return;
    digest_ = sample_.push.digest;
    for (std::uint32_t i = 0; i < pages_.size(); ++i) {
      if (const auto newer = renderer_.new_particle_page(i)) pages_[i] = *newer;
    }
    for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
      if (const auto newer = renderer_.new_mark_tile(i)) tiles_[i] = *newer;
    }
  }

  void lead(const scene::ScanLead& scan) {
    if (scan == scan_) return;
    scan_ = scan;
    renderer_.store(scan);
  }

  void plan(const scene::PlannedPush& plan) {
    if (plan == plan_) return;
    plan_ = plan;
    renderer_.store(plan);
  }

  void choose(std::int32_t material) {
    chosen_ = material;
    renderer_.store(scene::Selection{.material = material,
                                     .revision = ++selection_,
                                     .scale_mode = session_.samples.front().scale_mode,
                                     .release = material != 0 ? 1U : 0U});
  }

  // Turns the sample as on the wall: uses the next frame that gives these axes.
  void turn_to(const TipSample& sample) {
    const auto has_its_axes = [&](const haptics::SampleAxes& axes) {
      return array_of(axes.normal()) == sample.sample_normal && array_of(axes.x()) == sample.sample_x;
    };
    if (has_its_axes(axes_)) return;
    for (std::size_t i = next_frame_; i < session_.wall.size(); ++i) {
      haptics::SampleAxes axes;
      axes.set_orientation(session_.wall[i].room_from_sample);
      if (!has_its_axes(axes)) continue;
      next_frame_ = i + 1;
      return place(session_.wall[i].room_from_sample);
    }
  }

  // Places the particles as if a previous servo had left them there.
  void lay_particles() {
    if (!session_.particles) return;
    scene::ServoSide side = segment_.servo_side();
    for (std::uint32_t i = 0; i < session_.particles->pages.size(); ++i) side.store(session_.particles->pages[i], i);
    for (std::uint32_t i = 0; i < session_.particles->tiles.size(); ++i) side.store(session_.particles->tiles[i], i);
  }

  void place(const std::array<double, 16>& room_from_sample) {
    axes_.set_orientation(room_from_sample);
    scene::SceneTransforms transforms;
    transforms.count = 1;
    transforms.room_from_node[0] = room_from_sample;
    renderer_.store(transforms);
  }

  // Prepares the servo before the session, with times so early that a hang in progress is one again: one tick that
  // finds the hand in place, and one at whose end the material takes effect. A session that begins in a fault starts
  // with a servo in that fault.
  void lay_sample() {
    const TipSample& first = session_.samples.front();
    place(session_.room_from_sample);
    if (first.renderer != RendererLink::Absent) beat({});
    const std::int64_t before_ns = first.time_ns - SafetyGovernor::kHangNs - loop_->period_ns();
    hand_.show(first, true);
    loop_->tick(before_ns - loop_->period_ns(), 0);
    choose(0);
    hand_.show(first, first.servo_state != scene::ServoState::Fault);
    loop_->tick(before_ns, 0);
  }

  const RecordedSession& session_;
  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  RecordedHand hand_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  std::uint64_t frame_ = 0;
  std::uint32_t taken_back_ = 0;
  std::uint32_t put_back_ = 0;
  std::uint32_t looked_ = 0;
  std::size_t first_event_ = 0;  // first event of the newest tick
  std::size_t next_event_ = 0;
  std::int32_t chosen_ = 0;
  haptics::SampleAxes axes_;    // axes of the last placement
  std::size_t next_frame_ = 0;  // next frame of the wall that may turn the sample
  std::uint32_t selection_ = 0;
  scene::ScanLead scan_;     // scan that was last sent
  scene::PlannedPush plan_;  // plan that was last sent
  TipSample sample_;
  std::vector<TipEvent> events_;
  std::vector<scene::ParticlePage> pages_;
  std::vector<scene::MarkTile> tiles_;
  std::uint64_t digest_ = 0;              // digest of pages_
  std::unique_ptr<LivePicture> picture_;  // picture of the particles; null at level 0
};

}  // namespace

core::Result<Replay> replay(const RecordedSession& session, const ReplayRange& range, const HearTick& hear) {
  const auto player = Player::create(session);
  if (!player) return tl::unexpected(player.error());
  const auto is_compared = [&](std::int64_t time_ns) { return range.holds(session.seconds_since_start(time_ns)); };
  Replay result;
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    const TipSample& recorded = session.samples[i];
    if (session.seconds_since_start(recorded.time_ns) > range.to_s) break;
    const bool given = (*player)->play(i);
    (*player)->tell(i, hear);
    if (!is_compared(recorded.time_ns)) continue;
    ++result.ticks;
    std::optional<Difference> found = Difference{i, "material", static_cast<double>(recorded.material), -1.0};
    if (given) {
      const TipSample& replayed = (*player)->sample();
      found = difference(i, recorded, replayed);
      result.largest_tip_n = std::max(result.largest_tip_n, std::abs(recorded.tip.force_n - replayed.tip.force_n));
      result.largest_hand_n = std::max(result.largest_hand_n, std::abs(recorded.hand_force_n - replayed.hand_force_n));
    }
    if (!found) continue;
    ++result.different_ticks;
    if (!result.first) result.first = found;
  }
  std::vector<TipEvent> given = (*player)->events(), recorded = session.events;
  for (std::vector<TipEvent>* events : {&given, &recorded}) {
    std::erase_if(*events, [&](const TipEvent& event) { return !is_compared(event.time_ns); });
  }
  result.events = given.size();
  for (std::size_t i = 0; i < std::max(given.size(), recorded.size()) && !result.first_event; ++i) {
    if (i < given.size() && i < recorded.size()) {
      result.first_event = difference(i, recorded[i], given[i]);
    } else {
      result.first_event =
          Difference{i, "count", static_cast<double>(recorded.size()), static_cast<double>(given.size())};
    }
  }
  return result;
}

core::Result<ReplayedParticles> replay_particles(const RecordedSession& session, std::int64_t time_ns,
                                                 const HearTick& hear) {
  AFM_CHECK(session.particles.has_value());
  const auto player = Player::create(session);
  if (!player) return tl::unexpected(player.error());
  const auto later = std::find_if(session.samples.begin(), session.samples.end(),
                                  [&](const TipSample& sample) { return sample.time_ns > time_ns; });
  const auto ticks = std::max<std::size_t>(1, static_cast<std::size_t>(later - session.samples.begin()));
  for (std::size_t i = 0; i < ticks; ++i) {
    (*player)->play(i);
    (*player)->tell(i, hear);
  }
  const TipSample& recorded = session.samples[ticks - 1];
  if ((*player)->sample().push.digest != recorded.push.digest) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("the session's particles cannot be placed at {:.3f} s: this program's replay has "
                                     "moved them elsewhere by then (touchafm replay names the first difference)",
                                     session.seconds_since_start(recorded.time_ns)));
  }
  return (*player)->particles();
}

}  // namespace afm::servo
