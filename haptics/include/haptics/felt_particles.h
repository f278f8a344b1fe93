// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/felt_drift.h"
#include "haptics/felt_groove.h"
#include "haptics/particle_push.h"
#include "haptics/particle_scale.h"
#include "haptics/stroke_history.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_meeting.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {
class SharedSegment;
struct ScanLead;
}  // namespace afm::scene

namespace afm::haptics {

class SweepingScan;

// Particles on the sample, as felt by the hand and as published: the one owner of their places.
//
// - Forces on the lever are those of physics/manipulation, with the lever as soft as a hand can bear (ParticleScale).
//   The sample under the tip is felt by the contact model's own law; of the physics' upward force only the particles'
//   part is felt: the force is the gradient of the stored energy less that of a lever on the bare sample.
// - The tip is among the particles, over them, or waits. It waits from a lift() until it has been over all of them, so
//   that no force comes without a motion of the hand. From then on forces depend only on the places of the particles
//   and on the hand, so that a session can begin there.
// - Not touching, the tip gets no force at all, and nothing is added to any other.
// - A groove along the plan of a push (FeltGroove) belongs to them; its force is added separately.
// - At level 2 the sample drifts below the tip: a tip that rests meets it as if it moved. Places of particles are those
//   on the sample, places of the tip those of the scanner, from which the sample drifts away.
// - A tip with a sphere on it is among the particles at any height. A lift() puts the sphere back where it was picked
//   up.
// - At level 1 and 2 a scan can look at them while the tip is off them, and sweep them (SweepingScan). That moves
//   particles and is a stroke, but gives no force.
//
// The constructor and resume() allocate; everything else may be called in a tick of the servo, by its thread.
class FeltParticles {
 public:
  static constexpr double kFeltN = 0.05;  // force on the hand below which a touch is no event

  // `particles` is valid (scene::validate) and has particles, `scale` is its particle_scale().
  FeltParticles(const scene::SharedParticles& particles, const ParticleScale& scale, const GrooveLimits& groove = {});
  ~FeltParticles();

  // Continues with the poses of these pages, of the same particles; a wait for a lift begins. A sphere that hung on
  // the tip is set down below it, or where there is room next to it. Throws std::invalid_argument unless the pages are
  // those of so many particles, and finite.
  void resume(std::span<const scene::ParticlePage> pages);

  // Continues for an object of the same particles with other settings, whose strokes can still be taken back; both wait
  // for a lift. At another level the sample is back where its drift began. Call only without force.
  void take_over(FeltParticles& before) noexcept;

  // Lets the sample drift up to this time; call once a tick, before step().
  void drift_to(std::int64_t now_ns) noexcept { drift_.follow(now_ns); }

  // Moves the tip: `tip_xy_m` in the scanner's frame, `z_m` that of the unbent lever above the sample, in metres of the
  // nanoworld.
  ParticlePush step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept;

  // Takes the tip off the particles, wherever it is.
  void lift() noexcept;

  // Takes the tip off the particles where no force is applied, and ends the groove.
  void drop() noexcept;

  FeltGroove& groove() noexcept { return groove_; }

  // Puts the particles back where they lay before the newest stroke that moved any; a wait for a lift begins. Call only
  // without force. False if the tip is among the particles, or if there is no such stroke since the constructor or
  // resume().
  bool take_back() noexcept;

  // Undoes all strokes: puts every particle where it lay in the constructor. This is also a stroke, which can be
  // undone. False if the tip is among the particles, or if nothing has moved. The drift starts again.
  bool put_back() noexcept;

  // True if a person can order a second look: the tip is off the particles, and the picture may differ from them.
  bool may_look() const noexcept { return level_ > 0 && tip_ != Tip::Among; }

  const ParticleScale& scale() const noexcept { return scale_; }
  double stored_j() const noexcept { return stored_j_; }                    // energy on the hand; 0 without a touch
  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }  // on the hand, an upper limit

  // The scan in effect: while one looks with a load that is not gentle, moves its tip, and adds an event for each
  // particle that it begins to push. Call once a tick, after step().
  void sweep(const scene::ScanLead& scan, double elapsed_s, ParticlePush& step) noexcept;

  // Ends a look that sweeps; the next begins with the next scan.
  void end_sweep() noexcept;

  // State after the newest step, without time and tick.
  scene::TipPush push() const noexcept;
  scene::PushSample sample() const noexcept;
  scene::LevelSample level() const noexcept;

  std::span<const scene::ParticlePage> pages() const noexcept { return pages_; }

  // Pages changed since the last published(), which follows once they are stored.
  std::span<const std::uint32_t> changed_pages() const noexcept { return changed_; }
  void published() noexcept { changed_.clear(); }

 private:
  enum class Tip { Waits, Over, Among };

  // Counts of the previous PushTick.
  struct Counts {
    std::uint64_t yields = 0, dragged = 0, torn = 0, lifted = 0, set_down = 0;
  };

