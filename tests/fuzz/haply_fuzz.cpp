// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string_view>

#include "devices/haply_message.h"
#include "fuzz/accepted.h"

// Any message of a service: a device with a finite place, to which a force can be sent, or nothing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::haptics;
  const std::string_view message(reinterpret_cast<const char*>(bytes), size);
  if (text_of(parse_haply_inventory(message)).empty()) std::abort();
  const auto state = parse_haply_state(message);
  if (!state) return 0;
  ++afm::fuzz::accepted_inputs;
  if (!std::isfinite(glm::length(state->position_m))) std::abort();
  if (haply_force_message(state->device, {0.1, 0.2, 0.3}).empty()) std::abort();
  return 0;
}
