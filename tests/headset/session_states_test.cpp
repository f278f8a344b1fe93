// SPDX-License-Identifier: Apache-2.0
#include "headset/session_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace afm::render {
namespace session_states_test {

using enum SessionEvent;
using ::testing::ElementsAre;

std::vector<SessionDuty> duties(SessionStates& states, const std::vector<SessionEvent>& events) {
  std::vector<SessionDuty> all;
  for (const SessionEvent event : events) {
    const SessionDuty duty = states.take(event);
    if (duty != SessionDuty::Nothing) all.push_back(duty);
  }
  return all;
}

const std::vector<SessionEvent> kPutOn{BecameIdle, BecameReady, BecameSynchronized, BecameVisible, BecameFocused};
const std::vector<SessionEvent> kTakenOff{BecameVisible, BecameSynchronized, BecameStopping, BecameIdle};

TEST(SessionStates, BeginAtReadyAndEndAtStopping) {
  SessionStates states;
  EXPECT_THAT(duties(states, kPutOn), ElementsAre(SessionDuty::Begin));
  EXPECT_EQ(states.phase(), SessionPhase::Running);
  EXPECT_TRUE(states.visible() && states.focused());
  EXPECT_THAT(duties(states, kTakenOff), ElementsAre(SessionDuty::End));
  EXPECT_EQ(states.phase(), SessionPhase::Idle);
  EXPECT_FALSE(states.visible() || states.focused());
}

TEST(SessionStates, FollowAHeadsetThatIsTakenOffAndPutOnThreeTimes) {
  SessionStates states;
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(duties(states, kPutOn), ElementsAre(SessionDuty::Begin));
    EXPECT_THAT(duties(states, kTakenOff), ElementsAre(SessionDuty::End));
  }
}

TEST(SessionStates, ASystemMenuTakesTheControllersButNotThePicture) {
  SessionStates states;
  duties(states, kPutOn);
  states.take(BecameVisible);
  EXPECT_TRUE(states.visible());
  EXPECT_FALSE(states.focused());
}

// Every way to the end, from every phase.
TEST(SessionStates, AreOverOnceAndForAllWhenTheSessionIs) {
  for (const SessionEvent end : {BecameExiting, BecameLossPending, WasLost}) {
    for (const auto& before : {std::vector<SessionEvent>{}, {BecameIdle}, kPutOn}) {
      SessionStates states;
      duties(states, before);
      EXPECT_EQ(states.take(end), SessionDuty::Destroy);
      EXPECT_EQ(states.phase(), SessionPhase::Over);
      EXPECT_FALSE(states.visible() || states.focused());
      EXPECT_THAT(duties(states, kPutOn), ElementsAre());
      EXPECT_EQ(states.phase(), SessionPhase::Over);
    }
  }
}

// Events that runtimes have sent although the specification has no such change.
TEST(SessionStates, NeitherBeginTwiceNorEndWhatDoesNotRun) {
  SessionStates states;
  EXPECT_THAT(duties(states, {BecameIdle, BecameStopping, BecameStopping}), ElementsAre());
  EXPECT_THAT(duties(states, {BecameReady, BecameReady, BecameReady}), ElementsAre(SessionDuty::Begin));
  EXPECT_THAT(duties(states, {BecameStopping, BecameStopping}), ElementsAre(SessionDuty::End));
  EXPECT_THAT(duties(states, {BecameVisible, BecameFocused}), ElementsAre());
  EXPECT_FALSE(states.visible());
}

TEST(SessionStates, BeginAndEndByTurnsWhateverComes) {
  std::mt19937 random(22);
  for (int run = 0; run < 200; ++run) {
    SessionStates states;
    SessionDuty last = SessionDuty::End;
    for (int i = 0; i < 50; ++i) {
      const auto event = static_cast<SessionEvent>(random() % (static_cast<unsigned>(BecameStopping) + 1));
      const SessionDuty duty = states.take(event);
      if (duty == SessionDuty::Nothing) continue;
      EXPECT_NE(duty, last);
      last = duty;
      EXPECT_EQ(states.phase() == SessionPhase::Running, duty == SessionDuty::Begin);
    }
  }
}

}  // namespace session_states_test
}  // namespace afm::render
