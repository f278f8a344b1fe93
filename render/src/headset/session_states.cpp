// SPDX-License-Identifier: Apache-2.0
#include "headset/session_states.h"

#include <array>
#include <cstddef>

namespace afm::render {
namespace {

struct SessionRow {
  SessionEvent event;
  std::array<SessionPhase, 2> next;  // next phase from Idle and from Running
  std::array<SessionDuty, 2> duty;
  bool visible;
  bool focused;
};

constexpr std::array<SessionRow, 9> session_rows() {
  using enum SessionEvent;
  using enum SessionPhase;
  using enum SessionDuty;
  return {{
      {BecameIdle, {Idle, Running}, {Nothing, Nothing}, false, false},
      // a second BecameReady while running is a runtime error; beginning again would be refused
      {BecameReady, {Running, Running}, {Begin, Nothing}, false, false},
      {BecameSynchronized, {Idle, Running}, {Nothing, Nothing}, false, false},
      {BecameVisible, {Idle, Running}, {Nothing, Nothing}, true, false},
      {BecameFocused, {Idle, Running}, {Nothing, Nothing}, true, true},
      {BecameStopping, {Idle, Idle}, {Nothing, End}, false, false},
      {BecameLossPending, {Over, Over}, {Destroy, Destroy}, false, false},
      {BecameExiting, {Over, Over}, {Destroy, Destroy}, false, false},
      {WasLost, {Over, Over}, {Destroy, Destroy}, false, false},
  }};
}
constexpr std::array kSessionRows = session_rows();

constexpr bool in_order() {
  for (std::size_t i = 0; i < kSessionRows.size(); ++i) {
    if (kSessionRows[i].event != static_cast<SessionEvent>(i)) return false;
  }
  return kSessionRows.size() == static_cast<std::size_t>(SessionEvent::WasLost) + 1;
}
static_assert(in_order(), "one row for each event, in their order");

}  // namespace

SessionDuty SessionStates::take(SessionEvent event) {
  if (phase_ == SessionPhase::Over) return SessionDuty::Nothing;
  const SessionRow& row = kSessionRows[static_cast<std::size_t>(event)];
  const auto from = static_cast<std::size_t>(phase_);
  phase_ = row.next[from];
  visible_ = row.visible && phase_ == SessionPhase::Running;
  focused_ = row.focused && phase_ == SessionPhase::Running;
  return row.duty[from];
}

}  // namespace afm::render
