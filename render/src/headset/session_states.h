// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::render {

// The life of a session with a headset's runtime, as OpenXR's specification has it, without a call of it.
enum class SessionPhase {
  Idle,     // begun by nobody: the headset is not worn, or the runtime is not ready
  Running,  // frames are waited for, begun and ended
  Over      // destroyed, with its instance; another is looked for
};

enum class SessionEvent {
  // the runtime's states
  BecameIdle,
  BecameReady,
  BecameSynchronized,
  BecameVisible,
  BecameFocused,
  BecameStopping,
  BecameLossPending,
  BecameExiting,
  // a call says that session, instance or runtime are gone
  WasLost
};

// What has to be done about an event.
enum class SessionDuty { Nothing, Begin, End, Destroy };

// Phase and visibility of a session. Pure; takes any event at any time, since runtimes have sent all of them.
class SessionStates {
 public:
  SessionDuty take(SessionEvent event);

  SessionPhase phase() const { return phase_; }
  bool visible() const { return visible_; }  // the wearer sees what is shown
  bool focused() const { return focused_; }  // and its controllers are ours

 private:
  SessionPhase phase_ = SessionPhase::Idle;
  bool visible_ = false, focused_ = false;
};

}  // namespace afm::render
