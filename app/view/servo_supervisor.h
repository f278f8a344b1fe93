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
class LivePicture;
class ServoClient;
class SessionRecorder;
class TipAudience;
class TipStream;
}  // namespace afm::servo

namespace afm::app {

// Manages the servo of a live window: starts it, follows its state, records sessions, and replaces it if it dies. Main
// thread only.
class ServoSupervisor {
 public:
  using Starter = std::function<core::Result<std::unique_ptr<servo::ServoClient>>()>;

  // Called after each start of a servo, with the material that was selected at the previous servo.
  using Started = std::function<void(servo::ServoClient& servo, std::optional<std::size_t> chosen_before)>;

  // `record_folder`: for session files; empty: none. `audience` receives every sample and event that update() reads,
  // and must outlive the object.
  ServoSupervisor(Starter starter, Started started, std::size_t materials, std::string record_folder,
                  servo::TipAudience& audience);
  ~ServoSupervisor();

  // Starts the first servo, or another after a final failure. Failed if it cannot be started or the folder is not
  // writable.
  core::Result<void> start();

  // Call once a frame: reads all new samples and events. Replaces a servo that has died; the new one has no force until
  // the hand lifts and Turn-On is pressed. If servos die repeatedly or the device cannot be opened, error() is set
  // until a person restarts the servo.
  void update(std::int64_t now_ns);

  // Calls `hears` with every sample, in order, before a session stores it.
  void hear(std::function<void(const scene::TipSample&)> hears) { hears_.push_back(std::move(hears)); }

  // Calls `hears` with every event, before the sample of its tick.
  void hear_events(std::function<void(const scene::TipEvent&)> hears) { hears_events_.push_back(std::move(hears)); }

  // Calls `sources` for the sources of what is felt when a session begins (curves::felt_sources()).
  void cite(std::function<std::string(std::size_t material, const scene::SharedContact& felt)> sources) {
    sources_ = std::move(sources);
  }

  // Adds a frame of the wall to the current session.
  void record(const servo::WallFrame& frame);
  bool recording() const { return folder_.has_value(); }

  // Saves the current session, logs the servo's timing, and releases the hand.
  void finish();

  // The current link. A link to a servo that has ended keeps its last state.
  servo::ServoClient& link() { return *link_; }
  const servo::ServoClient& link() const { return *link_; }
  const std::optional<core::Error>& error() const { return error_; }
  bool running() const { return !error_; }

  // Picture of the particles at level 1 and 2, once the servo's first sample has come; otherwise null.
  const servo::LivePicture* picture() const { return picture_.get(); }
  std::optional<std::size_t> material() const;  // index of the material under the tip

  const exhibit::CycleHistory& cycles() const { return cycles_; }
  const exhibit::FrictionHistory& friction() const { return friction_; }
  const exhibit::JumpCues& cues() const { return cues_; }
  // File of the whole felt map, for the sessions.
  void set_force_map(std::optional<servo::RecordedForceMap> map);

  void forget_cycles() {
    cycles_ = exhibit::CycleHistory(materials_);
    friction_ = {};
  }

 private:
  core::Result<void> launch(const char* message);
  void replace(const core::Error& error, std::int64_t now_ns);
  void follow_picture(const scene::TipSample& sample);
  void keep_finished();
  void keep_part(std::int64_t now_ns);
  void stop_recording(const core::Error& error);
  std::vector<servo::EarlierCurve> curves_on_wall() const;
  void describe_session(const scene::TipSample& first);
  void log_state();
  void log_timing() const;

  Starter starter_;
  std::vector<std::function<void(const scene::TipSample&)>> hears_;
  std::vector<std::function<void(const scene::TipEvent&)>> hears_events_;
  std::function<std::string(std::size_t, const scene::SharedContact&)> sources_;
  Started started_;
  std::size_t materials_;
  std::string record_folder_;
  servo::TipAudience& audience_;
  std::unique_ptr<servo::ServoClient> link_;
  std::optional<core::Error> error_;      // set once the servo has ended for good
  std::deque<std::int64_t> restarts_ns_;  // times of restarts within the last minute
  std::unique_ptr<servo::TipStream> stream_;
  std::unique_ptr<servo::LivePicture> picture_;
  exhibit::CycleHistory cycles_;
  exhibit::FrictionHistory friction_;
  std::optional<servo::SessionFolder> folder_;
  std::unique_ptr<servo::SessionRecorder> recorder_;
  std::int64_t kept_ns_ = 0;  // time of the newest partial save of the session
  exhibit::JumpCues cues_;
  scene::ServoState logged_state_ = scene::ServoState::Disarmed;
};

}  // namespace afm::app
