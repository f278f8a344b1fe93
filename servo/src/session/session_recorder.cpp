// SPDX-License-Identifier: Apache-2.0
#include "servo/session_recorder.h"

#include <memory>
#include <utility>

#include "scene/shared/push_values.h"
#include "servo/live_picture.h"

namespace afm::servo {

namespace {

using scene::TipSample;

// True if the poses that touchafm has are those of this sample, and a session can begin with them.
bool has_poses_of(const TipSample& sample, const ServoClient& servo) {
  if (scene::has_marks(servo.model().particles)) return scene::digest_of(servo.mark_tiles()) == sample.push.digest;
  const std::uint32_t count = servo.model().particles.count;
  return count == 0 || scene::digest_of(servo.particle_pages(), count) == sample.push.digest;
}

bool same_contact(const TipSample& a, const TipSample& b) {
  return a.material == b.material && a.edit_revision == b.edit_revision && a.scale_mode == b.scale_mode &&
         a.settings == b.settings;
}

// True for an event that a person ordered, not caused by the tip.
bool is_order(physics::EventKind kind) {
  return kind == physics::EventKind::PushTakenBack || kind == physics::EventKind::ParticlesPutBack;
}

bool is_of(const TipSample& sample, const scene::TipState& tip) {
  return tip.material == sample.material && tip.active.edit_revision == sample.edit_revision &&
         tip.active.scale_mode == sample.scale_mode;
}

}  // namespace

bool can_begin_with(const TipSample& sample, const scene::TipState& tip, bool dynamic) {
  if (scene::is_armed(sample.servo_state) || sample.hand_force_n != 0.0) return false;
  if (sample.phase == physics::Phase::WaitForLift) return true;
  // an oscillating lever has more state than its position
  return sample.phase == physics::Phase::Free && !dynamic && is_of(sample, tip) &&
         sample.tip.z_m > tip.active.release_z_m;
}

bool SessionRecorder::goes_on_with(const TipSample& sample) const {
  return previous_ && same_contact(*previous_, sample) && sample.tick == previous_->tick + 1 && ticks_ < kLongestTicks;
}

bool SessionRecorder::add(const TipSample& sample, const ServoClient& servo, const LivePicture* picture) {
  const auto put = std::exchange(put_, std::nullopt);
  const bool taken_back = put && put->kind == physics::EventKind::PushTakenBack;
  if (!goes_on_with(sample) || (taken_back && !places_.take_back_to(sample.push.digest))) finish();
  const bool begins = ticks_ == 0;
  const bool first = std::exchange(first_, false) && servo.lost_samples() == 0;
  const bool fresh = first || (previous_ && !same_contact(*previous_, sample) && sample.tick == previous_->tick + 1);
  previous_ = sample;
  const auto is_dynamic = [&] {
    const auto& felt = servo.parameters(static_cast<std::size_t>(sample.material), sample.edit_revision);
    return felt.dynamic != 0 || scene::taps(felt);
  };
  if (begins && !fresh && !can_begin_with(sample, servo.tip(), is_dynamic())) return false;
  if (begins && !has_poses_of(sample, servo)) return false;
  if (begins && picture != nullptr && picture->looks()) return false;
  if (begins) begin(sample, servo, picture);
  if (!begins && put) session_.events.push_back(*put);
  if (servo.model().particles.count > 0) places_.add(sample.push);
  if (!scale_known_) take_scale(sample, servo.tip());
  session_.samples.push_back(sample);
  ++ticks_;
  return begins;
}

void SessionRecorder::add(const scene::TipEvent& event) {
  if (is_order(event.kind)) {
    put_ = event;
  } else if (ticks_ > 0) {
    session_.events.push_back(event);
  }
}

void SessionRecorder::add(const WallFrame& frame) {
  if (ticks_ > 0) session_.wall.push_back(frame);
}

void SessionRecorder::forget_records() {
  session_.samples.clear();
  session_.events.clear();
  session_.wall.clear();
}

void SessionRecorder::begin_again() {
  session_ = {};
  places_.clear();
  ticks_ = 0;
}

void SessionRecorder::finish() {
  if (ticks_ > 0 && scale_known_) finished_ = std::move(session_);
  begin_again();
}

std::optional<RecordedSession> SessionRecorder::take_finished() { return std::exchange(finished_, std::nullopt); }

void SessionRecorder::begin(const TipSample& sample, const ServoClient& servo, const LivePicture* picture) {
  const scene::SharedModel& model = servo.model();
  session_.parameters = servo.parameters(static_cast<std::size_t>(sample.material), sample.edit_revision);
  session_.material = session_.parameters.name.data();
  if (session_.parameters.measured_curve != scene::kNoMeasuredCurve) {
    session_.curve = servo.curve(static_cast<std::size_t>(sample.material), sample.edit_revision);
    session_.parameters.measured_curve = 0;
  }
  if (session_.parameters.height_field == scene::kTopography) {
    session_.topography = servo.topography();
  } else if (session_.parameters.height_field != scene::kNoHeightField) {
    session_.surface = model.height_fields[std::exchange(session_.parameters.height_field, 0)];
  }
  if (session_.parameters.law_map != 0) {
    session_.law_map = std::make_shared<scene::SharedLawMap>(model.law_map);
    session_.force_map = force_map_;
  } else if (session_.curve && session_.curve->column >= 0 && session_.curve->row >= 0 && force_map_) {
    session_.force_map = force_map_;
    session_.force_map->pixel = {static_cast<std::size_t>(session_.curve->column),
                                 static_cast<std::size_t>(session_.curve->row)};
  }
  if (scene::are_there(model.particles)) {
    const auto pages = servo.particle_pages();
    const auto tiles = servo.mark_tiles();
    session_.particles = RecordedParticles{.set = model.particles,
                                           .pages = {pages.begin(), pages.end()},
                                           .tiles = {tiles.begin(), tiles.end()},
                                           .picture = {}};
    session_.particles->set.level.since_ns = sample.level.since_ns;
    scene::adjust(sample.settings, session_.particles->set);
    if (picture != nullptr) session_.particles->picture = picture->state();
    session_.has_plans = true;
  }
  session_.room_from_sample = servo.room_from_sample();
  session_.device = servo.device();
  session_.rate_hz = servo.settings().rate_hz;
  session_.dead_man = servo.settings().dead_man;
  for (std::size_t i = 0; i < model.material_count; ++i) session_.shown.emplace_back(model.materials[i].name.data());
  scale_known_ = false;
}

// Takes the scale from the newest state, unless that belongs to the previous or next contact model; the next sample
// then tries again.
void SessionRecorder::take_scale(const TipSample& sample, const scene::TipState& tip) {
  scale_known_ = is_of(sample, tip);
  if (!scale_known_) return;
  session_.realtime = tip.realtime != 0;
  session_.hand_m_per_m = tip.active.scale.hand_m_per_m;
  session_.hand_n_per_n = tip.active.scale.hand_n_per_n;
  session_.slow_motion = tip.active.slow_motion;
}

}  // namespace afm::servo
