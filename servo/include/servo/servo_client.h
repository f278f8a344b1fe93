// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "scene/shared/shared_segment.h"
#include "servo/running_servo.h"
#include "servo/servo_choice.h"
#include "servo/tip_listener.h"

namespace afm::servo {

// Frame loop's interface to the servo: starts it with a new segment, sends it the selection and the transforms, and
// receives every sample and event. One thread.
class ServoClient {
 public:
  // `program` is the running touchafm, with touchafm-servo in the same folder. Takes over a servo that is waiting
  // because its renderer died, if its scene, device and settings are the same and settings.linger_s, the time that this
  // one would wait, is not zero. Otherwise it asks that servo to exit first. `topography` is the one announced in the
  // model; the scene that shows it is identified by its digest.
  static core::Result<std::unique_ptr<ServoClient>> start(const scene::SharedModel& model, std::uint64_t scene_digest,
                                                          const ServoChoice& choice, const std::string& program,
                                                          const scene::Topography& topography = {});

  struct Update {
    std::vector<scene::TipSample> samples;
    std::vector<scene::TipEvent> events;
  };

  // Call once per frame: returns everything new since the last call, and the newest state. Fails if the servo has
  // ended. If the servo runs but has been silent for 200 ms, tip() reports Fault with ServoSilent until its next state
  // arrives.
  core::Result<Update> poll(std::int64_t now_ns);

  // Starts to pass everything that poll() returns to `audience` first, in a separate thread and within
  // milliseconds, for uses that cannot wait for a frame. `audience` must outlive this object. Call once.
  void listen(TipAudience& audience);

  // Sends the frame loop's heartbeat, as poll() does too. After 250 ms without one, the servo assumes that the loop
  // hangs.
  void beat(std::int64_t now_ns);

  // Emergency stop by a person: the servo cuts the force in its next tick, whatever its state, and applies none for at
  // least 250 ms.
  void stop(std::int64_t now_ns);

  // Takes the newest push of particles back (TipPush::strokes), or puts all particles back where they were at the
  // start. Only without force: an order that arrives too early is dropped.
  void take_back_push(std::int64_t now_ns);
  void put_particles_back(std::int64_t now_ns);

  // Looks again at the particles near the tip (EventKind::LookedAgain), at level 1 and 2; only while the tip is off the
  // particles: an order at another time is dropped.
  void look_again(std::int64_t now_ns);

  // Visibility of the picture, sent with every following heartbeat. While nobody sees it, as when a headset is lost,
  // the servo applies no force; when it is seen again, the hand must lift and press Turn-On, as after the start.
  enum class Picture { Seen, Unseen };
  void set_picture(Picture picture) { picture_ = picture; }

  const scene::TipState& tip() const { return tip_; }

  // Newest push, and the newest pages of particles, from 0 to pages_of(model().particles.count) - 1; as of the last
  // poll(). changed_pages() are those that this poll() replaced. Without particles there are no pages.
  const scene::TipPush& push() const { return push_; }
  std::span<const scene::ParticlePage> particle_pages() const { return pages_; }
  std::span<const std::uint32_t> changed_pages() const { return changed_pages_; }

  // Newest tiles of a soft sample or of ink, kMarkTiles of them or none; marks() counts the changes.
  std::span<const scene::MarkTile> mark_tiles() const { return tiles_; }
  std::uint64_t marks() const { return marks_; }
  scene::ServoTiming timing() const { return side_.servo_timing().value_or(scene::ServoTiming{}); }
  const haptics::ServoSettings& settings() const { return settings_; }
  const scene::SharedDevice& device() const { return device_; }  // device of the servo, valid after the first poll()
  const scene::SharedModel& model() const { return segment_.model(); }
  scene::Topography topography() const { return segment_.topography(); }
  const std::array<double, 16>& room_from_sample() const { return room_from_sample_; }  // as in the last place()

  // Parameters of a material after this edit; edit 0: as loaded.
  const scene::SharedContact& parameters(std::size_t material, std::uint32_t edit_revision) const;

