// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

// Messages of Haply's Inverse Service, version 3, in TouchAFM's frame: right +x, up +y, towards the user +z. The
// service's own frame is right +x, away +y, up +z.
namespace afm::haptics {

struct HaplyState {
  std::string device_id;     // first Inverse3
  glm::dvec3 position_m{0};  // from the centre of its mounting plate
  bool button = false;       // grip button, wireless or not
};

// Empty if the bytes are not a message, or contain no Inverse3 with a plausible position. Accepts any bytes; any
// thread.
std::optional<HaplyState> parse_haply_state(std::string_view message);

// The service applies a force once, and answers with its next state.
std::string haply_force_message(const std::string& device_id, const glm::dvec3& force_n);

}  // namespace afm::haptics
