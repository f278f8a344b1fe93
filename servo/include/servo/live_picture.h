// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "physics/manipulation/sample_drift.h"
#include "scene/shared/tip_blocks.h"
#include "servo/session_file.h"

namespace afm::haptics {
class FeltParticles;
}

namespace afm::servo {

// Measured: where a scan has found the particle. Computed: where a push has brought it, by the picture's model. Stale:
// measured so long ago that half its radius is in doubt (docs/manipulation.md, M62).
enum class Known : std::uint8_t { Measured, Computed, Stale };

// Square that a look scans, in the scanner's frame.
struct LookSquare {
  glm::dvec2 middle_m{0.0};
  double half_m = 0;
};

// Result of a completed look.
struct LookResult {
  std::size_t particle = 0;       // shown particle that was nearest to the tip
  std::size_t lines = 0;          // number of lines, fewer than physics::kLookLines if the hand came down
  std::optional<double> off_m{};  // distance from the place shown before to the measured one; empty: not found
  double swept_above_n = 0;       // gentle load that the scan exceeded while it pushed the particle away; 0: it did not
};

// Picture as a wall shows it.
struct PictureNow {
  std::uint32_t level = 0;
  std::vector<Known> known{};  // state of each particle
  std::size_t particle = 0;    // particle shown nearest to the tip, described by the figures below
  double age_s = 0;            // time since it was last measured
  double doubt_m = 0;          // doubt about the particle's place (M61)
  bool all_measured = true;
  std::optional<double> look_share{};  // fraction of lines done in the current look; empty: none
  std::uint64_t looks = 0;             // number of completed looks
  LookResult newest{};                 // newest completed look
};

// Picture that a person has of the particles and pushes by, at level 1 and 2 (scene::SharedLevel), from what a servo
// publishes, live or replayed: measured at first, computed while the tip pushes, and measured again around the shown
// particle nearest to the tip when a person orders it (EventKind::LookedAgain). A look takes a line each 0.1 s, and
// ends early when the tip comes down. One whose scan presses harder than is gentle (ScanHand::Looks) finds no particle
// that it pushes away. At level 1 the computed places are those of the particles; at level 2 those of
// particles on a sample that rests, pushed by the same hand, without scatter. The same ticks give the same picture. One
// thread; allocates.
class LivePicture {
 public:
  // `set` is valid and has level 1 or 2; `device` is that of its servo. An empty state: all is measured at the first
  // tick. Fails if the device cannot push the particles, and if the state is not one of theirs.
  static core::Result<std::unique_ptr<LivePicture>> create(const scene::SharedParticles& set,
                                                           const scene::SharedDevice& device, PictureState start = {});
  ~LivePicture();

  // Call in order of time, with the events of a tick before its sample. `truth`: the servo's newest pages.
  void add(const scene::TipEvent& event);
  void add(const scene::TipSample& sample, std::span<const scene::ParticlePage> truth);

  std::span<const scene::ParticlePage> shown() const { return state_.shown; }
  const PictureState& state() const { return state_; }
  const PictureNow& now() const { return now_; }  // picture after the newest sample

  const scene::PushSettings& settings() const { return settings_; }  // settings of follow_settings(), default: none

  bool looks() const { return look_ != nullptr; }
  std::optional<LookSquare> square() const;  // square of the current look
  bool lifted() const { return lifted_; }    // true: a look can begin

 private:
  friend void follow_settings(std::unique_ptr<LivePicture>&, const scene::SharedParticles&, const scene::SharedDevice&,
                              const scene::PushSettings&);
  struct Look;

  LivePicture(const scene::SharedParticles& set, double clear_z_m, std::vector<scene::ParticlePage> first,
              std::unique_ptr<haptics::FeltParticles> model, PictureState start);

  glm::dvec2 drift_m(std::int64_t time_ns) const;
  void measure_all(std::span<const scene::ParticlePage> truth);
  void show_computed(std::span<const scene::ParticlePage> truth);
  std::size_t nearest() const;
  bool holds(std::span<const scene::ParticlePage> truth, std::uint64_t digest) const;
  void begin_look();
  void scan(std::uint64_t digest, std::span<const scene::ParticlePage> truth);
  void read_line();
  void end_look();
  void figure();
  void follow_scan(const scene::ScanLead& scan, double elapsed_s);

  std::size_t count_;
  std::uint32_t level_;
  double clear_z_m_;
  physics::SampleDrift drift_;
  std::vector<double> reach_m_;                    // footprint radius of each particle
  std::vector<double> gentle_n_;                   // load up to which a scan climbs each particle
  std::vector<physics::Time> stale_after_;         // age at which each particle becomes stale
  std::vector<physics::PlaceDoubt> doubts_;        // doubt about the place of each particle
  std::vector<scene::ParticlePage> start_;         // places after all particles have been put back
  std::unique_ptr<haptics::FeltParticles> model_;  // model of the computed places; null at level 1
  PictureState state_;
  PictureNow now_;
  std::unique_ptr<Look> look_;
  scene::PushSettings settings_{};
  bool ordered_ = false;   // true: an event before the next sample ordered a look
  bool put_back_ = false;  // true: an event before the next sample put all particles back
  bool lifted_ = false;
  std::int64_t time_ns_ = 0;   // time of the newest tick; 0: none
  std::int64_t since_ns_ = 0;  // time at which the drift began
  glm::dvec2 tip_m_{0.0};
  double tip_z_m_ = 0;
};

// Makes `picture` that of a set with the settings of the next sample: none at level 0. At the same level its places
// stay; at another one all is measured at the next tick. `set` is valid, and the device can push it with the settings.
void follow_settings(std::unique_ptr<LivePicture>& picture, const scene::SharedParticles& set,
                     const scene::SharedDevice& device, const scene::PushSettings& settings);

// Result of a look, in one line for a log.
std::string text_of(const LookResult& look);

}  // namespace afm::servo