  // The curve of a material with the law Measured, as of its parameters.
  const scene::SharedMeasuredCurve& curve(std::size_t material, std::uint32_t edit_revision) const;

  std::uint64_t lost_samples() const { return side_.lost_samples() + (listener_ ? listener_->lost_samples() : 0); }

  // Selects the material under the tip, its scale, and the settings among particles; all take effect once the tip is
  // off the sample, after the force has been removed. Without `mode`, keeps the previous scale, initially Fit, and
  // settings. Those that the device or the set does not allow have no effect: push().settings are in use.
  void choose(std::int32_t material) { choose(material, selection_.scale_mode, selection_.settings); }
  void choose(std::int32_t material, scene::ScaleMode mode, const scene::PushSettings& settings = {});

  // Removes the force at once, also in contact; the hand must lift and press Turn-On again. The choice stays. Without a
  // choice there is no force to remove.
  void take_force_away();
  std::int32_t chosen() const { return selection_.material; }  // can differ from the tip's current material; -1: none

  // Changes the parameters of a material, given by its index in the shared model; returns the revision of the edit.
  // Like a selection, it takes effect once the tip is off the sample, after the force has been removed, so that the
  // hand has to lift and press Turn-On again. tip().edit_revision shows when. tip().edit_refused is set if the
  // parameters cannot be felt; the servo logs the reason. Edits may come at any rate: the newest one for each material
  // counts. `curve` replaces that of a material with the law Measured; null: does not.
  std::uint32_t change(std::size_t material, const scene::SharedContact& parameters,
                       std::shared_ptr<const scene::SharedMeasuredCurve> curve = nullptr);
  void place(const scene::SceneTransforms& transforms);
  void script(const scene::HandScript& script);

  // Call once per frame of a scan that involves the hand; sets the revision itself.
  void lead(const scene::ScanLead& lead);

  // Plan of a push, whose groove guides the hand until another plan, or none, replaces it. An impossible one is refused
  // by the servo.
  void plan(const scene::PlannedPush& plan) { side_.store(plan); }

 private:
  ServoClient(scene::SharedSegment segment, const haptics::ServoSettings& settings)
      : settings_(settings), segment_(std::move(segment)), side_(segment_.renderer_side()) {}

  struct Heard {
    std::int64_t time_ns = 0;
    int polls = 0;  // number of polls since then
  };
  struct Edit {
    scene::SharedContact parameters;
    std::shared_ptr<const scene::SharedMeasuredCurve> curve;  // null: the curve of the model
  };

  const Edit* edit_of(std::uint32_t revision) const;  // edit of this client; null: none of ours

  void go_on();
  void take_state(std::int64_t now_ns);
  void take_particles();

  haptics::ServoSettings settings_;
  core::MonotonicClock clock_;  // clock of a device in a thread of this process
  scene::SharedSegment segment_;
  scene::RendererSide side_;
  scene::Selection selection_;
  std::vector<Edit> edits_;      // all edits sent
  std::uint32_t edit_base_ = 0;  // newest edit of the predecessor; our first edit is the next one
  std::array<double, 16> room_from_sample_{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  scene::SharedDevice device_;
  scene::TipState tip_;
  scene::TipPush push_;
  std::vector<scene::ParticlePage> pages_;
  std::vector<std::uint32_t> changed_pages_;
  std::vector<scene::MarkTile> tiles_;
  std::uint64_t marks_ = 0;
  std::optional<Heard> heard_;     // time at which the servo's tick last changed
  std::uint32_t script_base_ = 0;  // newest script of the predecessor
  std::uint32_t leads_ = 0;
  std::uint64_t beats_ = 0;
  std::uint32_t taken_back_ = 0;
  std::uint32_t put_back_ = 0;
  std::uint32_t looked_ = 0;
  std::optional<std::int64_t> stopped_ns_;  // time of the last stop()
  Picture picture_ = Picture::Seen;         // state last set by set_picture()
  std::unique_ptr<TipListener> listener_;
  std::unique_ptr<Servo> servo_;  // last member, because the servo must end before its segment is destroyed
};

}  // namespace afm::servo
