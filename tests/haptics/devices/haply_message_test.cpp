// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_message.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace haply_message_test {

using afm::haptics::haply_force_message;
using afm::haptics::HaplyName;
using afm::haptics::parse_haply_inventory;
using afm::haptics::parse_haply_state;

const std::string kState =
    R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.01,"y":-0.12,"z":0.15}}}],)"
    R"("wireless_verse_grip":[{"device_id":"61548","state":{"buttons":{"a":true,"b":false,"c":false}}}]})";

TEST(HaplyMessage, IsTurnedIntoTheFrameOfTheRoom) {
  const auto state = parse_haply_state(kState);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->device, (HaplyName{"inverse3", "049D"}));
  EXPECT_EQ(state->position_m, glm::dvec3(0.01, 0.15, 0.12));  // away is -z, up is +y
  EXPECT_TRUE(state->button);
}

TEST(HaplyMessage, SendsAForceInTheFrameOfTheDevice) {
  const auto message = nlohmann::json::parse(haply_force_message({"inverse3", "049D"}, {0.1, -1.5, 0.2}));
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

// Message as documented for version 3.5 of the service, with an unknown future family.
const std::string kFirst =
    R"({"session_id":7,"inverse3":[)"
    R"({"device_id":"049D","config":{"type":"inverse3"},"state":{"cursor_position":{"x":0.01,"y":-0.12,"z":0.15}}},)"
    R"({"device_id":"0012","config":{"type":"minverse"},"state":{"cursor_position":{"x":0.02,"y":-0.12,"z":0.15}}}],)"
    R"("minverse":[{"device_id":"0013","state":{"cursor_position":{"x":0.03,"y":-0.12,"z":0.15}}}],)"
    R"("hexaverse":[{"device_id":"9","state":{"cursor_position":{"x":0.04,"y":0,"z":0}}}],)"
    R"("verse_grip":[{"device_id":"1","state":{"button":true}},{"device_id":"2","state":{"button":false}}],)"
    R"("custom_verse_grip":[{"device_id":"3","config":{"type":"ruko"},"state":{"buttons":{"a":false}}}]})";

TEST(HaplyMessage, IsReadForEveryDeviceThatItLists) {
  const auto inventory = parse_haply_inventory(kFirst);
  EXPECT_EQ(text_of(inventory),
            "inverse3 049D, minverse 0012, minverse 0013; grips ruko 3, verse_grip 1, verse_grip 2; unknown "
            "hexaverse 9");
  EXPECT_EQ(text_of(parse_haply_inventory(R"({"inverse3":[]})")), "no device");
  EXPECT_EQ(text_of(parse_haply_inventory("[1, 2")), "no device");
}

TEST(HaplyMessage, GivesTheArmThatIsWantedAndNoOther) {
  const auto first = parse_haply_state(kFirst);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->device.id, "049D");
  EXPECT_TRUE(first->button);  // one of the grips'
  const auto second = parse_haply_state(kFirst, "0012");
  ASSERT_TRUE(second);
  EXPECT_EQ(second->device, (HaplyName{"inverse3", "0012"}));
  EXPECT_EQ(second->position_m.x, 0.02);
  const auto third = parse_haply_state(kFirst, "0013");
  ASSERT_TRUE(third);
  EXPECT_EQ(third->device, (HaplyName{"minverse", "0013"}));
  // a force goes into the list that the arm came from
  const auto force = nlohmann::json::parse(haply_force_message(third->device, {0, -1, 0}));
  EXPECT_EQ(force.at("minverse").at(0).at("device_id"), "0013");
  for (const char* none : {"9", "0014", "1"}) EXPECT_FALSE(parse_haply_state(kFirst, none)) << none;
}

TEST(HaplyMessage, TakesTheFirstArmThatKnowsItsPlace) {
  const auto state = parse_haply_state(
      R"({"inverse3":[{"device_id":"1"}],"inverse3x":[{"device_id":"2","state":{"cursor_position":{"x":0,"y":0,"z":0}}}]})");
  ASSERT_TRUE(state);
  EXPECT_EQ(state->device, (HaplyName{"inverse3x", "2"}));
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
    parse_haply_inventory(changed);
  }
  parse_haply_state(std::string(60'000, '['));
}

}  // namespace haply_message_test
