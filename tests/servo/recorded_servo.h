// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "scene/shared/push_values.h"
#include "scene/shared/shared_segment.h"
#include "servo/live_picture.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/paper_model.h"

// Sessions for the tests of their replay.
namespace afm::servo {

// The simulated hand on a device with another frame and other limits, which can fail.
class FaultyDevice final : public haptics::HapticDevice {
 public:
  FaultyDevice() : spec_(hand_.spec()) {
    spec_.name = "faulty device";
    spec_.contact_point_m = kContact;
    spec_.workspace_min_m += kContact;
    spec_.workspace_max_m += kContact;
    spec_.max_force_n = 2.0;
    spec_.max_slew_n_per_s = 400.0;
  }

  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::DeviceSample read(std::int64_t now_ns) noexcept override {
    haptics::DeviceSample sample = hand_.read(now_ns);
    sample.position_m += kContact;
    sample.healthy = healthy;
    if (lost) sample.position_m.y = std::numeric_limits<double>::quiet_NaN();
    return sample;
  }
  void write(const haptics::ForceCommand& command) noexcept override { hand_.write(command); }
  void follow(const scene::HandScript& script) noexcept override { hand_.follow(script); }

  bool healthy = true;
  bool lost = false;

 private:
  static constexpr glm::dvec3 kContact{0.0123, -0.0207, 0.0031};
  haptics::SimulatedDevice hand_;
  haptics::DeviceSpec spec_;
};

// A servo with irregular ticks, as on a busy machine, but the same in every run. It records as
// touchafm does: one session per material.
class Recording {
 public:
  explicit Recording(const scene::SharedModel& model = test::paper_model())
      : segment_(std::move(*scene::SharedSegment::create(model, 0))),
        renderer_(segment_.renderer_side()),
        pages_(scene::pages_of(model.particles.count)),
        tiles_(scene::has_marks(model.particles) ? scene::kMarkTiles : 0),
        loop_(std::move(*haptics::ServoLoop::create(segment_, device, {.rate_hz = 1000.0}))) {}

  void choose(int material, scene::ScaleMode mode = scene::ScaleMode::Fit, const scene::PushSettings& settings = {}) {
    renderer_.store(
        scene::Selection{.material = material, .revision = ++selection_, .scale_mode = mode, .settings = settings});
    loop_->edits().build();
  }

  // Sends the scripted hand to a place on the sample, at a height above the contact point.
  void go(const glm::dvec2& place_m, double height_m, double seconds) {
    renderer_.store(
        scene::HandScript{.target_m = {place_m.x, height_m, -place_m.y}, .duration_s = seconds, .revision = ++script_});
  }

  void plan(const scene::PlannedPush& plan) { renderer_.store(plan); }

  // Removes the force, like the wall; the material stays.
  void release(int material, scene::ScaleMode mode = scene::ScaleMode::Fit) {
    renderer_.store(scene::Selection{.material = material, .revision = ++selection_, .scale_mode = mode, .release = 1});
  }

