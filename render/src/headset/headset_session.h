// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "headset/controller_actions.h"
#include "headset/eye_swapchains.h"
#include "headset/floor_space.h"
#include "headset/frame_wait.h"
#include "headset/panel_quads.h"
#include "headset/session_handle.h"
#include "headset/session_states.h"

namespace afm::render {

// One session with the runtime, from its first state to its last. Every call throws OpenXrFailure if the session or the
// runtime is lost; the session can then only be destroyed.
class HeadsetSession {
 public:
  HeadsetSession(HeadsetRuntimeParts& runtime, const Device& device, const EyeTargets& eyes, const Panels& panels,
                 const scene::HeadPose& room_from_floor, std::vector<std::string>& messages);
  HeadsetSession(const HeadsetSession&) = delete;
  HeadsetSession& operator=(const HeadsetSession&) = delete;
  ~HeadsetSession();

  Headset::Turn next_turn(const core::Clock& clock, const std::function<void()>& while_waiting);
  std::optional<std::array<HeadsetEye, 2>> locate_eyes(const std::function<void()>& while_waiting);
  bool show();
  std::size_t most_panels() const { return quads_.most(); }

  // True once the session has ended and no wait is running: it can be destroyed without blocking.
  bool over() const { return states_.phase() == SessionPhase::Over && !wait_->under_way(); }
  void lost() { states_.take(SessionEvent::WasLost); }
  const HeadsetController& controller() const { return controller_; }
  void pulse();

 private:
  // Resources for copying one frame.
  struct Copying {
    vk::raii::CommandBuffer commands{nullptr};
    vk::raii::Fence done{nullptr};
  };

  HeadsetFormat choose_format() const;
  EyeSwapchains::Depth takes_depth(const HeadsetRuntimeParts& runtime) const;
  void follow_events();
  void take(const XrEventDataBuffer& event);
  void follow_state(XrSessionState state);
  std::optional<FrameWait::Answer> wait_for_frame(const core::Clock& clock, const std::function<void()>& while_waiting);
  void say_frozen(std::int64_t since_ns);
  void begin_frame(const FrameWait::Answer& answer);
  enum class Picture { None, Eyes };
  void end_frame(Picture picture);
  void begin_session();
  void end_session();
  bool get_ready_to_copy(const std::function<void()>& while_waiting);
  void submit_copies();

  const OpenXrInstance& calls_;
  const Device& device_;
  const EyeTargets& eyes_;
  const Panels& panels_;
  scene::HeadPose room_from_floor_;
  std::vector<std::string>& messages_;
  SessionStates states_;
  SessionHandle session_;
  FloorSpace floor_;
  ControllerActions actions_;
  EyeSwapchains pictures_;
  PanelQuads quads_;
  vk::raii::CommandPool pool_;
  std::array<Copying, 2> copying_;
  std::size_t copied_ = 0;         // number of frames copied
  std::optional<FrameWait> wait_;  // always set after construction
  std::int64_t wait_began_ns_ = 0;
  std::optional<XrFrameState> frame_;  // frame that has begun and must be ended
  std::array<XrView, 2> views_{};      // eyes as last located
  bool located_ = false;
  bool ending_ = false;  // true: session to end after its last frame, at the runtime's request
  bool said_floor_ = false, said_frozen_ = false;
  HeadsetController controller_;
};

}  // namespace afm::render
