// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "curves/paper_tables.h"
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"

// Any bytes as a demo's summary: events of materials, all of them numbers, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto measured = afm::curves::load_measured_events(file.path());
  if (!measured) return 0;
  ++afm::fuzz::accepted_inputs;
  for (const auto& [material, events] : *measured) {
    for (const auto& [quantity, value] : events) {
      if (!std::isfinite(value)) std::abort();
    }
  }
  return 0;
}
