// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_message.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace haply_message_test {

using afm::haptics::haply_force_message;
using afm::haptics::parse_haply_state;

const std::string kState =
    R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.01,"y":-0.12,"z":0.15}}}],)"
    R"("wireless_verse_grip":[{"device_id":"61548","state":{"buttons":{"a":true,"b":false,"c":false}}}]})";

TEST(HaplyMessage, IsTurnedIntoTheFrameOfTheRoom) {
  const auto state = parse_haply_state(kState);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->device_id, "049D");
  EXPECT_EQ(state->position_m, glm::dvec3(0.01, 0.15, 0.12));  // away is -z, up is +y
  EXPECT_TRUE(state->button);
}

TEST(HaplyMessage, SendsAForceInTheFrameOfTheDevice) {
  const auto message = nlohmann::json::parse(haply_force_message("049D", {0.1, -1.5, 0.2}));
  const auto& device = message.at("inverse3").at(0);
  EXPECT_EQ(device.at("device_id"), "049D");
  EXPECT_EQ(device.at("commands").at("set_cursor_force").at("values"),
            (nlohmann::json{{"x", 0.1}, {"y", -0.2}, {"z", -1.5}}));
}

TEST(HaplyMessage, TakesTheButtonOfAGripOnAWireToo) {
  const auto state = parse_haply_state(
      R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":0,"y":0,"z":0}}}],"verse_grip":[{"state":{"button":true}}]})");
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->button);
}

TEST(HaplyMessage, BelievesNoOtherBytes) {
  for (const char* wrong : {
           "",
           "null",
           "[]",
           "{}",
           R"({"inverse3":[]})",
           R"({"inverse3":{"device_id":"1"}})",
           R"({"inverse3":[{"device_id":7,"state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})",
           R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":0,"y":0}}}]})",
           R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":0,"y":"0","z":0}}}]})",
           R"({"inverse3":[{"device_id":"1","state":{"cursor_position":{"x":1e300,"y":0,"z":0}}}]})",
       }) {
    EXPECT_FALSE(parse_haply_state(wrong)) << wrong;
  }
  // cut short, and with a byte changed: refused or understood, never a crash
  std::mt19937 random(3);
  for (std::size_t length = 0; length < kState.size(); ++length)
    EXPECT_FALSE(parse_haply_state(kState.substr(0, length)));
  for (int i = 0; i < 20'000; ++i) {
    std::string changed = kState;
    changed[random() % changed.size()] = static_cast<char>(random());
    parse_haply_state(changed);
  }
  parse_haply_state(std::string(60'000, '['));
}

}  // namespace haply_message_test