  void aim(double height_m, double seconds, bool pressed = false, double sideways_m = 0.003) {
    renderer_.store(scene::HandScript{.target_m = {sideways_m, height_m, -0.002},
                                      .duration_s = seconds,
                                      .revision = ++script_,
                                      .turn_on_pressed = pressed ? 1U : 0U});
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      if (heartbeats && tick_ % 16 == 0)
        renderer_.store(scene::RendererHeartbeat{.frame = ++frame_,
                                                 .stop = stop ? 1U : 0U,
                                                 .unseen = unseen ? 1U : 0U,
                                                 .take_back = taken_back,
                                                 .put_back = put_back,
                                                 .look = looks});
      if (scan && tick_ % 16 == 0) {
        scene::ScanLead lead = scan();
        lead.time_ns = now_ns;
        lead.revision = ++scan_revision_;
        renderer_.store(lead);
      }
      now_ns += 1'000'000 + 37'000 * (tick_ % 11) - (tick_ % 7) * 51'000;
      loop_->tick(now_ns, 0);
      for (std::uint32_t page = 0; page < pages_.size(); ++page) {
        if (const auto newer = renderer_.new_particle_page(page)) pages_[page] = *newer;
      }
      for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
        if (const auto newer = renderer_.new_mark_tile(tile)) tiles_[tile] = *newer;
      }
      std::vector<scene::TipEvent> came;
      while (const auto event = renderer_.pop_event()) came.push_back(*event);
      while (const auto sample = renderer_.pop_sample()) {
        draw(*sample, came);
        record(*sample);
      }
      if (came.empty()) continue;
      sessions.back().events.insert(sessions.back().events.end(), came.begin(), came.end());
    }
  }

  void arm() {
    aim(0.062, 0.3);
    run(900);
    aim(0.062, 0.0, true);
    run(100);
    aim(0.062, 0.0);
    run(600);
  }

  void cycle() {
    arm();
    aim(-0.012, 0.7);
    run(1200);
    aim(0.065, 0.7);
    run(1300);
  }

  // Turns the sample about the room's x axis, like a frame of the wall.
  void turn(double angle_rad) {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), angle_rad, glm::dvec3(1.0, 0.2, 0.0)) *
                              scene::rest_room_from_node(segment_.model(), 1);
    scene::SceneTransforms transforms;
    transforms.count = segment_.model().node_count;
    for (auto& node : transforms.room_from_node) {
      std::copy_n(glm::value_ptr(turned), node.size(), node.begin());
    }
    renderer_.store(transforms);
    sessions.back().wall.push_back({.time_ns = now_ns, .room_from_sample = transforms.room_from_node[1]});
  }

  scene::TipState state() { return *renderer_.tip_state(); }
  const std::vector<scene::ParticlePage>& pages() const { return pages_; }
  const std::vector<scene::MarkTile>& tiles() const { return tiles_; }

  FaultyDevice device;
  std::vector<RecordedSession> sessions;
  bool heartbeats = true;
  bool stop = false;
  bool unseen = false;
  std::uint32_t taken_back = 0;  // number of requests to take a push back
  std::uint32_t put_back = 0;
  std::uint32_t looks = 0;                // number of requests for second looks
  std::unique_ptr<LivePicture> picture;   // picture at levels 1 and 2, after the first tick
  std::function<scene::ScanLead()> scan;  // source of the scan of each frame; empty: none
  std::int64_t now_ns = 7'000'000'000;

 private:
  void draw(const scene::TipSample& sample, const std::vector<scene::TipEvent>& came) {
    const scene::SharedParticles& particles = segment_.model().particles;
    follow_settings(picture, particles, *renderer_.device(), sample.settings);
    if (!picture) return;
    for (const scene::TipEvent& event : came) picture->add(event);
    picture->add(sample, pages_);
  }

  void record(const scene::TipSample& sample) {
    const auto begins = [&](const scene::TipSample& before) {
      return before.material != sample.material || before.settings != sample.settings;
    };
    if (sessions.empty() || begins(sessions.back().samples.back())) {
      RecordedSession& session = sessions.emplace_back();
      session.parameters = segment_.model().materials[static_cast<std::size_t>(sample.material)];
      session.material = session.parameters.name.data();
      session.device = *renderer_.device();
      session.rate_hz = 1000.0;
      session.room_from_sample = segment_.model().nodes[1].parent_from_node;
      if (session.parameters.law_map != 0) {
        session.law_map = std::make_shared<scene::SharedLawMap>(segment_.model().law_map);
      }
      if (!pages_.empty() || !tiles_.empty()) {
        session.particles = {.set = segment_.model().particles, .pages = pages_, .tiles = tiles_};
        scene::adjust(sample.settings, session.particles->set);
      }
      if (picture) {
        session.particles->set.level.since_ns = sample.level.since_ns;
        session.particles->picture = picture->state();
        session.hand_m_per_m = session.hand_n_per_n = 1.0;
      }
    }
    sessions.back().samples.push_back(sample);
  }

  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  std::vector<scene::ParticlePage> pages_;  // newest pages
  std::vector<scene::MarkTile> tiles_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  std::uint32_t selection_ = 0;
  std::uint32_t script_ = 0;
  std::uint32_t scan_revision_ = 0;
  std::uint64_t frame_ = 0;
  int tick_ = 0;
};

inline double strongest_n(const RecordedSession& session) {
  double strongest = 0;
  for (const scene::TipSample& sample : session.samples) strongest = std::max(strongest, std::abs(sample.hand_force_n));
  return strongest;
}

inline void expect_same(const RecordedSession& session) {
  const auto replayed = replay(session);
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_EQ(replayed->ticks, session.samples.size());
  if (replayed->first) {
    ADD_FAILURE() << session.material << ": tick " << replayed->first->index << " of " << replayed->ticks << ", "
                  << replayed->first->quantity << " was " << replayed->first->recorded << ", is "
                  << replayed->first->replayed << "; " << replayed->different_ticks << " differ";
  }
  EXPECT_FALSE(replayed->first_event);
  EXPECT_EQ(replayed->largest_hand_n, 0.0);
}

// Saves a session with particles, loads it again and replays it.
inline RecordedSession saved_and_replayed(const RecordedSession& session, const std::string& path) {
  EXPECT_TRUE(save_session(session, path));
  RecordedSession loaded = load_session(path).value();
  EXPECT_EQ(loaded.particles->set, session.particles->set);
  expect_same(loaded);
  return loaded;
}

}  // namespace afm::servo
