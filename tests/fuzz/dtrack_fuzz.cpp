// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "fuzz/accepted.h"
#include "input/dtrack.h"

// Any bytes received by UDP: a frame of bodies with places, or nothing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::input;
  const auto frame = parse_dtrack({reinterpret_cast<const char*>(bytes), size});
  if (!frame) return 0;
  ++afm::fuzz::accepted_inputs;
  if (frame->body_count > frame->bodies.size() || frame->flystick_count > frame->flysticks.size()) std::abort();
  for (std::size_t i = 0; i < frame->body_count; ++i) {
    const DtrackBody& body = frame->bodies[i];
    if (!std::isfinite(body.position_m.x) || std::abs(glm::length(body.tracker_from_body) - 1.0) > 1e-9) std::abort();
  }
  return 0;
}
