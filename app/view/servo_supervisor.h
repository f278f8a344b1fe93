// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "exhibit/friction/friction_history.h"
#include "exhibit/state/cycle_history.h"
#include "exhibit/state/jump_cue.h"
#include "servo/session_folder.h"

namespace afm::servo {
class ServoClient;
class SessionRecorder;
class TipAudience;
class TipStream;
}  // namespace afm::servo

namespace afm::app {

// Manages the servo of a live window: starts it, follows its state, records sessions, and replaces it if it dies. The
// main thread alone.
class ServoSupervisor {
 public:
  using Starter = std::function<core::Result<std::unique_ptr<servo::ServoClient>>()>;

  // Called with every servo that has been started, and the material that was under the tip of the one before it.
  using Started = std::function<void(servo::ServoClient& servo, std::optional<std::size_t> felt_before)>;

  // `record_folder`: for the sessions of what is felt; empty: none is kept. `audience` hears of every sample and event
  // that update() receives, and must outlive this.
  ServoSupervisor(Starter starter, Started started, std::size_t materials, std::string record_folder,
                  servo::TipAudience& audience);
  ~ServoSupervisor();

  // The first servo, or another after one has ended for good. Failed if it cannot be started or nothing can be kept in
  // the folder.
  core::Result<void> start();

  // Once a frame: everything new. One that has died is replaced, without force until the hand lifts and Turn-On is
  // pressed; one that dies again and again, or that cannot have its device, needs a person: then it has an error().
  void update(std::int64_t now_ns);

  // Each is called with every sample, in their order, before a session keeps it.
  void hear(std::function<void(const scene::TipSample&)> hears) { hears_.push_back(std::move(hears)); }

  // The same with every jump.
  void hear_jumps(std::function<void(const scene::TipEvent&)> hears) { hears_jumps_.push_back(std::move(hears)); }

  // Adds a frame of the wall to the current session.
  void record(const servo::WallFrame& frame);
  bool recording() const { return folder_.has_value(); }

  // Saves the current session, logs the servo's timing, and releases the hand.
  void finish();

  // The link to one that has ended still has its last state.
  servo::ServoClient& link() { return *link_; }
  const servo::ServoClient& link() const { return *link_; }
  const std::optional<core::Error>& error() const { return error_; }
  bool running() const { return !error_; }
  std::optional<std::size_t> material() const;  // the one under the tip

  const exhibit::CycleHistory& cycles() const { return cycles_; }
  const exhibit::FrictionHistory& friction() const { return friction_; }
  const exhibit::JumpCues& cues() const { return cues_; }
  void forget_cycles() {
    cycles_ = exhibit::CycleHistory(materials_);
    friction_ = {};
  }

 private:
  core::Result<void> launch(const char* message);
  void replace(const core::Error& error, std::int64_t now_ns);
  void keep_finished();
  void keep_part(std::int64_t now_ns);
  void stop_recording(const core::Error& error);
  std::vector<servo::EarlierCurve> curves_on_wall() const;
  void log_state();
  void log_timing() const;

  Starter starter_;
  std::vector<std::function<void(const scene::TipSample&)>> hears_;
  std::vector<std::function<void(const scene::TipEvent&)>> hears_jumps_;
  Started started_;
  std::size_t materials_;
  std::string record_folder_;
  servo::TipAudience& audience_;
  std::unique_ptr<servo::ServoClient> link_;
  std::optional<core::Error> error_;      // the servo has ended
  std::deque<std::int64_t> restarts_ns_;  // of servos that died, within the last minute
  std::unique_ptr<servo::TipStream> stream_;
  exhibit::CycleHistory cycles_;
  exhibit::FrictionHistory friction_;
  std::optional<servo::SessionFolder> folder_;
  std::unique_ptr<servo::SessionRecorder> recorder_;
  std::int64_t kept_ns_ = 0;  // when a part of the session was kept last
  exhibit::JumpCues cues_;
  scene::ServoState logged_state_ = scene::ServoState::Disarmed;
};

}  // namespace afm::app
