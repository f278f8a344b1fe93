// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Messages of Haply's Inverse Service, version 3, in TouchAFM's frame: right +x, up +y, towards the user +z. The
// service's own frame is right +x, away +y, up +z. A message has one list for each family of devices; the service's
// documents (3.5) name inverse3, inverse3x and minverse as one family of arms, and three of grips.
namespace afm::haptics {

// Device of a message: the name of its list, and its id there.
struct HaplyName {
  std::string family;
  std::string id;

  bool operator==(const HaplyName&) const = default;
};

struct HaplyState {
  HaplyName device;
  glm::dvec3 position_m{0};  // position from the centre of the arm's mounting plate
  bool button = false;       // true: the button of any grip is pressed, wireless or not
};

// Devices that a message lists. Here `family` is the type named by the device itself, in the first message of a
// connection only, or else its list.
struct HaplyInventory {
  std::vector<HaplyName> arms;  // arms that can be driven, in order
  std::vector<HaplyName> grips;
  std::vector<HaplyName> unknown;  // devices in lists without a name here
};

// State of the arm with the id `wanted`, or of the first one if that is empty. Empty if the bytes are not a message, or
// contain no such arm with a plausible position. Accepts any bytes; any thread.
std::optional<HaplyState> parse_haply_state(std::string_view message, std::string_view wanted = {});

// Devices in a message, at most 16 of each kind; empty lists for bytes that are not a message.
HaplyInventory parse_haply_inventory(std::string_view message);

// Text of the devices: "inverse3 049D, inverse3x 0012; grips verse_grip 1; unknown hexaverse 7"; "no device".
std::string text_of(const HaplyInventory& inventory);

// Message with a force. The service applies it once, and answers with its next state.
std::string haply_force_message(const HaplyName& device, const glm::dvec3& force_n);

}  // namespace afm::haptics
