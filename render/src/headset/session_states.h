// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::render {

// Life cycle of a session with a headset's runtime, as in the OpenXR specification, without any OpenXR call.
enum class SessionPhase {
  Idle,     // not begun: headset not worn, or runtime not ready
  Running,  // waiting for, beginning and ending frames
  Over      // to be destroyed with its instance; another headset is looked for
};

enum class SessionEvent {
  // states reported by the runtime
  BecameIdle,
  BecameReady,
  BecameSynchronized,
  BecameVisible,
  BecameFocused,
  BecameStopping,
  BecameLossPending,
  BecameExiting,
  // a call reported that the session, instance or runtime is lost
  WasLost
};

// Action required by an event.
enum class SessionDuty { Nothing, Begin, End, Destroy };

// Phase and visibility of a session. Pure; accepts any event at any time, since runtimes have sent all of them.
class SessionStates {
 public:
  SessionDuty take(SessionEvent event);

  SessionPhase phase() const { return phase_; }
  bool visible() const { return visible_; }  // true: our pictures are visible to the wearer
  bool focused() const { return focused_; }  // true: our program receives the wearer's input

 private:
  SessionPhase phase_ = SessionPhase::Idle;
  bool visible_ = false, focused_ = false;
};

}  // namespace afm::render
