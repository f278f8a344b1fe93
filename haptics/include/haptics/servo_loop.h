// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/result.h"
#include "haptics/device.h"
#include "haptics/edit_builder.h"
#include "haptics/model_swap.h"
#include "haptics/position_check.h"
#include "haptics/safety.h"
#include "haptics/sample_axes.h"
#include "haptics/scan_guide.h"
#include "haptics/servo_settings.h"
#include "scene/shared/shared_segment.h"

namespace afm::core {
class MonotonicClock;
}

namespace afm::haptics {

class FeltMarks;
class FeltParticles;
class ParticleSwap;
struct RealtimeGrant;

enum class ServoExit { RendererLeft, RendererDied, Stopped };

// The servo: once per period it turns the hand's position into a force, and records both in the shared segment. It
// reads the renderer's data but never waits for the renderer.
//
// tick() and run() belong to one thread; they do not allocate, lock, log, throw or make a system call except to read
// the clock and, in run(), to sleep. renderer_...() and stop() may be called from any thread. Edits take effect only
// while an EditThread serves edits().
class ServoLoop {
 public:
  // Builds the force law and the scaling of every material in advance. Fails on materials without a force law, on a
  // device that cannot render them, and on settings out of range. The segment and the device must outlive the loop.
  static core::Result<std::unique_ptr<ServoLoop>> create(scene::SharedSegment& segment, HapticDevice& device,
                                                         const ServoSettings& settings);

  ~ServoLoop();

  // Runs one period. `now_ns` increases from tick to tick; `wake_us` is the lateness of the tick and is only recorded.
  void tick(std::int64_t now_ns, std::uint32_t wake_us) noexcept;

  // Ticks at absolute deadlines until the renderer is gone or stop() was called, and the hand is released. A missed
  // deadline is skipped and counted, never made up.
  ServoExit run(const core::MonotonicClock& clock) noexcept;

  // Both functions release the hand. After renderer_lost() the loop continues without a renderer, until
  // renderer_returned() or renderer_died(), which ends it.
  void renderer_lost() noexcept { presence_.store(Presence::Lost, std::memory_order_relaxed); }
  void renderer_died() noexcept { presence_.store(Presence::Died, std::memory_order_relaxed); }

  // Call when another renderer writes the same segment.
  void renderer_returned() noexcept { presence_.store(Presence::Here, std::memory_order_relaxed); }

  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }

  // Used by one thread other than the servo's (EditThread), during the lifetime of the loop.
  EditBuilder& edits() noexcept { return edits_; }

  // Stores the result of enter_realtime(), and of the driver's own thread, for wall and report. Call before run().
  void note_grant(const RealtimeGrant& grant) noexcept;

  std::int64_t period_ns() const noexcept { return period_ns_; }
  const scene::ServoTiming& timing() const noexcept { return timing_; }

 private:
  ServoLoop(scene::SharedSegment& segment, const scene::SharedModel& model, scene::Topography topography,
            HapticDevice& device, const ServoSettings& settings, std::vector<std::unique_ptr<ContactModel>> models,
            const CommonScale& common);

  // Force requested by sample and scan in this tick.
  struct Wanted {
    glm::dvec3 force_n{0.0};  // force in the device frame
    double hand_height_m = 0;
    PassivityObserver::Law energy;
    bool led = false;
    double damping_n_s_per_m = 0;
  };

  // Newest requests of the renderer.
  struct Heard {
    std::optional<scene::RendererHeartbeat> heartbeat;
    std::int64_t seen_ns = 0;
    bool leaving = false;
    bool take_back = false;  // true: undoing a push was ordered in this tick
    bool put_back = false;   // true: resetting all particles was ordered in this tick
    bool look = false;       // true: a look at the particles was ordered in this tick
  };
  struct Hand {
    glm::dvec3 position_m;
    glm::dvec3 from_contact_m{0.0};
    bool turn_on = false;
    bool healthy = true;  // false: the device failed, and the position is the last known one
  };

  void read_shared_blocks(std::int64_t now_ns) noexcept;
  Wanted meet_sample(double elapsed_s) noexcept;
  std::optional<ScanGuide::Target> guide_target() const noexcept;
  void change_model() noexcept;
  void select_material(std::size_t material, scene::ScaleMode mode) noexcept;
  RendererLink renderer_link(std::int64_t now_ns) const noexcept;
  FeltParticles* particles() const noexcept;  // particles in use; null: none
  void put_particles(double elapsed_s) noexcept;
  void put_marks() noexcept;
  void publish(std::int64_t now_ns, std::uint32_t wake_us) noexcept;
  void publish_events(std::int64_t now_ns) noexcept;
  void publish_particles() noexcept;
  void publish_marks() noexcept;
  scene::PushSample push_sample() const noexcept;
  bool finished() const noexcept;

  scene::ServoSide shared_;
  HapticDevice& device_;
  const DeviceSpec spec_;  // limits of the device, reduced to those of the operator
  ServoSettings settings_;
  std::int64_t period_ns_;
  std::uint32_t sample_node_;
  std::unique_ptr<ParticleSwap> swap_;  // particles and their replacement; never null, empty without particles
  std::unique_ptr<FeltMarks> marks_;    // sample on which the tip leaves marks; null: none
  ModelSwap exchange_;
  EditBuilder edits_;
  SafetyGovernor governor_;

  ContactModel* model_ = nullptr;  // model of the material under the tip, null before the first selection
  scene::Selection chosen_;        // newest selection, possibly not in effect yet
  scene::ScanLead newest_scan_;
  scene::ScanLead scan_;  // scan in effect in this tick
  ScanGuide guide_;
  SampleAxes sample_;
  bool sample_moved_ = false;  // true: the sample moved in this tick
  PositionCheck position_check_;
  Hand hand_;
  bool changing_ = false;  // true: force removed for a change of material, scale or parameters
  RendererLink renderer_ = RendererLink::Absent;
  Touch touch_;  // touch in this tick
  scene::TipState state_;
  std::int64_t previous_ns_ = 0;

  Heard heard_;
  std::uint32_t refused_transforms_ = 0;
  enum class Presence { Here, Lost, Died };
  std::atomic<Presence> presence_{Presence::Here};
  std::atomic<bool> stop_{false};

  scene::ServoTiming timing_;
};

}  // namespace afm::haptics