  std::size_t move_poses(const physics::PushedParticles& by) noexcept;
  void put(std::uint32_t particle, const scene::ParticlePose& there) noexcept;
  void change(std::uint32_t particle, const scene::ParticlePose& now) noexcept;
  void account(const physics::PushTick& tick) noexcept;
  void spin(const physics::PushTick& tick, std::uint32_t particle, scene::ParticlePose& pose) noexcept;
  double borne_n(const physics::PushTick& tick) const noexcept;
  void note_events(const physics::PushTick& tick, const Counts& before, ParticlePush& step) noexcept;
  bool turns_flat(std::size_t particle) const noexcept;
  bool carries() const noexcept;
  void put_carried_back() noexcept;
  void lay_down(std::size_t particle) noexcept;
  scene::ParticlePose& pose(std::size_t particle) noexcept;

  ParticleScale scale_;
  physics::PushSetup setup_;  // setup with the springs that are felt
  physics::PushedParticles particles_;
  std::vector<double> other_threshold_n_;  // threshold of each species, by other_law()
  std::vector<scene::ParticlePage> pages_;
  std::vector<scene::ParticlePage> start_;  // pages at construction
  std::vector<std::uint32_t> changed_;
  StrokeHistory strokes_;
  FeltDrift drift_;
  physics::TipMeeting meeting_;
  FeltGroove groove_;
  std::uint64_t digest_ = 0;
  double stiffness_n_per_m_;
  std::uint32_t level_;
  Tip tip_ = Tip::Waits;
  glm::dvec3 over_m_{0.0};  // last position of the tip over the particles
  glm::dvec3 push_n_{0.0};  // force of the newest ParticlePush
  glm::dvec2 away_m_{0.0};  // vector from the tip to the sphere that it pushed last
  std::int32_t spun_ = scene::kNoParticle;
  double sample_j_ = 0;  // energy of the lever on the bare sample, and of particles that press each other
  double stored_j_ = 0;
  std::uint64_t accounts_ = 0;
  std::uint64_t yields_before_ = 0;  // counts with the settings used before, modulo 2^64
  std::uint64_t exhausted_before_ = 0;
  std::unique_ptr<SweepingScan> sweeping_;  // scan that sweeps particles; null at level 0
  bool sweep_ended_ = false;                // true: the current scan sweeps no more
};

// Scale of particles, valid ones, with settings that they allow (scene::refusal). Fails where particle_scale() does,
// and where the tip would be free only above the device.
core::Result<ParticleScale> adjusted_scale(const scene::SharedParticles& particles, const scene::PushSettings& settings,
                                           const DeviceSpec& device);

// The particles on the sample, replaceable by the same with other settings while the servo runs. Used by two threads,
// as ModelSwap: the servo's, which neither waits, allocates nor frees, and the builder's.
//
//   builder: build() --offered--> servo: changes(), change() --retired--> freed by the builder's next build()
class ParticleSwap {
 public:
  // Continues where a predecessor in this segment left the particles, which are valid; `scale` is their
  // particle_scale(). Without particles, empty: used() is null, and nothing is ever built.
  static std::unique_ptr<ParticleSwap> create(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                                              const ParticleScale& scale, const DeviceSpec& device);

  ParticleSwap();
  ParticleSwap(const ParticleSwap&) = delete;
  ParticleSwap& operator=(const ParticleSwap&) = delete;
  ~ParticleSwap();

  // ---- servo's thread ----

  FeltParticles* used() const noexcept;  // particles in use; null: none

  // Settings in use; the tool is Push or Grip, or OfSet without particles.
  const scene::PushSettings& settings() const noexcept { return settings_; }

  // True if these are not in use, and particles with them are ready.
  bool changes(const scene::PushSettings& wanted) noexcept;

  // Uses them: all particles stay where they are, and their strokes can still be taken back. Only without force, and if
  // changes() says so.
  void change() noexcept;

  // ---- builder's thread ----

  // Builds particles with these settings unless they are those of the last call, and frees the retired ones. Settings
  // that set, lever or device do not allow are logged and left.
  void build(const scene::PushSettings& wanted);

 private:
  struct Built;

  // The settings with OfSet replaced by Push or Grip.
  scene::PushSettings in_full(const scene::PushSettings& wanted) const noexcept;

  std::unique_ptr<const scene::SharedParticles> particles_;  // particles of the set; null: none
  DeviceSpec device_{};
  scene::PushTool own_ = scene::PushTool::OfSet;
  scene::PushSettings settings_{};
  std::unique_ptr<Built> used_, ready_;  // particles in use, particles ready to replace them; null: none
  std::atomic<Built*> offered_{nullptr};
  std::atomic<Built*> retired_{nullptr};
  scene::PushSettings built_{};  // newest complete settings, for the builder's thread
};

}  // namespace afm::haptics
