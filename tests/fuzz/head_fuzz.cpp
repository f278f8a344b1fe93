// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "input/simulated_head.h"

// Whatever the bytes: a script that has the head somewhere in the room at every time, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::input;
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto script = load_head_script(file.path());
  if (!script) return 0;
  ++afm::fuzz::accepted_inputs;
  SimulatedHead head({}, *script);
  for (std::int64_t now_ns = 1; now_ns < 40'000'000'000; now_ns += 1'234'567'890) {
    const auto pose = head.pose(now_ns);
    if (!pose || !(glm::length(pose->position_m) < 1e3)) std::abort();
    if (!(std::abs(glm::length(pose->room_from_head) - 1.0) < 1e-6)) std::abort();
  }
  return 0;
}
