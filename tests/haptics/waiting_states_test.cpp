// SPDX-License-Identifier: Apache-2.0
#include "devices/waiting_states.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <optional>
#include <queue>
#include <string>

namespace waiting_states_test {

using afm::haptics::WaitingStates;

std::string state_at(double x_m) {
  return fmt::format(
      R"({{"inverse3":[{{"device_id":"1","state":{{"cursor_position":{{"x":{},"y":-0.12,"z":0.15}}}}}}]}})", x_m);
}

// A connection with `waiting` messages; a take is late once it has received `bearable` of them.
struct Connection {
  std::queue<std::string> waiting;
  int bearable = 3;

  WaitingStates::Taken take(WaitingStates& states) {
    int received = 0;
    return states.take(
        [&](bool first) -> std::optional<std::string> {
          EXPECT_EQ(first, received == 0);
          if (waiting.empty()) return std::nullopt;
          ++received;
          auto message = waiting.front();
          waiting.pop();
          return message;
        },
        [&] { return received >= bearable; });
  }
};

TEST(WaitingStates, GiveTheNewestOfThoseThatWait) {
  WaitingStates states;
  Connection connection{.waiting = {}, .bearable = 3};
  connection.waiting.push(state_at(0.01));
  connection.waiting.push(state_at(0.02));
  const auto taken = connection.take(states);
  EXPECT_TRUE(taken.asked);
  ASSERT_TRUE(taken.newest);
  EXPECT_DOUBLE_EQ(taken.newest->position_m.x, 0.02);
}

TEST(WaitingStates, GiveNothingWhereNothingWaits) {
  WaitingStates states;
  Connection connection;
  const auto taken = connection.take(states);
  EXPECT_FALSE(taken.asked);
  EXPECT_FALSE(taken.newest);
}

TEST(WaitingStates, GiveNoPlaceWhileMoreWaitBehindIt) {
  WaitingStates states;
  Connection connection{.waiting = {}, .bearable = 2};
  for (int i = 1; i <= 6; ++i) connection.waiting.push(state_at(0.01 * i));
  for (int i = 0; i < 2; ++i) {
    const auto taken = connection.take(states);
    EXPECT_TRUE(taken.asked) << "the service waits for a force all the same";
    EXPECT_FALSE(taken.newest) << i;
  }
  const auto taken = connection.take(states);
  EXPECT_FALSE(taken.asked);
  ASSERT_TRUE(taken.newest) << "nothing came after it";
  EXPECT_DOUBLE_EQ(taken.newest->position_m.x, 0.06);
  EXPECT_FALSE(connection.take(states).newest) << "given once";
}

// A service that waits for a force sends nothing more: a slow thread must notice that no message follows.
TEST(WaitingStates, GiveAStateThatCameLateAndAlone) {
  WaitingStates states;
  Connection connection{.waiting = {}, .bearable = 1};
  connection.waiting.push(state_at(0.04));
  const auto taken = connection.take(states);
  EXPECT_TRUE(taken.asked);
  ASSERT_TRUE(taken.newest);
  EXPECT_DOUBLE_EQ(taken.newest->position_m.x, 0.04);
}

TEST(WaitingStates, KeepTheLastStateBeforeBytesThatAreNone) {
  WaitingStates states;
  Connection connection;
  connection.waiting.push(state_at(0.03));
  connection.waiting.push("hello");
  const auto taken = connection.take(states);
  ASSERT_TRUE(taken.newest);
  EXPECT_DOUBLE_EQ(taken.newest->position_m.x, 0.03);
}

}  // namespace waiting_states_test
